#pragma once

/// Between the solver's records (layout.hpp) and registers of eight lanes. Included by the kernels only, see
/// core/simd/lanes.hpp.

#include "core/simd/lanes.hpp"
#include "physics/crowd/layout.hpp"

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

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
