//! Keys by their names in scripts.

/// A key of any of the machines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Key {
    /// A printing character of ASCII, 32 to 126.
    Char(u8),
    /// The end of a line: RETURN, newline.
    Enter,
    /// What takes back the character before the cursor: DELETE on a BBC Micro.
    Backspace,
    /// The cursor key to the left.
    Left,
    /// The cursor key up.
    Up,
    /// The cursor key to the right.
    Right,
    /// The cursor key down.
    Down,
    /// HOME; COPY on a BBC Micro.
    Home,
    /// END.
    End,
    /// Page up.
    PageUp,
    /// Page down.
    PageDown,
    /// Insert.
    Insert,
    /// What takes away the character at the cursor; like [`Key::Backspace`] where there is
    /// one key for both.
    Delete,
    /// ESCAPE; RUN/STOP on a Commodore 64.
    Escape,
    /// TAB.
    Tab,
    /// SHIFT alone.
    Shift,
    /// CTRL alone.
    Control,
    /// A function key, 0 to 12.
    Function(u8),
}

/// Names of keys that are not one character.
const NAMES: [(&str, Key); 21] = [
    ("space", Key::Char(b' ')),
    ("enter", Key::Enter),
    ("return", Key::Enter),
    ("quote", Key::Char(b'"')),
    ("left", Key::Left),
    ("right", Key::Right),
    ("up", Key::Up),
    ("down", Key::Down),
    ("escape", Key::Escape),
    ("backspace", Key::Backspace),
    ("delete", Key::Delete),
    ("insert", Key::Insert),
    ("home", Key::Home),
    ("end", Key::End),
    ("pageup", Key::PageUp),
    ("pagedown", Key::PageDown),
    ("tab", Key::Tab),
    ("shift", Key::Shift),
    ("ctrl", Key::Control),
    ("copy", Key::Home),
    ("esc", Key::Escape),
];

impl Key {
    /// The key of a name: one printing character stands for itself, and names of more are
    /// read in any case.
    pub fn named(name: &str) -> Option<Key> {
        if let [byte @ b'!'..=b'~'] = name.as_bytes() {
            return Some(Key::Char(*byte));
        }
        let name = name.to_ascii_lowercase();
        if let Some(number) = name.strip_prefix('f') {
            let digits = number.bytes().all(|b| b.is_ascii_digit());
            let number = number.parse::<u8>().ok().filter(|n| digits && *n <= 12);
            return number.map(Key::Function);
        }
        let found = NAMES.iter().find(|(known, _)| *known == name);
        found.map(|(_, key)| *key)
    }

    /// All names of more than one character.
    pub fn names() -> impl Iterator<Item = &'static str> {
        NAMES.iter().map(|(name, _)| *name)
    }

    /// The key that types a byte of a text, if one does.
    pub fn typed(byte: u8) -> Option<Key> {
        match byte {
            b' '..=b'~' => Some(Key::Char(byte)),
            b'\n' => Some(Key::Enter),
            b'\t' => Some(Key::Tab),
            8 | 127 => Some(Key::Backspace),
            27 => Some(Key::Escape),
            _ => None,
        }
    }
}
