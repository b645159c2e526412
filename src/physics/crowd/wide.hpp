#pragma once

/// Numbers of eight dolls side by side, one float a lane: the plain data that the solver's kernels and the code around
/// them share.
///
/// Nothing in this header, and in those that include it for the kernels, may have inline functions with code in it:
/// they are compiled for several instruction sets, and the linker would keep only one copy.

namespace lutka::physics::crowd {

inline constexpr int kLanes = 8;
inline constexpr unsigned kAllLanes = (1U << kLanes) - 1U;  ///< As a bit mask.

/// One float a lane.
struct alignas(32) Wide {
    float lane[kLanes];
};
struct Wide3 {
    Wide x, y, z;
};
struct Wide4 {
    Wide x, y, z, w;
};
/// A symmetric 3 × 3 matrix.
struct WideSymmetric {
    Wide xx, yy, zz, xy, xz, yz;
};

/// A general 3 × 3 matrix by rows.
struct WideMatrix {
    Wide3 row[3];
};

}  // namespace lutka::physics::crowd
