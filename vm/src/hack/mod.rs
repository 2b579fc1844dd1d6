//! hack
