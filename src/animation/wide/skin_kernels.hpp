#pragma once

/// Linear blend skinning, a vertex a lane. The sums are those of the scalar loop, term by term, so that both give the
/// same bits.

#include "animation/wide/lane_shuffles.hpp"

namespace lutka::animation::wide::LUTKA_KERNELS {

static constexpr int kInfluences = 4;

// One vertex: the plain loop, which also takes the vertices that don't fill a register.
LUTKA_LANES void skinOne(const SkinJob& job, long vertex) {
    float m[kMatrixFloats] = {};
    for (int slot = 0; slot < kInfluences; ++slot) {
        const float weight = job.weights[vertex * kInfluences + slot];
        if (weight == 0.0F) break;  // strongest first: the rest is zero too
        const float* from = job.palette + static_cast<long>(job.joints[vertex * kInfluences + slot]) * kMatrixFloats;
        for (int i = 0; i < kMatrixFloats; ++i)
            m[i] += weight * from[i];
    }
    const float* p = job.positions + vertex * 3;
    for (int row = 0; row < 3; ++row)
        job.outPositions[vertex * 3 + row] =
            (m[row * 4] * p[0] + m[row * 4 + 1] * p[1]) + (m[row * 4 + 2] * p[2] + m[row * 4 + 3]);
    const auto turn = [&](const float* v, float* out) {
        float t[3];
        for (int row = 0; row < 3; ++row)
            t[row] = (m[row * 4] * v[0] + m[row * 4 + 1] * v[1]) + m[row * 4 + 2] * v[2];
        const float scale = 1.0F / __builtin_sqrtf(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
        for (int row = 0; row < 3; ++row)
            out[row] = t[row] * scale;
    };
    if (job.normals != nullptr) turn(job.normals + vertex * 3, job.outNormals + vertex * 3);
    if (job.tangents != nullptr) {
        turn(job.tangents + vertex * 4, job.outTangents + vertex * 4);
        job.outTangents[vertex * 4 + 3] = job.tangents[vertex * 4 + 3];
    }
}

static void skinByScalars(const SkinJob& job) {
    for (long vertex = 0; vertex < job.vertexCount; ++vertex)
        skinOne(job, vertex);
}

// How many influences any of the vertices has: weights are sorted, so that a column of zeros ends them all.
LUTKA_LANES int influencesOf(const float* weights) {
    using Bits = unsigned __attribute__((vector_size(16), may_alias, aligned(4)));
    const auto* rows = reinterpret_cast<const Bits*>(weights);
    Bits any = rows[0];
    for (int lane = 1; lane < kLanes; ++lane)
        any |= rows[lane];
    if (any[3] != 0) return 4;
    if (any[2] != 0) return 3;
    return any[1] != 0 ? 2 : 1;
}

#if LUTKA_LANE_COUNT == 8 && defined(__AVX__)

// Adds one influence of a vertex to its first two rows, which fill a register.
template <int Slot>
LUTKA_LANES void blendUpper(const SkinJob& job, const float* weights, const std::uint16_t* joints, int lane, F& rows) {
    using Unaligned = float __attribute__((vector_size(32), may_alias, aligned(4)));
    const float* from = job.palette + static_cast<long>(joints[lane * kInfluences + Slot]) * kMatrixFloats;
    const F part = all(weights[lane * kInfluences + Slot]) * *reinterpret_cast<const Unaligned*>(from);
    rows = Slot == 0 ? part : rows + part;
}
// Adds one influence of the vertices `lane` and `lane + 4` to their third rows, which share a register.
template <int Slot>
LUTKA_LANES void blendThird(const SkinJob& job, const F& weights, const std::uint16_t* joints, int lane, F& rows) {
    const float* low = job.palette + static_cast<long>(joints[lane * kInfluences + Slot]) * kMatrixFloats + 8;
    const float* high = job.palette + static_cast<long>(joints[(lane + 4) * kInfluences + Slot]) * kMatrixFloats + 8;
    const F part = shuffled<Slot, Slot, Slot, Slot>(weights, weights) * halves(low, high);
    rows = Slot == 0 ? part : rows + part;
}

// Transposes the first two rows of four vertices into lanes [row 0 of the four | row 1 of the four].
template <int Count>
LUTKA_LANES void blendUpperOfFour(const SkinJob& job, const float* weights, const std::uint16_t* joints, int lane,
                                  F (&out)[4]) {
    for (int i = 0; i < 4; ++i) {
        blendUpper<0>(job, weights, joints, lane + i, out[i]);
        if constexpr (Count > 1) blendUpper<1>(job, weights, joints, lane + i, out[i]);
        if constexpr (Count > 2) blendUpper<2>(job, weights, joints, lane + i, out[i]);
        if constexpr (Count > 3) blendUpper<3>(job, weights, joints, lane + i, out[i]);
    }
    transpose4(out[0], out[1], out[2], out[3]);
}

LUTKA_LANES F lowHalves(const F& a, const F& b) {
    return reinterpret_cast<F>(_mm256_permute2f128_ps(reinterpret_cast<__m256>(a), reinterpret_cast<__m256>(b), 0x20));
}
LUTKA_LANES F highHalves(const F& a, const F& b) {
    return reinterpret_cast<F>(_mm256_permute2f128_ps(reinterpret_cast<__m256>(a), reinterpret_cast<__m256>(b), 0x31));
}

// The blended matrices of kLanes vertices, m[row][column].
template <int Count>
LUTKA_LANES void blend(const SkinJob& job, long first, const std::uint16_t* joints, F (&m)[3][4]) {
    const float* weights = job.weights + first * kInfluences;
    F low[4];
    F high[4];
    blendUpperOfFour<Count>(job, weights, joints, 0, low);
    blendUpperOfFour<Count>(job, weights, joints, 4, high);
    for (int column = 0; column < 4; ++column) {
        m[0][column] = lowHalves(low[column], high[column]);
        m[1][column] = highHalves(low[column], high[column]);
    }
    for (int i = 0; i < 4; ++i) {
        const F both = halves(weights + static_cast<long>(i) * 4, weights + static_cast<long>(i) * 4 + 16);
        blendThird<0>(job, both, joints, i, m[2][i]);
        if constexpr (Count > 1) blendThird<1>(job, both, joints, i, m[2][i]);
        if constexpr (Count > 2) blendThird<2>(job, both, joints, i, m[2][i]);
        if constexpr (Count > 3) blendThird<3>(job, both, joints, i, m[2][i]);
    }
    transpose4(m[2][0], m[2][1], m[2][2], m[2][3]);
}

#else

// The blended matrices of kLanes vertices, m[row][column]: each influence of vertex i (and i + 4) is added to its rows,
// and the rows of four vertices become columns.
template <int Count>
LUTKA_LANES void blend(const SkinJob& job, long first, const std::uint16_t* joints, F (&m)[3][4]) {
    for (int i = 0; i < 4; ++i) {
        const float* own = job.weights + (first + i) * kInfluences;
        const F weights = halves(own, kLanes == 8 ? own + 16 : own);
        const F weight[4] = {shuffled<0, 0, 0, 0>(weights, weights), shuffled<1, 1, 1, 1>(weights, weights),
                             shuffled<2, 2, 2, 2>(weights, weights), shuffled<3, 3, 3, 3>(weights, weights)};
        for (int slot = 0; slot < Count; ++slot) {
            const float* low = job.palette + static_cast<long>(joints[i * kInfluences + slot]) * kMatrixFloats;
            const float* high =
                job.palette + static_cast<long>(joints[(i + 4) % kLanes * kInfluences + slot]) * kMatrixFloats;
            for (int row = 0; row < 3; ++row) {
                const F part = weight[slot] * halves(low + row * 4L, high + row * 4L);
                m[row][i] = slot == 0 ? part : m[row][i] + part;
            }
        }
    }
    for (F(&row)[4] : m)
        transpose4(row[0], row[1], row[2], row[3]);
}

#endif

LUTKA_LANES V3 turned(const F (&m)[3][4], const V3& v) {
    const V3 t{(m[0][0] * v.x + m[0][1] * v.y) + m[0][2] * v.z, (m[1][0] * v.x + m[1][1] * v.y) + m[1][2] * v.z,
               (m[2][0] * v.x + m[2][1] * v.y) + m[2][2] * v.z};
    return t * (all(1.0F) / squareRoot(dot(t, t)));
}

template <int Count>
LUTKA_LANES void skinLanes(const SkinJob& job, long first) {
    F m[3][4];
    blend<Count>(job, first, job.joints + first * kInfluences, m);
    const V3 p = loadVectors(job.positions + first * 3);
    storeVectors(job.outPositions + first * 3, {(m[0][0] * p.x + m[0][1] * p.y) + (m[0][2] * p.z + m[0][3]),
                                                (m[1][0] * p.x + m[1][1] * p.y) + (m[1][2] * p.z + m[1][3]),
                                                (m[2][0] * p.x + m[2][1] * p.y) + (m[2][2] * p.z + m[2][3])});
    if (job.normals != nullptr)
        storeVectors(job.outNormals + first * 3, turned(m, loadVectors(job.normals + first * 3)));
    if (job.tangents != nullptr) {
        static constexpr long offset[8] = {0, 4, 8, 12, 16, 20, 24, 28};
        F tangent[4];
        gather4(job.tangents + first * 4, offset, tangent);
        const V3 out = turned(m, {tangent[0], tangent[1], tangent[2]});
        scatter4(job.outTangents + first * 4, offset, out.x, out.y, out.z, tangent[3]);
    }
}

[[maybe_unused]] static void skin(const SkinJob& job) {
    long vertex = 0;
    for (; vertex + kLanes <= job.vertexCount; vertex += kLanes) {
        switch (influencesOf(job.weights + vertex * kInfluences)) {
            case 1:
                skinLanes<1>(job, vertex);
                break;
            case 2:
                skinLanes<2>(job, vertex);
                break;
            case 3:
                skinLanes<3>(job, vertex);
                break;
            default:
                skinLanes<4>(job, vertex);
                break;
        }
    }
    for (; vertex < job.vertexCount; ++vertex)
        skinOne(job, vertex);
}

}  // namespace lutka::animation::wide::LUTKA_KERNELS
