#pragma once

/// Between arrays of small structures and lanes, a structure a lane; see lanes.hpp for who may include this. A register
/// of eight lanes has its first four in the lower half and its last four in the upper one, and no shuffle crosses
/// halves: such shuffles are cheap, and a register of four lanes is the same code with one half.

#include "core/simd/lanes.hpp"

namespace lutka::simd::LUTKA_KERNELS {

/// Two elements of `a`, then two of `b`, in either half alike.
template <int A0, int A1, int B0, int B1>
LUTKA_LANES F shuffled(const F& a, const F& b) {
#if LUTKA_LANE_COUNT == 8 && defined(__AVX__)
    constexpr int pick = A0 | A1 << 2 | B0 << 4 | B1 << 6;
    return reinterpret_cast<F>(_mm256_shuffle_ps(reinterpret_cast<__m256>(a), reinterpret_cast<__m256>(b), pick));
#elif LUTKA_LANE_COUNT == 8
    return F{a[A0], a[A1], b[B0], b[B1], a[4 + A0], a[4 + A1], b[4 + B0], b[4 + B1]};
#else
    return __builtin_shufflevector(a, b, A0, A1, 4 + B0, 4 + B1);
#endif
}

/// Where the structures of the lanes that one half takes turns on lie: `high` is unread with four lanes.
LUTKA_LANES F halves(const float* low, [[maybe_unused]] const float* high) {
#if LUTKA_LANE_COUNT == 8 && defined(__AVX__)
    return reinterpret_cast<F>(_mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(low)), _mm_loadu_ps(high), 1));
#elif LUTKA_LANE_COUNT == 8
    return F{low[0], low[1], low[2], low[3], high[0], high[1], high[2], high[3]};
#else
    return F{low[0], low[1], low[2], low[3]};
#endif
}
LUTKA_LANES void storeHalves(float* low, [[maybe_unused]] float* high, const F& value) {
#if LUTKA_LANE_COUNT == 8 && defined(__AVX__)
    _mm_storeu_ps(low, _mm256_castps256_ps128(reinterpret_cast<__m256>(value)));
    _mm_storeu_ps(high, _mm256_extractf128_ps(reinterpret_cast<__m256>(value), 1));
#else
    for (int i = 0; i < 4; ++i)
        low[i] = value[i];
    for (int i = 4; i < kLanes; ++i)
        high[i - 4] = value[i];
#endif
}

/// Rows of four become columns of four, in either half: its own inverse.
LUTKA_LANES void transpose4(F& a, F& b, F& c, F& d) {
    const F ab01 = shuffled<0, 1, 0, 1>(a, b);
    const F ab23 = shuffled<2, 3, 2, 3>(a, b);
    const F cd01 = shuffled<0, 1, 0, 1>(c, d);
    const F cd23 = shuffled<2, 3, 2, 3>(c, d);
    a = shuffled<0, 2, 0, 2>(ab01, cd01);
    b = shuffled<1, 3, 1, 3>(ab01, cd01);
    c = shuffled<0, 2, 0, 2>(ab23, cd23);
    d = shuffled<1, 3, 1, 3>(ab23, cd23);
}

/// Vectors of three floats that follow each other, one a lane.
LUTKA_LANES V3 loadVectors(const float* from) {
    const F a = halves(from, from + 12);
    const F b = halves(from + 4, from + 16);
    const F c = halves(from + 8, from + 20);
    const F xy = shuffled<2, 3, 1, 2>(b, c);
    const F yz = shuffled<1, 2, 0, 1>(a, b);
    return {shuffled<0, 3, 0, 2>(a, xy), shuffled<0, 2, 1, 3>(yz, xy), shuffled<1, 3, 0, 3>(yz, c)};
}
LUTKA_LANES void storeVectors(float* to, const V3& v) {
    const F xy = shuffled<0, 2, 0, 2>(v.x, v.y);
    const F yz = shuffled<1, 3, 1, 3>(v.y, v.z);
    const F zx = shuffled<0, 2, 1, 3>(v.z, v.x);
    storeHalves(to, to + 12, shuffled<0, 2, 0, 2>(xy, zx));
    storeHalves(to + 4, to + 16, shuffled<0, 2, 1, 3>(yz, xy));
    storeHalves(to + 8, to + 20, shuffled<1, 3, 1, 3>(zx, yz));
}

/// Four floats each from `from + offset[lane]` to four registers, and back.
LUTKA_LANES void gather4(const float* from, const long* offset, F (&out)[4]) {
    for (int i = 0; i < 4; ++i)
        out[i] = halves(from + offset[i], from + offset[(i + 4) % kLanes]);
    transpose4(out[0], out[1], out[2], out[3]);
}
LUTKA_LANES void scatter4(float* to, const long* offset, F a, F b, F c, F d) {
    transpose4(a, b, c, d);
    storeHalves(to + offset[0], to + offset[4 % kLanes], a);
    storeHalves(to + offset[1], to + offset[5 % kLanes], b);
    storeHalves(to + offset[2], to + offset[6 % kLanes], c);
    storeHalves(to + offset[3], to + offset[7 % kLanes], d);
}

/// Rigid transforms of seven floats: two overlapping fours, so that nothing beyond them is touched.
LUTKA_LANES Rigid gatherRigid(const float* from, const long* offset) {
    F turn[4];
    F rest[4];
    gather4(from, offset, turn);
    gather4(from + 3, offset, rest);
    return {{turn[0], turn[1], turn[2], turn[3]}, {rest[1], rest[2], rest[3]}};
}
LUTKA_LANES void scatterRigid(float* to, const long* offset, const Rigid& t) {
    scatter4(to, offset, t.turn.x, t.turn.y, t.turn.z, t.turn.w);
    scatter4(to + 3, offset, t.turn.w, t.at.x, t.at.y, t.at.z);
}

}  // namespace lutka::simd::LUTKA_KERNELS
