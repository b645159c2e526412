#pragma once

namespace lutka::physics::crowd {

/// What decides quality and cost within a substep; the same for all of them. The defaults are the outcome of the sweep
/// described in docs/crowd-experiments.md.
struct SubstepTuning {
    int passes = 8;          ///< At most, with bias in a substep, >= 1: until the guess of what holds is right.
    int patience = 3;        ///< Passes after which rows that will not come to rest are only added any more.
    float aimGap = 0.0003F;  ///< Metres by which an anchor may miss in a substep before its arm is foreseen anew.
    float mendRate = 1.6F;   ///< By how much more the sweeps that mend overlap within a doll press than the two bodies'
                             ///< masses ask.
    float mendHaste = 3.0F;  ///< Factor on the speed with which overlap of jointed bodies is mended.
    int mendSweeps = 2;      ///< Over the contacts between bodies, in each mending.
    float wedgeDepth = 0.005F;    ///< Metres of overlap within a limp doll from which on its own contacts are mended
                                  ///< together, with all that hangs on their bodies. Less: costs more, rests later.
    float wedgeFirmness = 10.0F;  ///< Factor on the stiffness of its static contacts meanwhile. Less: what is pushed by
                                  ///< a whole body gives way into the floor; more: less comes apart.
    float supportPassed = 0.97F;  ///< How firmly what rests on a body is held, of how firmly that body is, [0, 1).
    float supportKept = 0.95F;    ///< What is left of it a substep later once nothing presses.
    int answerSweeps = 2;       ///< At most, over the contacts between dolls after these have answered; 0: none. More:
                                ///< stiffer heaps, and the dolls' cost again for each.
    float answerSpeed = 0.02F;  ///< m/s by which a contact may be wrong to be left out of them. Less: the same.
    int ownSweeps = 12;         ///< The same over contacts between bodies of one doll; in a job of several batches no
                                ///< more than `answerSweeps`. Less: blows drive limbs deeper into the trunk.
    float ownDepth = 0.0005F;   ///< Metres that such a contact may go deep by the substep's end before it is one of
                                ///< them. More: limbs sink into the trunk, and mending fights the limits for ever.
    float ownSpeed = 0.05F;     ///< m/s that it closes with, else it is none of them. Less: some figures never rest.
    float heapDepth = 0.002F;   ///< Both in heaps (isHeap), in which an answer costs all dolls a look.
    float heapSpeed = 0.1F;
    float ownMass = 8.0F;     ///< By how much more than its two bodies' masses ask one is pressed at most, as the
                              ///< answers show what hangs on them.
    float ownBlow = 10.0F;    ///< m/s that it is pressed against at most, at that mass.
    float ownLoad = 0.5F;     ///< m/s times the two bodies' mass that a load may begin with; it at most doubles in a
                              ///< substep. More: blows go on as loads and gain energy.
    float nearSpeed = 8.0F;   ///< m/s that an approach may grow by within a substep: contacts farther off are left out.
    float mendGap = 0.0002F;  ///< Metres, and
    float mendAngle = 0.002F;       ///< rad: errors below which nothing is mended.
    float contactTolerance = 0.1F;  ///< m/s by which the guess of which contacts hold may be wrong.
    float limitTolerance = 1.0F;    ///< rad/s, the same of limits.

    float jointStiffness = 300.0F;  ///< Weight of rows that hold over the local effective mass. More: quicker, rougher.
    float limitStiffness = 30.0F;   ///< The same of limits, and
    float contactStiffness = 100.0F;  ///< static contacts.
    float stiffen = 4.0F;             ///< Factor on a static contact's weight a pass in which it gives way,
    float stiffest = 300.0F;          ///< up to this weight over the body's mass.
    float firstTouch = 40.0F;         ///< Of both while they are still ahead: a wrong guess there pulls.
    float grip = 1.0F;                ///< The same of friction. More: quicker to grip, chatters.
    float pushSpeed = 2.0F;           ///< m/s, largest speed that overlap is pushed apart with,
    float dollPushSpeed = 6.0F;       ///< and that of dolls with dolls. More: single falls gain energy by the first.
    float ownPushSpeed = 0.6F;     ///< Likewise of bodies of one limp doll. More: light limbs are thrown into others.
    float drivenPushSpeed = 0.1F;  ///< Likewise of bodies of one doll with muscles: it is seen where all else is calm.
    float limitSpeed = 25.0F;      ///< rad/s, the same for limits.
    float slop = 0.0005F;          ///< Metres of overlap left alone, so that resting contacts stay.
    float rollingLever = 0.004F;   ///< Metres, rolling resistance: flesh is no ideal cylinder.
    float jointStiction = 3.0F;    ///< Friction of a joint at rest over that of one that turns, less 1;
    float stictionRate = 4.0F;     ///< fades out up to so many rad/s.
};

/// Passes of a mending at most, until it runs through nothing.
inline constexpr int kMendPasses = 4;

/// What a substep needs.
struct SubstepParams : SubstepTuning {
    float dt;
    float inverseDt;
    float gravity[3];
    float linearDamping;   ///< Factor on the speed, a substep.
    float angularDamping;  ///< Likewise.
    float jointRate;       ///< 1/s: the speed over the error that it is mended with.
    float limitRate;       ///< Likewise.
    float contactRate;     ///< Likewise.
    float remaining;       ///< Seconds from the substep's start to the step's end.
    int isHeap;            ///< Whether the job is of several batches of dolls.
    int warmStart;         ///< The first substep of a step makes the carried friction impulses its own.
};

}  // namespace lutka::physics::crowd
