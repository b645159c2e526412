#pragma once

/// Linear blend skinning, a vertex a lane. The sums are those of the scalar loop, term by term, so that both give the
/// same bits.

#include "animation/wide/layout.hpp"
#include "core/simd/lane_shuffles.hpp"

namespace lutka::animation::wide::LUTKA_KERNELS {

using namespace simd::LUTKA_KERNELS;

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

/// How the matrices of the vertices that fill a register are made: of `same` joints for all of them, or of each
/// vertex's own. The number is the most joints that one of them has; with one its weight is exactly 1.
enum class Blend : unsigned char { same1, same2, same3, same4, own1, own2, own3, own4 };
static constexpr int kBlends = 8;
static constexpr int kBitsOfOne = 0x3F800000;
/// A palette with more of them is left to the plain loop: offsets into it have sixteen bits.
static constexpr long kMostJoints = 65536 / (kMatrixFloats / 2);

// For kLanes vertices: bit c is set where column c of the weights is that of (1, 0, 0, 0) in all of them.
LUTKA_LANES unsigned plainColumns(const float* weights) {
#if LUTKA_LANE_COUNT == 8 && defined(__AVX2__)
    const auto row = [&](int i) { return _mm256_castps_si256(_mm256_loadu_ps(weights + i * 8)); };
    const __m256i one = _mm256_set_epi32(0, 0, 0, kBitsOfOne, 0, 0, 0, kBitsOfOne);
    const __m256i differing = ((row(0) ^ one) | (row(1) ^ one)) | ((row(2) ^ one) | (row(3) ^ one));
    const __m256i none = _mm256_cmpeq_epi32(differing, _mm256_setzero_si256());
    const auto bits = static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(none)));
    return bits & (bits >> 4);
#elif LUTKA_LANE_COUNT == 4 && defined(__SSE2__)
    const auto row = [&](int i) { return _mm_castps_si128(_mm_loadu_ps(weights + i * 4)); };
    const __m128i one = _mm_set_epi32(0, 0, 0, kBitsOfOne);
    const __m128i differing = ((row(0) ^ one) | (row(1) ^ one)) | ((row(2) ^ one) | (row(3) ^ one));
    const __m128i none = _mm_cmpeq_epi32(differing, _mm_setzero_si128());
    return static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(none)));
#else
    unsigned bits = 15;
    for (int i = 0; i < kLanes * kInfluences; ++i) {
        const float plain = i % kInfluences == 0 ? 1.0F : 0.0F;
        if (weights[i] != plain) bits &= ~(1U << (i % kInfluences));
    }
    return bits;
#endif
}

// Likewise: bits 2 c and 2 c + 1 are set where column c of the joints is the same in all of them.
LUTKA_LANES unsigned sameColumns(const std::uint16_t* joints) {
#if LUTKA_LANE_COUNT == 8 && defined(__AVX2__)
    const auto row = [&](int i) { return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(joints + i * 16)); };
    const __m256i first = _mm256_broadcastq_epi64(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(joints)));
    const __m256i same = _mm256_cmpeq_epi16(row(0), first) & _mm256_cmpeq_epi16(row(1), first);
    const auto bytes = static_cast<unsigned>(_mm256_movemask_epi8(same));
    const unsigned bits = bytes & (bytes >> 16);
    return bits & (bits >> 8);
#elif LUTKA_LANE_COUNT == 4 && defined(__SSE2__)
    const auto row = [&](int i) { return _mm_loadu_si128(reinterpret_cast<const __m128i*>(joints + i * 8)); };
    const __m128i two = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(joints));
    const __m128i first = _mm_unpacklo_epi64(two, two);
    const __m128i same = _mm_cmpeq_epi16(row(0), first) & _mm_cmpeq_epi16(row(1), first);
    const auto bits = static_cast<unsigned>(_mm_movemask_epi8(same));
    return bits & (bits >> 8);
