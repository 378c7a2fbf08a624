//! Hash maps.
//!
//! Input: keys and values. Output: values by key. Invariant: entries keep the order they were inserted in, which is the same
//! on every machine.
//!
//! Macros are compiled without optimisation in each user's build. There the standard library's map costs 1600 lines of
//! code for each type of keys and values; here the table is compiled once, for all of them.

use std::borrow::Borrow;
use std::hash::{Hash, Hasher};
use std::ops::Index;

/// A hash map whose iterators follow the order of insertion.
///
/// ```
/// use hamiltonian_symbolic::dag::Map;
///
/// let mut powers: Map<&str, i32> = [("q", 2), ("p", 1)].into_iter().collect();
/// *powers.entry("p").or_default() += 1;
/// assert_eq!(powers.insert("q", 4), Some(2));
/// assert_eq!(powers["q"], 4);
/// assert!(powers.iter().eq([(&"q", &4), (&"p", &2)]));
/// ```
#[derive(Clone, Debug)]
pub struct Map<K, V> {
    entries: Vec<(K, V)>,
    table: Table,
}

impl<K, V> Default for Map<K, V> {
    fn default() -> Self {
        Map {
            entries: Vec::new(),
            table: Table::default(),
        }
    }
}

impl<K, V> Map<K, V> {
    /// The number of entries.
    #[must_use]
    pub fn len(&self) -> usize {
        self.entries.len()
    }
    /// Returns true if there is no entry.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }
    /// All entries.
    pub fn iter(&self) -> impl Iterator<Item = (&K, &V)> {
        self.entries.iter().map(|(key, value)| (key, value))
    }
    /// All keys.
    pub fn keys(&self) -> impl Iterator<Item = &K> {
        self.entries.iter().map(|(key, _)| key)
    }
    /// All values.
    pub fn values(&self) -> impl Iterator<Item = &V> {
        self.entries.iter().map(|(_, value)| value)
    }
    /// All entries, with values to be changed.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = (&K, &mut V)> {
        self.entries.iter_mut().map(|(key, value)| (&*key, value))
    }
    fn place<Q: Hash + Eq + ?Sized>(&self, key: &Q, hash: u64) -> Option<usize>
    where
        K: Borrow<Q>,
    {
        self.table
            .find(hash, &mut |place| self.entries[place].0.borrow() == key)
    }
    /// The value of a key.
    pub fn get<Q: Hash + Eq + ?Sized>(&self, key: &Q) -> Option<&V>
    where
        K: Borrow<Q>,
    {
        match self.place(key, hash(key)) {
            Some(place) => Some(&self.entries[place].1),
            None => None,
        }
    }
    /// The value of a key, to be changed.
    pub fn get_mut<Q: Hash + Eq + ?Sized>(&mut self, key: &Q) -> Option<&mut V>
    where
        K: Borrow<Q>,
    {
        match self.place(key, hash(key)) {
            Some(place) => Some(&mut self.entries[place].1),
            None => None,
        }
    }
    /// The value of a key, which is its type's default from then on.
    pub fn take<Q: Hash + Eq + ?Sized>(&mut self, key: &Q) -> Option<V>
    where
        K: Borrow<Q>,
        V: Default,
    {
        self.get_mut(key).map(std::mem::take)
    }
    /// Returns true if a key has a value.
    pub fn contains_key<Q: Hash + Eq + ?Sized>(&self, key: &Q) -> bool
    where
        K: Borrow<Q>,
    {
        self.place(key, hash(key)).is_some()
    }
}

impl<K: Hash + Eq, V> Map<K, V> {
    /// Gives a key its value. Returns the value that it had.
    pub fn insert(&mut self, key: K, value: V) -> Option<V> {
        let hash = hash(&key);
        match self.place(&key, hash) {
            Some(place) => Some(std::mem::replace(&mut self.entries[place].1, value)),
            None => {
                self.push(key, value, hash);
                None
            }
        }
    }
    /// Keeps the entries whose keys `is_kept` accepts.
    pub fn retain(&mut self, mut is_kept: impl FnMut(&K) -> bool) {
        let entries = std::mem::take(self).into_iter();
        self.extend(entries.filter(|(key, _)| is_kept(key)));
    }
    fn push(&mut self, key: K, value: V, hash: u64) {
        self.table.push(hash);
        self.entries.push((key, value));
    }
    /// The place of a key's value, to be read or filled.
    pub fn entry(&mut self, key: K) -> Entry<'_, K, V> {
        let hash = hash(&key);
        let place = self.place(&key, hash);
        Entry {
            map: self,
            place,
            key,
            hash,
        }
    }
}

/// The place of a key's value in a [`Map`].
#[derive(Debug)]
pub struct Entry<'a, K, V> {
    map: &'a mut Map<K, V>,
    place: Option<usize>,
    key: K,
    hash: u64,
}

