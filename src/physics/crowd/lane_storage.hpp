#pragma once

/// Between the solver's records (kernel_set.hpp and what it includes) and registers of eight lanes. Included by the
/// kernels only, see core/simd/lanes.hpp.

#include "core/simd/lanes.hpp"
#include "physics/crowd/kernel_set.hpp"

namespace lutka::physics::crowd::LUTKA_KERNELS {

using namespace simd::LUTKA_KERNELS;

static_assert(LUTKA_LANE_COUNT == crowd::kLanes);

LUTKA_LANES F load(const Wide& wide) {
    return loadLanes(wide.lane);
}
LUTKA_LANES void store(Wide& wide, const F& value) {
    storeLanes(wide.lane, value);
}
LUTKA_LANES V3 load(const Wide3& v) {
    return {load(v.x), load(v.y), load(v.z)};
}
LUTKA_LANES void store(Wide3& to, const V3& v) {
    store(to.x, v.x);
    store(to.y, v.y);
    store(to.z, v.z);
}
LUTKA_LANES Symmetric load(const WideSymmetric& m) {
    return {load(m.xx), load(m.yy), load(m.zz), load(m.xy), load(m.xz), load(m.yz)};
}
LUTKA_LANES void store(WideSymmetric& to, const Symmetric& m) {
    store(to.xx, m.xx);
    store(to.yy, m.yy);
    store(to.zz, m.zz);
    store(to.xy, m.xy);
    store(to.xz, m.xz);
    store(to.yz, m.yz);
}
LUTKA_LANES Q load(const Wide4& q) {
    return {load(q.x), load(q.y), load(q.z), load(q.w)};
}
LUTKA_LANES void store(Wide4& to, const Q& q) {
    store(to.x, q.x);
    store(to.y, q.y);
    store(to.z, q.z);
    store(to.w, q.w);
}

// Rows of eight floats into columns.
LUTKA_LANES void transpose(F (&rows)[kLanes]) {
    F pairs[kLanes];
    for (int i = 0; i < kLanes; i += 2) {
        pairs[i] = __builtin_shufflevector(rows[i], rows[i + 1], 0, 8, 1, 9, 4, 12, 5, 13);
        pairs[i + 1] = __builtin_shufflevector(rows[i], rows[i + 1], 2, 10, 3, 11, 6, 14, 7, 15);
    }
    F fours[kLanes];
    for (int i = 0; i < kLanes; i += 4) {
        for (int k = 0; k < 2; ++k) {
            fours[i + 2 * k] = __builtin_shufflevector(pairs[i + k], pairs[i + k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
            fours[i + 2 * k + 1] = __builtin_shufflevector(pairs[i + k], pairs[i + k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
        }
    }
    for (int i = 0; i < 4; ++i) {
        rows[i] = __builtin_shufflevector(fours[i], fours[i + 4], 0, 1, 2, 3, 8, 9, 10, 11);
        rows[i + 4] = __builtin_shufflevector(fours[i], fours[i + 4], 4, 5, 6, 7, 12, 13, 14, 15);
    }
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
