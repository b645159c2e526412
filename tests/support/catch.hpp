#pragma once

// Catch2 2.13 is what Debian 12 has; version 3 splits the header.
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
#else
#include <catch2/catch.hpp>
#endif
