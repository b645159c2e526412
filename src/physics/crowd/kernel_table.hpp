#pragma once

/// What a translation unit that defines LUTKA_KERNELS includes to get that instruction set's kernels.

#include "physics/crowd/answer_kernels.hpp"
#include "physics/crowd/momentum_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_KERNELS {

static void begin(const BatchView& batch, const SubstepParams& params) {
    applyForces(batch, params);
    beginJoints(batch, params);
    for (int i = 0; i < batch.contactCount; ++i)
        beginStatic(batch.contacts[i], batch, params);
    findSupports(batch, params);
    for (int i = 0; i < batch.dragCount; ++i)
        beginDrag(batch.drags[i], batch, params);
    for (int j = 0; batch.motors != nullptr && j < batch.jointCount; ++j)
        if (batch.motors[j].active != 0)
            beginMotor(batch.motors[j], batch.joints[j], batch.jointConstants[j], batch, params);
    for (int b = 0; batch.targets != nullptr && b < batch.bodyCount; ++b)
        if (batch.targets[b].active != 0) beginTarget(batch.targets[b], batch.bodies[b], params);
    showBodies(batch);
}

static void takeMotions(const BatchView& batch) {
    takePushed(batch);
}

static constexpr Kernels kTable{
    &refresh,       &findBounds, &findSelfPairs, &findBodyPairs, &findBoxesAfter, &touchCores, &touchOwnCores,
    &findNearPlane, &limitRoom,  &joinBounds,    &takeWay,       &findMotion,     &begin,      &solve,
    &outruns,       &solveAgain, &needsMending,  &takeMotions,   &mendOnce,       &mendNot,    &advance,
    &beginPairs,    &solvePairs, &mendPairs,     &pressAgain,    &pressRest,      &carryPairs, &limitEnergy};

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
