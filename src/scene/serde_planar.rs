//! Serialisation of fields that only spatial scenes and tasks have: omitted from binary records of
//! pushes.
//!
//! Records of data sets are not self-describing: an added field in each of millions of frames would
//! make every existing data set unreadable. Data sets contain planar scenes only, so nothing is
//! lost.

pub(crate) mod planar_only {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<T: Serialize, S: Serializer>(
        value: &T,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        if serializer.is_human_readable() {
            value.serialize(serializer)
        } else {
            serializer.serialize_unit()
        }
    }

    pub fn deserialize<'de, T: Deserialize<'de> + Default, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<T, D::Error> {
        if deserializer.is_human_readable() {
            T::deserialize(deserializer)
        } else {
            Ok(T::default())
        }
    }
}

pub(crate) fn is_zero(value: &f64) -> bool {
    *value == 0.0
}
