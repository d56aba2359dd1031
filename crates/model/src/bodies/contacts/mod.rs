//! Contacts: what each kind says about the velocity of the point of the body that touches.

mod blade;
mod kind;
mod roller;
mod rolling;
mod rolling_without_spinning;
mod sliding;

pub(crate) use kind::Contact;

/// Every contact; a new one is a file and a line here.
pub(crate) const CONTACTS: &[&Contact] = &[
    &rolling::ROLLING,
    &rolling_without_spinning::ROLLING_WITHOUT_SPINNING,
    &blade::BLADE,
    &roller::ROLLER,
    &sliding::SLIDING,
];
