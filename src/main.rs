//! The command `lgvi`.

mod cli;

fn main() -> std::process::ExitCode {
    cli::main()
}
