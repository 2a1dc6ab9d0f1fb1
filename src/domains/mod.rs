//! The domains: a folder for each kind of machine. A domain knows the core, and the domains before it in the list.

#[cfg(feature = "brake")]
pub mod brake;
#[cfg(feature = "linkage")]
pub mod linkage;
#[cfg(feature = "press")]
pub mod press;
#[cfg(feature = "shaft")]
pub mod shaft;

use crate::domain::Domain;

/// Every domain.
pub const DOMAINS: &[&Domain] = &[
    #[cfg(feature = "press")]
    &press::DOMAIN,
    #[cfg(feature = "linkage")]
    &linkage::DOMAIN,
    #[cfg(feature = "shaft")]
    &shaft::DOMAIN,
    #[cfg(feature = "brake")]
    &brake::DOMAIN,
];

#[cfg(test)]
#[cfg(all(feature = "press", feature = "linkage", feature = "shaft", feature = "brake"))]
mod tests;
