//! What can be concluded about a system without integrating it: integrability, distributions.
