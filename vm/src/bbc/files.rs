//! Files in memory: what a program writes is there when it stops, what it may read is given
//! before it starts.

use std::collections::BTreeMap;

use super::error::Error;

/// The lowest channel number that DFS gives.
const FIRST: i32 = 17;
/// As many as DFS opens at once.
const MOST: usize = 5;
/// All files together, in bytes; past it the disc is full.
const CAPACITY: usize = 1 << 24;

#[derive(Clone, Debug, Default)]
pub(crate) struct Files {
    pub contents: BTreeMap<String, Vec<u8>>,
    open: [Option<Open>; MOST],
    used: usize,
}

#[derive(Clone, Debug)]
struct Open {
    name: String,
    at: usize,
}

fn name_of(name: &[u8]) -> String {
    name.iter().map(|c| char::from(*c)).collect()
}

impl Files {
    fn channel(&self, channel: i32) -> Result<&Open, Error> {
        usize::try_from(channel.wrapping_sub(FIRST))
            .ok()
            .and_then(|i| self.open.get(i)?.as_ref())
            .ok_or(Error::Channel)
    }

    fn channel_mut(&mut self, channel: i32) -> Result<&mut Open, Error> {
        usize::try_from(channel.wrapping_sub(FIRST))
            .ok()
            .and_then(|i| self.open.get_mut(i)?.as_mut())
            .ok_or(Error::Channel)
    }

    /// A free channel on a file; 0 where none is free.
    fn attach(&mut self, name: String) -> i32 {
        for (i, slot) in self.open.iter_mut().enumerate() {
            if slot.is_none() {
                *slot = Some(Open { name, at: 0 });
                return FIRST + i as i32;
            }
        }
        0
    }

    /// OPENOUT: a new, empty file.
    pub fn create(&mut self, name: &[u8]) -> i32 {
        let name = name_of(name);
        self.contents.insert(name.clone(), Vec::new());
        self.attach(name)
    }

    /// OPENIN and OPENUP: 0 where there is no such file.
    pub fn open(&mut self, name: &[u8]) -> i32 {
        let name = name_of(name);
        if self.contents.contains_key(&name) {
            self.attach(name)
        } else {
            0
        }
    }

    /// CLOSE#; 0 closes all.
    pub fn close(&mut self, channel: i32) -> Result<(), Error> {
        if channel == 0 {
            self.open = Default::default();
            return Ok(());
        }
        self.channel(channel)?;
        if let Some(slot) = usize::try_from(channel.wrapping_sub(FIRST))
            .ok()
            .and_then(|i| self.open.get_mut(i))
        {
            *slot = None;
        }
        Ok(())
    }

    pub fn put(&mut self, channel: i32, byte: u8) -> Result<(), Error> {
        let used = self.used;
        let open = self.channel_mut(channel)?;
        let (name, at) = (open.name.clone(), open.at);
        open.at += 1;
        let file = self.contents.entry(name).or_default();
        if let Some(old) = file.get_mut(at) {
            *old = byte;
        } else if used >= CAPACITY {
            return Err(Error::DiskFull);
        } else {
            file.push(byte);
            self.used += 1;
        }
        Ok(())
    }

    pub fn get(&mut self, channel: i32) -> Result<u8, Error> {
        let open = self.channel(channel)?;
        let byte = self
            .contents
            .get(&open.name)
            .and_then(|f| f.get(open.at))
            .copied()
            .ok_or(Error::Eof)?;
        self.channel_mut(channel)?.at += 1;
        Ok(byte)
    }

    pub fn length(&self, channel: i32) -> Result<usize, Error> {
        let open = self.channel(channel)?;
        Ok(self.contents.get(&open.name).map_or(0, Vec::len))
    }

    pub fn position(&self, channel: i32) -> Result<usize, Error> {
        Ok(self.channel(channel)?.at)
    }

    /// PTR#= ; not past the end.
    pub fn seek(&mut self, channel: i32, at: i32) -> Result<(), Error> {
        let end = self.length(channel)?;
        let at = usize::try_from(at).unwrap_or(0).min(end);
        self.channel_mut(channel)?.at = at;
        Ok(())
    }

    pub fn at_end(&self, channel: i32) -> Result<bool, Error> {
        Ok(self.position(channel)? >= self.length(channel)?)
    }
}