impl<'a, K: Hash + Eq, V> Entry<'a, K, V> {
    /// The key's value; `value()` if it had none.
    pub fn or_insert_with(self, value: impl FnOnce() -> V) -> &'a mut V {
        let place = match self.place {
            Some(place) => place,
            None => {
                self.map.push(self.key, value(), self.hash);
                self.map.len() - 1
            }
        };
        &mut self.map.entries[place].1
    }
    /// The key's value; `value` if it had none.
    pub fn or_insert(self, value: V) -> &'a mut V {
        self.or_insert_with(|| value)
    }
    /// The key's value; its type's default if it had none.
    pub fn or_default(self) -> &'a mut V
    where
        V: Default,
    {
        self.or_insert_with(V::default)
    }
}

impl<K: Borrow<Q>, Q: Hash + Eq + ?Sized, V> Index<&Q> for Map<K, V> {
    type Output = V;
    fn index(&self, key: &Q) -> &V {
        self.get(key).expect("the key has a value")
    }
}

/// Two maps are equal if they have the same entries, in whatever order.
impl<K: Hash + Eq, V: PartialEq> PartialEq for Map<K, V> {
    fn eq(&self, other: &Self) -> bool {
        let is_in_other = |(key, value)| other.get(key) == Some(value);
        self.len() == other.len() && self.iter().all(is_in_other)
    }
}

impl<K: Hash + Eq, V> Extend<(K, V)> for Map<K, V> {
    fn extend<I: IntoIterator<Item = (K, V)>>(&mut self, entries: I) {
        for (key, value) in entries {
            self.insert(key, value);
        }
    }
}

impl<K: Hash + Eq, V> FromIterator<(K, V)> for Map<K, V> {
    fn from_iter<I: IntoIterator<Item = (K, V)>>(entries: I) -> Self {
        let mut map = Map::default();
        map.extend(entries);
        map
    }
}

impl<K, V> IntoIterator for Map<K, V> {
    type Item = (K, V);
    type IntoIter = std::vec::IntoIter<(K, V)>;
    fn into_iter(self) -> Self::IntoIter {
        self.entries.into_iter()
    }
}

/// Where entries with a hash are.
#[derive(Clone, Debug, Default)]
struct Table {
    /// Each entry's hash.
    hashes: Vec<u64>,
    /// 0, or an entry's place and 1; a power of two of them, at least twice as many as entries. Few entries need none.
    slots: Vec<u32>,
}

/// So many entries are searched one by one.
const FEW: usize = 6;

impl Table {
    /// The place that a hash stands at and that `is_asked` accepts.
    fn find(&self, hash: u64, is_asked: &mut dyn FnMut(usize) -> bool) -> Option<usize> {
        if self.slots.is_empty() {
            let mut place = 0;
            while place < self.hashes.len() {
                if self.hashes[place] == hash && is_asked(place) {
                    return Some(place);
                }
                place += 1;
            }
            return None;
        }
        let mut slot = self.slot(hash);
        loop {
            let place = match self.slots[slot] {
                0 => return None,
                above => above as usize - 1,
            };
            if self.hashes[place] == hash && is_asked(place) {
                return Some(place);
            }
            slot = (slot + 1) & (self.slots.len() - 1);
        }
    }

    /// Adds a hash for the next entry.
    fn push(&mut self, hash: u64) {
        self.hashes.push(hash);
        let count = self.hashes.len();
        if count > FEW && 2 * count > self.slots.len() {
            self.slots = vec![0; 4 * count.next_power_of_two()];
            let mut place = 0;
            while place < count {
                self.fill(place);
                place += 1;
            }
        } else if count > FEW {
            self.fill(count - 1);
        }
    }

    /// The first slot that an entry may be in.
    fn slot(&self, hash: u64) -> usize {
        // The higher bits of the hash depend on all of the key.
        (hash >> 32) as usize & (self.slots.len() - 1)
    }

    fn fill(&mut self, place: usize) {
        let mut slot = self.slot(self.hashes[place]);
        while self.slots[slot] != 0 {
            slot = (slot + 1) & (self.slots.len() - 1);
        }
        self.slots[slot] = place as u32 + 1;
    }
}

fn hash<Q: Hash + ?Sized>(key: &Q) -> u64 {
    let mut hasher = Mixer::default();
    key.hash(&mut hasher);
    hasher.finish()
}

/// A small multiplicative hasher: fast without optimisation, and the same on every machine.
#[derive(Default)]
pub struct Mixer(u64);
impl Hasher for Mixer {
    fn finish(&self) -> u64 {
        self.0
    }
    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.write_u64(u64::from(byte));
        }
    }
    fn write_u8(&mut self, value: u8) {
        self.write_u64(u64::from(value));
    }
    fn write_u16(&mut self, value: u16) {
        self.write_u64(u64::from(value));
    }
    fn write_u32(&mut self, value: u32) {
        self.write_u64(u64::from(value));
    }
    fn write_i32(&mut self, value: i32) {
        self.write_u64(value as u64);
    }
    fn write_i64(&mut self, value: i64) {
        self.write_u64(value as u64);
    }
    fn write_usize(&mut self, value: usize) {
        self.write_u64(value as u64);
    }
    fn write_u64(&mut self, value: u64) {
        self.0 = (self.0.rotate_left(5) ^ value).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    }
}
