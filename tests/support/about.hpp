// Comparing with a value up to a share of it.
#pragma once

#include <doctest/doctest.h>

/// Equals what lies within a share of `value`, which must not be 0. Doctest's own epsilon is a share of the value plus
/// one: 0.4 with an epsilon of 0.03 takes 0.36.
inline doctest::Approx about(double value, double share) { return doctest::Approx(value).epsilon(share).scale(0); }
