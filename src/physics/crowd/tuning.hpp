#pragma once

#include <optional>

#include "physics/crowd/kernels.hpp"
#include "physics/crowd/substep_params.hpp"

namespace lutka::physics::crowd {

/// What decides quality and cost: of a substep (SubstepTuning), and of all that lies around it.
struct CrowdTuning : SubstepTuning {
    float rate = 60.0F;  ///< Steps a second that the numbers below are for; a longer step has as many more substeps.
    int substeps = 6;  ///< A step of 1 / `rate` s; >= 1. More: stiffer joints, shallower contacts, cost in proportion.
    int calmSubsteps = 3;       ///< A step in which nothing moves fast, >= 1; no more than `substeps`.
    int restSubsteps = 2;       ///< A step in which hardly anything moves in a world where nothing sleeps, likewise.
    float substepSpeed = 0.5F;  ///< m/s of a body for each substep that a step needs: above six times that it has six.
    float substepTurn = 3.0F;   ///< rad/s, likewise.
    int fastSubsteps = 4;       ///< Times `substeps` that a step of a doll by itself has at most, >= 1.
    float fastSpeed = 5.0F;     ///< Times `substepSpeed` for each of those that go beyond `substeps`,
    float fastTurn = 5.0F;      ///< and times `substepTurn`. Less: dearer, better in hits at 50 m/s and more.
    float spared = 0.2F;        ///< Substeps that the dolls of a job may be short of, a doll in the mean, while
    float deepShare = 0.01F;    ///< no more than this share of its contacts lie deep (TouchBrief), [0, 1].
    int mendEvery = 1;          ///< Errors of position are mended in every so many substeps, the last among them.

    float jointErp = 0.3F;        ///< Part of a joint's gap mended in a substep, (0, 1].
    float limitErp = 0.3F;        ///< The same for limits.
    float contactErp = 0.3F;      ///< The same for overlap.
    float staticMargin = 0.05F;   ///< Metres beyond the predicted motion within which contacts are made, with statics
    float shapeMargin = 0.015F;   ///< likewise with statics that are no planes, beyond the motion of a substep,
    float pairMargin = 0.015F;    ///< and between bodies. Static ones are cheap while nothing presses.
    float sideways = 0.5F;        ///< Part of a predicted motion between dolls that counts although it does not bring
                                  ///< two bodies together, [0, 1]. Less: fewer contacts; 1: as within a doll.
    float leastGyration = 0.05F;  ///< Metres, of a figure 1.75 m tall: no body has a smaller radius of gyration about
                                  ///< any axis; thin hands and feet are given more inertia. More: tighter, stiffer.
    float linearDamping = 0.0F;   ///< 1/s; speed decays by exp(-d t).
    float angularDamping = 0.1F;  ///< 1/s; likewise.

    float sleepSpeed = 0.02F;   ///< m/s, of every body's centre.
    float sleepTurn = 0.045F;   ///< rad/s, of every body.
    float sleepSeconds = 1.0F;  ///< For how long a doll must be below both.
    float calmSpeed = 0.15F;    ///< m/s and rad/s: below it a lying doll is braked.
    float calmDamping = 15.0F;  ///< 1/s, the brake.
    float stiction = 1.5F;      ///< Static friction over sliding friction; fades in below the calm speed.

    std::optional<InstructionSet> instructionSet;  ///< Unset: the widest that the processor has.
};

}  // namespace lutka::physics::crowd
