//! The binary; everything is in the library, for the tests and benchmarks.

fn main() -> std::process::ExitCode {
    slowlight::main()
}
