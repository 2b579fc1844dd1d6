//! `Keyboard`: the word that holds the key's code while it is pressed.

pub(super) const KEY_PRESSED: &str = "    function char keyPressed() {
        var Array key;
        let key = 24576;
        return key[0];
    }
";

pub(super) const READ_CHAR: &str = "    /** Waits for a key to be pressed and let go; shows it. */
    function char readChar() {
        var char c;
        let c = Keyboard.readKey();
        do Output.printChar(c);
        return c;
    }
";

pub(super) const READ_KEY: &str = "    /** Waits for a key to be pressed and let go. */
    function char readKey() {
        var char c;
        let c = 0;
        while (c = 0) { let c = Keyboard.keyPressed(); }
        while (~(Keyboard.keyPressed() = 0)) { }
        return c;
    }
";

pub(super) const READ_LINE: &str =
    "    /** Shows the message and what is typed, up to 80 characters and a new line. */
    function String readLine(String message) {
        var String line;
        var char c;
        do Output.printString(message);
        let line = String.new(80);
        let c = Keyboard.readKey();
        while (~(c = 128)) {
            if (c = 129) {
                if (line.length() > 0) {
                    do line.eraseLastChar();
                    do Output.backSpace();
                }
            }
            else {
                if (line.length() < 80) {
                    do line.appendChar(c);
                    do Output.printChar(c);
                }
            }
            let c = Keyboard.readKey();
        }
        do Output.println();
        return line;
    }
";

pub(super) const READ_INT: &str = "    function int readInt(String message) {
        var String line;
        var int value;
        let line = Keyboard.readLine(message);
        let value = line.intValue();
        do line.dispose();
        return value;
    }
";
