//! Values that were set from outside, written into the text of a model: all else of it, comments and order too, stays as it is.

use chetaev_symbolic::syntax::names::normalized;
use toml_edit::{DocumentMut, Item, Table, TableLike, Value};

/// Where a plain value stands that has a unit or a range beside it.
const VALUE: &str = "value";
const INITIAL: &str = "initial";
const PARAMETERS: &str = "parameters";
const SIZES: &str = "sizes";
const OBJECTS: [&str; 4] = ["bodies", "joints", "contacts", "particles"];

/// The text of a model file with values of parameters and sizes, and of `initial.NAME`, written in; as [`load`](crate::load) takes them. Several
/// texts where it does not say what a name is that an included file declares, or the library by itself as `g`: the first one that states what is
/// wanted is right. None may be, as where a name is declared as one of a family.
pub fn with_values(text: &str, values: &[(String, String)]) -> Vec<String> {
    let texts = [PARAMETERS, SIZES].into_iter();
    texts
        .filter_map(|heading| with_values_under(heading, text, values))
        .collect()
}

/// The same, with values of what the text does not declare under this heading.
fn with_values_under(heading: &str, text: &str, values: &[(String, String)]) -> Option<String> {
    let mut document: DocumentMut = text.parse().ok()?;
    for (name, value) in values {
        match name.strip_prefix("initial.") {
            Some(name) => set_initial(document.as_table_mut(), name, value)?,
            None => set(document.as_table_mut(), (heading, name), value)?,
        }
    }
    Some(document.to_string())
}

/// Numbers stand as they are, other expressions as texts.
fn written(value: &str) -> Value {
    let is_plain = |c: char| c.is_ascii_digit() || c == '.' || c == '-';
    let number = value.parse::<Value>().ok();
    let number = number.filter(|own| value.chars().all(is_plain) && !own.is_datetime());
    number.unwrap_or_else(|| Value::from(value))
}

/// The key of a section that is the name.
fn key_of(section: &dyn TableLike, name: &str) -> Option<String> {
    let wanted = normalized(name);
    let mut keys = section.iter().map(|(key, _)| key);
    keys.find(|key| normalized(key) == wanted)
        .map(str::to_owned)
}

/// Sets a parameter or a size, or the number of an object of which a parameter is made, as `mass` of the body `wheel`: `wheel_mass`.
fn set(root: &mut Table, (heading, name): (&str, &str), value: &str) -> Option<()> {
    for declared in [PARAMETERS, SIZES] {
        let section = root.get_mut(declared).and_then(Item::as_table_like_mut);
        let Some(section) = section else { continue };
        if let Some(own) = key_of(section, name).and_then(|key| section.get_mut(&key)) {
            put(own, value);
            return Some(());
        }
    }
    if let Some(own) = of_object(root, name) {
        put(own, value);
        return Some(());
    }
    let section = section(root, heading)?;
    section.insert(name, Item::Value(written(value)));
    Some(())
}

/// The entry of a body, a joint or a contact whose name and key are joined to this name.
fn of_object<'r>(root: &'r mut Table, name: &str) -> Option<&'r mut Item> {
    let sections = root.iter_mut();
    let sections = sections.filter(|(key, _)| OBJECTS.contains(&key.get()));
    let mut objects = sections
        .filter_map(|(_, section)| section.as_table_like_mut())
        .flat_map(TableLike::iter_mut);
    objects.find_map(|(own, object)| {
        let key = name.strip_prefix(own.get())?.strip_prefix('_')?;
        object.as_table_like_mut()?.get_mut(key)
    })
}

/// Puts a value in the place of another one, with the comments around that, or beside the unit that it has.
fn put(own: &mut Item, value: &str) {
    let mut new = written(value);
    let mut place = own;
    if place.is_table_like() {
        place = &mut place[VALUE];
    }
    if let Some(old) = place.as_value() {
        *new.decor_mut() = old.decor().clone();
    }
    *place = Item::Value(new);
}

/// Sets an initial value, whatever was stated there before.
fn set_initial(root: &mut Table, name: &str, value: &str) -> Option<()> {
    let section = section(root, INITIAL)?;
    let key = key_of(section, name).unwrap_or_else(|| name.to_owned());
    let mut new = written(value);
    if let Some(old) = section.get(&key).and_then(Item::as_value) {
        *new.decor_mut() = old.decor().clone();
    }
    section.insert(&key, Item::Value(new));
    Some(())
}

/// A section, which is made where there is none.
fn section<'r>(root: &'r mut Table, heading: &str) -> Option<&'r mut dyn TableLike> {
    let made = || Item::Table(Table::new());
    root.entry(heading).or_insert_with(made).as_table_like_mut()
}

#[cfg(test)]
mod tests {
    use super::with_values;

    fn written(text: &str, values: &[(&str, &str)]) -> Option<String> {
        let values = values.iter();
        let values: Vec<_> = values
            .map(|(name, value)| ((*name).to_owned(), (*value).to_owned()))
            .collect();
        with_values(text, &values).into_iter().next()
    }

    #[test]
    fn what_is_not_set_stays_as_it_is() {
        let text = "# A point.\n[parameters]\nm = 2 # mass\nk = { value = 3, unit = \"N/m\" } # spring\nJ = \"m/2\"\n\n[initial]\nx = 1 # here\n";
        let set = [
            ("k", "1/3"),
            ("m", "4"),
            ("initial.x'", "0.5"),
            ("initial.x", "sqrt(2)"),
        ];
        let expected = "# A point.\n[parameters]\nm = 4 # mass\nk = { value = \"1/3\", unit = \"N/m\" } # spring\nJ = \"m/2\"\n\n[initial]\nx = \"sqrt(2)\" # here\n\"x'\" = 0.5\n";
        assert_eq!(written(text, &set).as_deref(), Some(expected));
    }

    #[test]
    fn what_has_no_value_or_no_section_gets_one() {
        let text = "parameters = { m = {} }\ncoordinates = [\"x\"]\n";
        let expected =
            "parameters = { m = { value = 2 } }\ncoordinates = [\"x\"]\n\n[initial]\nx = -1.5\n";
        let set = [("m", "2"), ("initial.x", "-1.5")];
        assert_eq!(written(text, &set).as_deref(), Some(expected));
        let text = "include = \"base.toml\"\n";
        let expected = "include = \"base.toml\"\n\n[parameters]\nm = 2\n";
        assert_eq!(written(text, &[("m", "2")]).as_deref(), Some(expected));
    }

    #[test]
    fn what_is_not_declared_is_a_parameter_or_a_size() {
        let text = "name = \"a\"\n";
        let expected = ["parameters", "sizes"].map(|own| format!("{text}\n[{own}]\nm = 1\n"));
        let set = [("m".to_owned(), "1".to_owned())];
        assert_eq!(with_values(text, &set), expected);
        let text = "[bodies]\nwheel = { mass = 2 }\n";
        let expected = "[bodies]\nwheel = { mass = 3 }\n";
        assert_eq!(
            written(text, &[("wheel_mass", "3")]).as_deref(),
            Some(expected)
        );
        assert_eq!(written("parameters = 3\nsizes = 3\n", &[("m", "1")]), None);
    }
}
