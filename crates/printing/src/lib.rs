//! The domains of printing machines: a folder for each kind of machine. A domain uses the core, and the domains before it in the list.
//!
//! Users take the crate `camgen`, where this is the module `domains`.
#![forbid(unsafe_code)]

pub mod brake;
pub mod linkage;
pub mod press;
pub mod shaft;

use camgen_cams::domain::Domain;

/// Every domain.
pub const DOMAINS: &[&Domain] = &[&press::DOMAIN, &linkage::DOMAIN, &shaft::DOMAIN, &brake::DOMAIN];

camgen_cams::register!("printing", DOMAINS);

#[cfg(test)]
mod tests;