#else
    unsigned bits = 255;
    for (int i = 0; i < kLanes * kInfluences; ++i)
        if (joints[i] != joints[i % kInfluences]) bits &= ~(3U << (2 * (i % kInfluences)));
    return bits;
#endif
}

LUTKA_LANES Blend blendOf(const SkinJob& job, long first) {
    // Weights are sorted, so that the last column that is not plain tells how many count.
    static constexpr unsigned char columns[16] = {3, 3, 3, 3, 3, 3, 3, 3, 2, 2, 2, 2, 1, 1, 1, 0};
    const unsigned last = columns[plainColumns(job.weights + first * kInfluences)];
    const unsigned needed = (4U << (2 * last)) - 1;
    const bool same = (~sameColumns(job.joints + first * kInfluences) & needed) == 0;
    return static_cast<Blend>(last + (same ? 0U : 4U));
}

#if LUTKA_LANE_COUNT == 8 && defined(__AVX2__)

LUTKA_LANES F lowHalves(const F& a, const F& b) {
    return reinterpret_cast<F>(_mm256_permute2f128_ps(reinterpret_cast<__m256>(a), reinterpret_cast<__m256>(b), 0x20));
}
LUTKA_LANES F highHalves(const F& a, const F& b) {
    return reinterpret_cast<F>(_mm256_permute2f128_ps(reinterpret_cast<__m256>(a), reinterpret_cast<__m256>(b), 0x31));
}

// The blended matrix of one vertex: its first two rows fill a register, the third goes to `third`.
template <int Count>
LUTKA_LANES F blendOne(const SkinJob& job, long vertex, const std::uint16_t (&offsets)[kInfluences], float* third) {
    __m256 upper;
    __m128 lower;
    for (int slot = 0; slot < Count; ++slot) {
        const float* from = job.palette + static_cast<long>(offsets[slot]) * 2;
        const __m256 weight = _mm256_broadcast_ss(job.weights + vertex * kInfluences + slot);
        const __m256 upperPart = weight * _mm256_loadu_ps(from);
        const __m128 lowerPart = _mm256_castps256_ps128(weight) * _mm_loadu_ps(from + 8);
        upper = slot == 0 ? upperPart : upper + upperPart;
        lower = slot == 0 ? lowerPart : lower + lowerPart;
    }
    _mm_store_ps(third, lower);
    return reinterpret_cast<F>(upper);
}

// The blended matrices of kLanes vertices, m[row][column].
template <int Count>
LUTKA_LANES void blendOwn(const SkinJob& job, long first, F (&m)[3][4]) {
    // Where each matrix begins, in pairs of floats: that factor comes free with an address.
    alignas(32) std::uint16_t offsets[8][kInfluences];
    for (int half = 0; half < 2; ++half) {
        const std::uint16_t* joints = job.joints + (first + half * 4) * kInfluences;
        const __m256i six = _mm256_set1_epi16(kMatrixFloats / 2);
        const __m256i four = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(joints));
        _mm256_store_si256(reinterpret_cast<__m256i*>(offsets[half * 4]), _mm256_mullo_epi16(four, six));
    }
    alignas(32) float third[8][4];
    F low[4];
    F high[4];
    for (int i = 0; i < 4; ++i)
        low[i] = blendOne<Count>(job, first + i, offsets[i], third[i]);
    transpose4(low[0], low[1], low[2], low[3]);  // [row 0 of the first four vertices | row 1]
    for (int i = 0; i < 4; ++i)
        high[i] = blendOne<Count>(job, first + 4 + i, offsets[4 + i], third[4 + i]);
    transpose4(high[0], high[1], high[2], high[3]);
    for (int column = 0; column < 4; ++column) {
        m[0][column] = lowHalves(low[column], high[column]);
        m[1][column] = highHalves(low[column], high[column]);
        m[2][column] = halves(third[column], third[column + 4]);
    }
    transpose4(m[2][0], m[2][1], m[2][2], m[2][3]);
}

#else

