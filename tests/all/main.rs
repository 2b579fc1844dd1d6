//! One integration-test binary: a file a subject.

mod house;
