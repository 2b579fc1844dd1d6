//! One integration-test binary: a file a subject.

mod accuracy;
mod alone;
mod any_assembler;
mod auto_format;
mod basic_discs;
mod bbc;
mod bits;
mod blue_noise;
mod boxes;
mod cartridges;
mod cli;
mod cli_compare;
mod cli_doc;
mod cli_fmt;
mod cli_hack;
mod cli_heap;
mod cli_keys;
mod cli_misled;
mod cli_new;
mod cli_params;
mod cli_run;
mod cli_said;
mod cli_snapshot;
mod cli_vcs;
mod cli_wrong;
mod colours;
mod columns;
mod drawings;
mod editors;
mod effects;
mod explain;
mod fit;
mod forecast;
mod fpbench;
mod hack_rom;
mod hard_cases;
mod held;
mod house;
mod imports;
mod jack;
mod jack_fixed;
mod jack_formats;
mod labels;
mod library;
mod listing;
mod live;
mod live_client;
mod live_machines;
mod lsp;
mod lsp_client;
mod lsp_edits;
mod lsp_rename;
mod lsp_wrong;
mod mos6502;
mod mos6502_fixed;
mod mos6502_logs;
mod moving;
mod moving_films;
mod need;
mod numbers;
mod objects;
mod packages;
mod pages;
mod paint;
mod pairs;
mod pairs_small;
#[cfg(feature = "peers")]
mod peers_assemblers;
#[cfg(feature = "peers")]
mod peers_basic;
#[cfg(feature = "peers")]
mod peers_boxes;
#[cfg(feature = "peers")]
mod peers_brandy;
#[cfg(feature = "peers")]
mod peers_c64;
#[cfg(feature = "peers")]
mod peers_chromium;
#[cfg(feature = "peers")]
mod peers_dialect;
#[cfg(feature = "peers")]
mod peers_drawings;
#[cfg(feature = "peers")]
mod peers_editors;
#[cfg(feature = "peers")]
mod peers_jsbeeb;
#[cfg(feature = "peers")]
mod peers_live;
#[cfg(feature = "peers")]
mod peers_neovim;
#[cfg(feature = "peers")]
mod peers_parallel;
#[cfg(feature = "peers")]
mod peers_sixel;
#[cfg(feature = "peers")]
mod peers_stella;
#[cfg(feature = "peers")]
mod peers_toots;
mod planning;
mod precise;
mod predicted;
mod ramps;
mod refine;
mod renderers;
mod rom_operations;
mod rom_vectors;
mod runs;
mod seldom;
mod snapshots;
mod spread;
mod started;
mod stress;
mod survey_parts;
mod syntaxes;
mod toots;
mod torus;
mod tune;
mod tune_effort;
mod varied;
mod watch;
mod ways;
mod whole;
mod why;
mod worst;
mod written;
mod wrong;