// The blended matrices of kLanes vertices, m[row][column]: each influence of vertex i (and i + 4) is added to its rows,
// and the rows of four vertices become columns.
template <int Count>
LUTKA_LANES void blendOwn(const SkinJob& job, long first, F (&m)[3][4]) {
    for (int i = 0; i < 4; ++i) {
        const float* own = job.weights + (first + i) * kInfluences;
        const F weights = halves(own, kLanes == 8 ? own + 16 : own);
        const F weight[4] = {shuffled<0, 0, 0, 0>(weights, weights), shuffled<1, 1, 1, 1>(weights, weights),
                             shuffled<2, 2, 2, 2>(weights, weights), shuffled<3, 3, 3, 3>(weights, weights)};
        for (int slot = 0; slot < Count; ++slot) {
            const float* low =
                job.palette + static_cast<long>(job.joints[(first + i) * kInfluences + slot]) * kMatrixFloats;
            const float* high =
                job.palette +
                static_cast<long>(job.joints[(first + (i + 4) % kLanes) * kInfluences + slot]) * kMatrixFloats;
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

// The matrices of kLanes vertices whose joints are the same: no gathering.
template <int Count>
LUTKA_LANES void blendSame(const SkinJob& job, long first, F (&m)[3][4]) {
    static constexpr long offset[8] = {0, 4, 8, 12, 16, 20, 24, 28};
    const float* matrices[Count];
    for (int slot = 0; slot < Count; ++slot)
        matrices[slot] = job.palette + static_cast<long>(job.joints[first * kInfluences + slot]) * kMatrixFloats;
    F weights[4];
    if constexpr (Count > 1) gather4(job.weights + first * kInfluences, offset, weights);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            F sum = all(matrices[0][row * 4 + column]);
            if constexpr (Count > 1) sum = weights[0] * sum;
            for (int slot = 1; slot < Count; ++slot)
                sum = sum + weights[slot] * all(matrices[slot][row * 4 + column]);
            m[row][column] = sum;
        }
    }
}

// The matrices of kLanes vertices with one joint each.
LUTKA_LANES void gatherMatrices(const SkinJob& job, long first, F (&m)[3][4]) {
    long offset[kMostLanes];
    for (int lane = 0; lane < kLanes; ++lane)
        offset[lane] = static_cast<long>(job.joints[(first + lane) * kInfluences]) * kMatrixFloats;
    for (int row = 0; row < 3; ++row)
        gather4(job.palette + row * 4L, offset, m[row]);
}

template <Blend How>
LUTKA_LANES void matricesOf(const SkinJob& job, long first, F (&m)[3][4]) {
    constexpr int count = static_cast<int>(How) % 4 + 1;
    if constexpr (How <= Blend::same4)
        blendSame<count>(job, first, m);
    else if constexpr (count == 1)
        gatherMatrices(job, first, m);
    else
        blendOwn<count>(job, first, m);
}

LUTKA_LANES V3 turned(const F (&m)[3][4], const V3& v) {
    return {(m[0][0] * v.x + m[0][1] * v.y) + m[0][2] * v.z, (m[1][0] * v.x + m[1][1] * v.y) + m[1][2] * v.z,
            (m[2][0] * v.x + m[2][1] * v.y) + m[2][2] * v.z};
}
LUTKA_LANES V3 unit(const V3& v) {
    return v * (all(1.0F) / squareRoot(dot(v, v)));
}

// Returns the normals before they have unit length.
template <Blend How>
LUTKA_LANES V3 skinLanes(const SkinJob& job, long first) {
    F m[3][4];
    matricesOf<How>(job, first, m);
    const V3 p = loadVectors(job.positions + first * 3);
    storeVectors(job.outPositions + first * 3, {(m[0][0] * p.x + m[0][1] * p.y) + (m[0][2] * p.z + m[0][3]),
                                                (m[1][0] * p.x + m[1][1] * p.y) + (m[1][2] * p.z + m[1][3]),
                                                (m[2][0] * p.x + m[2][1] * p.y) + (m[2][2] * p.z + m[2][3])});
    if (job.tangents != nullptr) {
        static constexpr long offset[8] = {0, 4, 8, 12, 16, 20, 24, 28};
        F tangent[4];
        gather4(job.tangents + first * 4, offset, tangent);
        const V3 out = unit(turned(m, {tangent[0], tangent[1], tangent[2]}));
        scatter4(job.outTangents + first * 4, offset, out.x, out.y, out.z, tangent[3]);
    }
    return job.normals != nullptr ? turned(m, loadVectors(job.normals + first * 3)) : V3{};
}

// Registers of vertices of a stretch of the mesh, sorted by how they are done: a branch for each of them in turn would
// be mispredicted too often. Short enough to stay in the nearest cache.
struct Stretch {
    static constexpr int kRegisters = 64;
    unsigned char members[kBlends][kRegisters];
    int counts[kBlends];
};

// The last register ends with the mesh: it may do some of the vertices of the one before again.
LUTKA_LANES long firstOf(const SkinJob& job, long member) {
    const long first = member * kLanes;
    return first + kLanes <= job.vertexCount ? first : job.vertexCount - kLanes;
}

LUTKA_LANES void sortStretch(const SkinJob& job, long begin, int size, Stretch& stretch) {
    for (int& count : stretch.counts)
        count = 0;
    for (int i = 0; i < size; ++i) {
        const long first = firstOf(job, begin + i);
        const int how = static_cast<int>(blendOf(job, first));
        stretch.members[how][stretch.counts[how]++] = static_cast<unsigned char>(i);
    }
}

// Normals that are still to be brought to unit length. That is done while the next register is at work: the square root
// and the division take about as long as the processor can look ahead.
struct Pending {
    V3 normals;
    long first;  // < 0: none
};
LUTKA_LANES void finish(const SkinJob& job, const Pending& pending) {
    if (job.normals != nullptr && pending.first >= 0)
        storeVectors(job.outNormals + pending.first * 3, unit(pending.normals));
}

// `job` by value: what is stored through its pointers can't change it, so that it stays in registers.
template <Blend How>
static void skinAll(const SkinJob job, long begin, const Stretch& stretch, Pending& pending) {
    const unsigned char* members = stretch.members[static_cast<int>(How)];
    const int count = stretch.counts[static_cast<int>(How)];
    if (count == 0) return;
    Pending last = pending;
    for (int i = 0; i < count; ++i) {
        finish(job, last);
        last.first = firstOf(job, begin + members[i]);
        last.normals = skinLanes<How>(job, last.first);
    }
    pending = last;
}

[[maybe_unused]] static void skin(const SkinJob& job) {
    if (job.vertexCount < kLanes || job.jointCount > kMostJoints) {
        skinByScalars(job);
        return;
    }
    const long registers = (job.vertexCount + kLanes - 1) / kLanes;
    Stretch stretch;
    Pending pending;
    pending.first = -1;
    for (long begin = 0; begin < registers; begin += Stretch::kRegisters) {
        const long left = registers - begin;
        sortStretch(job, begin, static_cast<int>(left < Stretch::kRegisters ? left : Stretch::kRegisters), stretch);
        skinAll<Blend::same1>(job, begin, stretch, pending);
        skinAll<Blend::same2>(job, begin, stretch, pending);
        skinAll<Blend::same3>(job, begin, stretch, pending);
        skinAll<Blend::same4>(job, begin, stretch, pending);
        skinAll<Blend::own1>(job, begin, stretch, pending);
        skinAll<Blend::own2>(job, begin, stretch, pending);
        skinAll<Blend::own3>(job, begin, stretch, pending);
        skinAll<Blend::own4>(job, begin, stretch, pending);
    }
    finish(job, pending);
}

}  // namespace lutka::animation::wide::LUTKA_KERNELS
