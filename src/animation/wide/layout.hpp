#pragma once

#include <cstdint>

/// The plain data that the wide kernels and the code around them share. Nothing here may have inline functions with
/// code in it: this header is compiled for several instruction sets, and the linker would keep only one copy.
///
/// A rigid transform is seven floats: the quaternion x, y, z, w, then the translation. A palette's matrix is twelve, by
/// rows.
namespace lutka::animation::wide {

inline constexpr int kRigidFloats = 7;
inline constexpr int kMatrixFloats = 12;
inline constexpr int kMostLanes = 8;

/// Linear blend skinning of a mesh, see skinVertices().
struct SkinJob {
    const float* positions;       ///< Three a vertex.
    const float* normals;         ///< Three a vertex, or null.
    const float* tangents;        ///< Four a vertex, or null.
    const std::uint16_t* joints;  ///< Four a vertex.
    const float* weights;         ///< Four a vertex, strongest first.
    const float* palette;         ///< Twelve a joint.
    long jointCount;              ///< Matrices in the palette.
    float* outPositions;          ///< The outputs share no memory with the inputs.
    float* outNormals;
    float* outTangents;
    long vertexCount;
};

/// How one joint of a doll follows, in the order of evaluation: Rig::Joint with its constants beside it.
struct FollowJoint {
    enum Drive { root, mapped, chain, follower };
    Drive drive;
    int joint;      ///< Where its results go.
    int base;       ///< The joint that its translation hangs on; unused for the root.
    int body;       ///< root, mapped, chain.
    int upperBody;  ///< chain.
    float share;    ///< chain.
    int twistOnly;  ///< chain: about `twistAxis` alone.
    float twistAxis[3];
    float baseFromJoint[7];       ///< Bind pose. root: body from joint.
    float bodyFromJointTurn[4];   ///< mapped: rotation only.
    float bindModelFromJoint[7];  ///< Also the rotation that a chain's share is put before.
};

/// Bodies to skins of one group of dolls, a doll a lane. Lanes beyond the dolls repeat one of them.
struct FollowJob {
    const FollowJoint* joints;
    int jointCount;
    const float* bindBodyTurns;  ///< Conjugate bind rotation of each body, four floats each.
    int bodyCount;
    const float* previous;        ///< Rigid, a body, in the world; unread when alpha is 1.
    const float* present;         ///< Likewise.
    float alpha;                  ///< From previous to present.
    const float* worldFromModel;  ///< A rigid transform a doll.
    const int* dolls;             ///< One a lane.
    const long* firstBody;        ///< One a doll: where its bodies begin; null: doll after doll of `bodyCount`.
    const long* firstJoint;       ///< Likewise of its joints, in matrices and frames.
    float* palettes;              ///< A matrix a joint, or null.
    float* poses;                 ///< A rigid transform in model space a joint, or null.
    float* scratch;               ///< kMostLanes × kRigidFloats × (joints + 2 bodies) floats, aligned to 32 bytes.
};

/// Joint-relative frames to skins of one group of instances, an instance a lane.
struct PropagateJob {
    const int* parents;
    int jointCount;
    const float* bindModelFromJoint;
    const float* parentFromJoint;  ///< Instances × joints.
    const int* instances;          ///< One a lane.
    float* palettes;               ///< Instances × joints matrices, or null.
    float* poses;                  ///< Instances × joints, model space, or null. May be `parentFromJoint`.
    float* scratch;                ///< kMostLanes × kRigidFloats × joints floats, aligned to 32 bytes.
};

/// Bits of SampleJob::stepped.
inline constexpr int kHeldTurn = 1;
inline constexpr int kHeldPlace = 2;
inline constexpr int kMostSampleTerms = 4;

/// Clips to joint-relative frames of one group of instances, an instance a lane: each term lies between two frames and
/// covers some of what the terms before it gave.
struct SampleJob {
    const float* frames;           ///< Rigid transforms of all clips.
    const unsigned char* stepped;  ///< One a clip and joint, what of it takes `heldAlpha`; null where nothing does.
    int jointCount;
    int termCount;                              ///< [1, kMostSampleTerms]
    long before[kMostSampleTerms][kMostLanes];  ///< Where the pose begins in `frames`, in floats.
    long after[kMostSampleTerms][kMostLanes];
    float alpha[kMostSampleTerms][kMostLanes];
    float heldAlpha[kMostSampleTerms][kMostLanes];
    long steppedRow[kMostSampleTerms][kMostLanes];
    float cover[kMostSampleTerms][kMostLanes];  ///< 0 leaves what is there to the bit; unread of the first term.
    const int* instances;                       ///< One a lane.
    float* out;                                 ///< Instances × joints.
};

struct Kernels {
    int lanes;  ///< 4 or 8.
    void (*skin)(const SkinJob& job);
    void (*skinByScalars)(const SkinJob& job);  ///< The plain loop with the same flags: what bench/ compares with.
    void (*follow)(const FollowJob& job);
    void (*propagate)(const PropagateJob& job);
    void (*sample)(const SampleJob& job);
};

}  // namespace lutka::animation::wide
