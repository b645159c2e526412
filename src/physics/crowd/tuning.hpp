#pragma once

#include <optional>

#include "physics/crowd/kernels.hpp"

namespace lutka::physics::crowd {

/// What decides quality and cost. The defaults are the outcome of the sweep described in docs/crowd.md.
struct CrowdTuning {
    int substeps = 6;         ///< A step; >= 1. More: stiffer joints, shallower contacts, cost in proportion.
    int passes = 8;           ///< At most, with bias in a substep, >= 1: until the guess of what holds is right.
    int mendEvery = 1;        ///< Errors of position are mended in every so many substeps, the last among them.
    int patience = 3;         ///< Passes after which rows that will not come to rest are only added any more.
    float aimGap = 0.0003F;   ///< Metres by which an anchor may miss in a substep before its arm is foreseen anew.
    float letGo = 2.0F;       ///< By how much faster a contact between bodies takes back what it pressed too much.
    float nearSpeed = 8.0F;   ///< m/s that an approach may grow by within a substep: contacts farther off are left out.
    float mendGap = 0.0002F;  ///< Metres, and
    float mendAngle = 0.002F;       ///< rad: errors below which nothing is mended.
    float contactTolerance = 0.1F;  ///< m/s by which the guess of which contacts hold may be wrong.
    float limitTolerance = 1.0F;    ///< rad/s, the same of limits.

    float jointErp = 0.3F;          ///< Part of a joint's gap mended in a substep, (0, 1].
    float limitErp = 0.2F;          ///< The same for limits.
    float contactErp = 0.3F;        ///< The same for overlap.
    float jointStiffness = 300.0F;  ///< Weight of rows that hold over the local effective mass. More: quicker, rougher.
    float limitStiffness = 30.0F;   ///< The same of limits, and
    float contactStiffness = 100.0F;  ///< static contacts.
    float stiffen = 4.0F;             ///< Factor on a static contact's weight a pass in which it gives way,
    float stiffest = 300.0F;          ///< up to this weight over the body's mass.
    float firstTouch = 40.0F;         ///< Of both while they are still ahead: a wrong guess there pulls.
    float grip = 1.0F;                ///< The same of friction. More: quicker to grip, chatters.
    float pushSpeed = 2.0F;           ///< m/s, largest speed that overlap is pushed apart with.
    float limitSpeed = 6.0F;          ///< rad/s, the same for limits.
    float slop = 0.0005F;             ///< Metres of overlap left alone, so that resting contacts stay.
    float staticMargin = 0.05F;   ///< Metres beyond the predicted motion within which contacts are made, with statics
    float pairMargin = 0.015F;    ///< and between bodies. Static ones are cheap while nothing presses.
    float rollingLever = 0.004F;  ///< Metres, rolling resistance: flesh is no ideal cylinder.
    float leastGyration = 0.05F;  ///< Metres, of a figure 1.75 m tall: no body has a smaller radius of gyration about
                                  ///< any axis; thin hands and feet are given more inertia. More: tighter, stiffer.
    float linearDamping = 0.0F;   ///< 1/s; speed decays by exp(-d t).
    float angularDamping = 0.1F;  ///< 1/s; likewise.

    float sleepSpeed = 0.02F;    ///< m/s, of every body's centre.
    float sleepTurn = 0.045F;    ///< rad/s, of every body.
    float sleepSeconds = 1.0F;   ///< For how long a doll must be below both.
    float calmSpeed = 0.15F;     ///< m/s and rad/s: below it a lying doll is braked.
    float calmDamping = 15.0F;   ///< 1/s, the brake.
    float jointStiction = 3.0F;  ///< Friction of a joint at rest over that of one that turns, less 1;
    float stictionRate = 4.0F;   ///< fades out up to so many rad/s.
    float stiction = 1.5F;       ///< Static friction over sliding friction; fades in below the calm speed.

    std::optional<InstructionSet> instructionSet;  ///< Unset: the widest that the processor has.
};

}  // namespace lutka::physics::crowd
