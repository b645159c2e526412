#pragma once

/// From bodies or joint-relative frames to model-space frames and palettes, an instance a lane: what poseFromBodies(),
/// localToModel() and skinMatrices() do for one.

#include "animation/wide/layout.hpp"
#include "core/simd/lane_shuffles.hpp"

namespace lutka::animation::wide::LUTKA_KERNELS {

using namespace simd::LUTKA_KERNELS;

static constexpr long kRigidLanes = static_cast<long>(kRigidFloats) * kLanes;  // floats of a Rigid in scratch

// modelFromJoint · bindModelFromJoint⁻¹ as rows, to every lane's palette.
LUTKA_LANES void scatterMatrix(float* to, const long* offset, const Rigid& model, const float* bind) {
    const Q q = model.turn * conjugate(allTurns(bind));
    const Axes axes = axesOf(q);
    const V3 at{all(bind[4]), all(bind[5]), all(bind[6])};
    const V3 row0{axes.x.x, axes.y.x, axes.z.x};
    const V3 row1{axes.x.y, axes.y.y, axes.z.y};
    const V3 row2{axes.x.z, axes.y.z, axes.z.z};
    scatter4(to, offset, row0.x, row0.y, row0.z, model.at.x - dot(row0, at));
    scatter4(to + 4, offset, row1.x, row1.y, row1.z, model.at.y - dot(row1, at));
    scatter4(to + 8, offset, row2.x, row2.y, row2.z, model.at.z - dot(row2, at));
}

// Taylor's series, to 1e-7 on [0, π/2].
LUTKA_LANES F sine(const F& a) {
    const F s = a * a;
    F p = all(-1.0F / 39916800.0F);
    p = p * s + all(1.0F / 362880.0F);
    p = p * s - all(1.0F / 5040.0F);
    p = p * s + all(1.0F / 120.0F);
    p = p * s - all(1.0F / 6.0F);
    return (p * s + all(1.0F)) * a;
}
LUTKA_LANES F cosine(const F& a) {
    const F s = a * a;
    F p = all(1.0F / 479001600.0F);
    p = p * s - all(1.0F / 3628800.0F);
    p = p * s + all(1.0F / 40320.0F);
    p = p * s - all(1.0F / 720.0F);
    p = p * s + all(1.0F / 24.0F);
    p = p * s - all(0.5F);
    return p * s + all(1.0F);
}

// The part of a rotation along its shorter arc.
LUTKA_LANES Q partOf(const Q& q, const F& share) {
    const F sign = q.w < all(0.0F) ? all(-1.0F) : all(1.0F);
    const F length = squareRoot(q.x * q.x + q.y * q.y + q.z * q.z);
    const F half = share * angleOf(length, q.w * sign);
    // For no rotation at all the ratio is the share itself.
    const F scale = sign * (length > all(1e-12F) ? sine(half) / most(length, all(1e-12F)) : share);
    return {q.x * scale, q.y * scale, q.z * scale, cosine(half)};
}

// What is left of q about `axis` when the swing across it is taken away.
LUTKA_LANES Q twistAbout(const Q& q, const V3& axis) {
    const F along = q.x * axis.x + q.y * axis.y + q.z * axis.z;
    const F length = squareRoot(q.w * q.w + along * along);
    const F scale = all(1.0F) / most(length, all(1e-6F));
    const F none = all(0.0F);
    const F part = length < all(1e-6F) ? none : along * scale;
    return {axis.x * part, axis.y * part, axis.z * part, length < all(1e-6F) ? all(1.0F) : q.w * scale};
}

LUTKA_LANES Rigid between(const Rigid& a, const Rigid& b, const F& alpha) {
    const F along = a.turn.x * b.turn.x + a.turn.y * b.turn.y + a.turn.z * b.turn.z + a.turn.w * b.turn.w;
    const F from = all(1.0F) - alpha;
    const F to = along < all(0.0F) ? -alpha : alpha;
    const Q mixed{a.turn.x * from + b.turn.x * to, a.turn.y * from + b.turn.y * to, a.turn.z * from + b.turn.z * to,
                  a.turn.w * from + b.turn.w * to};
    return {normalised(mixed), a.at + (b.at - a.at) * alpha};
}

// Bodies of every lane in model space, and how far each has turned from the bind pose.
LUTKA_LANES void gatherBodies(const FollowJob& job, float* bodies, float* turns) {
    long doll[kMostLanes];
    long placed[kMostLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
        const long first = job.firstBody != nullptr ? job.firstBody[job.dolls[lane]]
                                                    : static_cast<long>(job.dolls[lane]) * job.bodyCount;
        doll[lane] = first * kRigidFloats;
        placed[lane] = static_cast<long>(job.dolls[lane]) * kRigidFloats;
    }
    const Rigid modelFromWorld = inverse(gatherRigid(job.worldFromModel, placed));
    const bool mix = job.alpha < 1.0F;
    for (int body = 0; body < job.bodyCount; ++body) {
        Rigid frame = gatherRigid(job.present + body * kRigidFloats, doll);
        if (mix) frame = between(gatherRigid(job.previous + body * kRigidFloats, doll), frame, all(job.alpha));
        const Rigid inModel = modelFromWorld * frame;
        storeRigid(bodies + body * kRigidLanes, inModel);
        const Q turn = inModel.turn * allTurns(job.bindBodyTurns + body * 4L);
        float* to = turns + body * kRigidLanes;
        storeRigid(to, {turn, inModel.at});
    }
}

LUTKA_LANES Q turnOfChain(const FollowJoint& joint, const float* turns) {
    const Q upper = loadRigid(turns + joint.upperBody * kRigidLanes).turn;
    Q rest = conjugate(upper) * loadRigid(turns + joint.body * kRigidLanes).turn;
    if (joint.twistOnly != 0) rest = twistAbout(rest, all(joint.twistAxis));
    return upper * partOf(rest, all(joint.share)) * allTurns(joint.bindModelFromJoint);
}

static void follow(const FollowJob& job) {
    float* model = job.scratch;
    float* bodies = model + job.jointCount * kRigidLanes;
    float* turns = bodies + job.bodyCount * kRigidLanes;
    gatherBodies(job, bodies, turns);
    long matrices[kMostLanes];
    long frames[kMostLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
        const long first = job.firstJoint != nullptr ? job.firstJoint[job.dolls[lane]]
                                                     : static_cast<long>(job.dolls[lane]) * job.jointCount;
        matrices[lane] = first * kMatrixFloats;
        frames[lane] = first * kRigidFloats;
    }
    for (int i = 0; i < job.jointCount; ++i) {
        const FollowJoint& joint = job.joints[i];
        Rigid out;
        if (joint.drive == FollowJoint::root) {
            out = loadRigid(bodies + joint.body * kRigidLanes) * allRigid(joint.baseFromJoint);
        } else {
            const Rigid base = loadRigid(model + joint.base * kRigidLanes);
            out.at =
                base.turn * V3{all(joint.baseFromJoint[4]), all(joint.baseFromJoint[5]), all(joint.baseFromJoint[6])} +
                base.at;
            if (joint.drive == FollowJoint::mapped)
                out.turn = loadRigid(bodies + joint.body * kRigidLanes).turn * allTurns(joint.bodyFromJointTurn);
            else if (joint.drive == FollowJoint::chain)
                out.turn = turnOfChain(joint, turns);
            else
                out.turn = base.turn * allTurns(joint.baseFromJoint);
        }
        out.turn = normalised(out.turn);
        storeRigid(model + joint.joint * kRigidLanes, out);
        if (job.palettes != nullptr)
            scatterMatrix(job.palettes + static_cast<long>(joint.joint) * kMatrixFloats, matrices, out,
                          joint.bindModelFromJoint);
        if (job.poses != nullptr) scatterRigid(job.poses + static_cast<long>(joint.joint) * kRigidFloats, frames, out);
    }
}

static void propagate(const PropagateJob& job) {
    long matrices[kMostLanes];
    long frames[kMostLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
        matrices[lane] = static_cast<long>(job.instances[lane]) * job.jointCount * kMatrixFloats;
        frames[lane] = static_cast<long>(job.instances[lane]) * job.jointCount * kRigidFloats;
    }
    for (long joint = 0; joint < job.jointCount; ++joint) {
        Rigid out = gatherRigid(job.parentFromJoint + joint * kRigidFloats, frames);
        const int parent = job.parents[joint];
        if (parent >= 0) out = loadRigid(job.scratch + parent * kRigidLanes) * out;
        storeRigid(job.scratch + joint * kRigidLanes, out);
        if (job.palettes != nullptr)
            scatterMatrix(job.palettes + joint * kMatrixFloats, matrices, out,
                          job.bindModelFromJoint + joint * kRigidFloats);
        if (job.poses != nullptr) scatterRigid(job.poses + joint * kRigidFloats, frames, out);
    }
}

}  // namespace lutka::animation::wide::LUTKA_KERNELS
