//! The binary; everything is in the library, for the tests and benchmarks.

/// Plans are many small lists and maps, made and dropped by all threads.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> std::process::ExitCode {
    slowlight::main()
}
