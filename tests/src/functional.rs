//! Functionals that several tests are about.

/// ½ u'² + ½ v² with v = u' imposed: 2 u'' = 0, with 2 u' = 0 at the free end.
pub const PUT_IN: &str = r#"
kind = "functional"
name = "put-in"
density = "1/2 u,x^2 + 1/2 v^2"
imposed = ["slope"]
yields = ["straight", "free"]
[domain]
coordinates = ["x"]
intervals = { x = [0, 1] }
[fields]
u = "scalar"
v = "scalar"
[boundary]
"x = 0" = { fixed = ["u"] }
"x = 1" = "0"
[equations]
slope = "v = u,x"
straight = "u,xx = 0"
free = { equation = "u,x = 0", on = "x = 1" }
"#;
