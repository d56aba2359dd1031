//! What was computed once about an object and is needed again.

use std::any::{Any, TypeId};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Values by their type; a copy of the object begins without any.
#[derive(Default)]
pub struct Memo(Mutex<BTreeMap<TypeId, Arc<dyn Any + Send + Sync>>>);

impl Memo {
    /// The value of this type, computed where it is not known.
    pub fn shared<T: Any + Send + Sync>(&self, compute: impl FnOnce() -> T) -> Arc<T> {
        let key = TypeId::of::<T>();
        let known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(Ok(value)) = known.get(&key).cloned().map(Arc::downcast) {
            return value;
        }
        drop(known);
        let value = Arc::new(compute());
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        known.insert(key, value.clone());
        value
    }
}

impl Clone for Memo {
    fn clone(&self) -> Memo {
        Memo::default()
    }
}

impl std::fmt::Debug for Memo {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Memo")
    }
}
