#pragma once

/// Between the bodies of a batch, one doll a lane, and what pair contacts see of them, one body a register
/// (BodyMotion, BodyFrame). A contact's two bodies lie in any lanes of any batches: read number by number there, each
/// would cost twelve cache lines and as many loads as it has numbers.

#include "physics/crowd/body_kernels.hpp"

namespace lutka::physics::crowd::LUTKA_KERNELS {

// Eight numbers of eight bodies.
struct Columns {
    F column[kLanes];
};
LUTKA_LANES V3 first3(const Columns& c) {
    return {c.column[0], c.column[1], c.column[2]};
}
LUTKA_LANES V3 second3(const Columns& c) {
    return {c.column[3], c.column[4], c.column[5]};
}
LUTKA_LANES Symmetric symmetricOf(const Columns& c) {
    return {c.column[0], c.column[1], c.column[2], c.column[3], c.column[4], c.column[5]};
}

using Indices = int const (&)[kLanes];

// Row `row` of eight records that begin with rows of eight floats.
template <class Record>
LUTKA_LANES Columns readRows(const Record* records, Indices index, int row) {
    Columns c;
    for (int lane = 0; lane < kLanes; ++lane)
        c.column[lane] = loadLanes(reinterpret_cast<const float*>(records + index[lane]) + row * kLanes);
    transpose(c.column);
    return c;
}
// Lane 0 is written last: lanes without a contact repeat it.
template <class Record>
LUTKA_LANES void writeRows(Record* records, Indices index, int row, Columns c) {
    transpose(c.column);
    for (int lane = kLanes - 1; lane >= 0; --lane)
        storeLanes(reinterpret_cast<float*>(records + index[lane]) + row * kLanes, c.column[lane]);
}

// The columns of BodyMotion's notes.
constexpr int kPressedColumn = 6;
constexpr int kStruckColumn = 7;

// The rows of BodyFrame.
constexpr int kPlaceRow = 0;
constexpr int kInertiaRow = 1;
constexpr int kSupportRow = 2;
constexpr int kHalfColumn = 6;  // of kPlaceRow
constexpr int kRisesColumn = 7;

LUTKA_LANES Columns columnsOf(const V3& first, const V3& second) {
    const F zero = all(0.0F);
    return {{first.x, first.y, first.z, second.x, second.y, second.z, zero, zero}};
}

// Where a body of the batch is kept, lane by lane.
LUTKA_LANES void placesOf(const BatchView& batch, int body, int (&index)[kLanes]) {
    for (int lane = 0; lane < kLanes; ++lane)
        index[lane] = batch.firstBody[lane] + body;
}

static void showMotions(const BatchView& batch) {
    for (int i = 0; i < batch.pairedCount; ++i) {
        int index[kLanes];
        placesOf(batch, batch.paired[i], index);
        const BodyLanes& body = batch.bodies[batch.paired[i]];
        writeRows(batch.pairBodies.motions, index, 0, columnsOf(load(body.velocity), load(body.angular)));
    }
}

static void showBodies(const BatchView& batch) {
    showMotions(batch);
    BodyFrame* frames = batch.pairBodies.frames;
    for (int i = 0; i < batch.pairedCount; ++i) {
        int index[kLanes];
        placesOf(batch, batch.paired[i], index);
        const BodyLanes& body = batch.bodies[batch.paired[i]];
        const Symmetric inertia = load(body.inverseInertia);
        Columns place = columnsOf(load(body.position), load(body.axisY));
        place.column[kHalfColumn] = all(batch.bodyConstants[batch.paired[i]].extent[1]);
        writeRows(frames, index, kPlaceRow, place);
        writeRows(frames, index, kInertiaRow,
                  columnsOf({inertia.xx, inertia.yy, inertia.zz}, {inertia.xy, inertia.xz, inertia.yz}));
        writeRows(frames, index, kSupportRow, columnsOf(load(body.support), load(body.axisX)));
    }
}

// Marks the bodies of the dolls in some lanes (BodyFrame::rises).
static void showRises(const BatchView& batch, const Mask& rises) {
    const unsigned lanes = bits(rises);
    for (int i = 0; i < batch.pairedCount; ++i)
        for (int lane = 0; lane < kLanes; ++lane)
            batch.pairBodies.frames[batch.firstBody[lane] + batch.paired[i]].rises =
                (lanes >> static_cast<unsigned>(lane) & 1U) != 0 ? 1.0F : 0.0F;
}

// What pair contacts have made of the bodies' velocities: whether any was pressed again (Pressed), and what else than
// the doll itself presses it (Struck).
struct Taken {
    F pressed, struck;
};
static Taken takePushed(const BatchView& batch) {
    Taken taken{all(0.0F), all(0.0F)};
    for (int i = 0; i < batch.pairedCount; ++i) {
        int index[kLanes];
        placesOf(batch, batch.paired[i], index);
        const Columns motion = readRows(batch.pairBodies.motions, index, 0);
        BodyLanes& body = batch.bodies[batch.paired[i]];
        store(body.velocity, first3(motion));
        store(body.angular, second3(motion));
        taken.pressed = most(taken.pressed, motion.column[kPressedColumn]);
        taken.struck = most(taken.struck, motion.column[kStruckColumn]);
    }
    return taken;
}

static void takeSupports(const BatchView& batch) {
    for (int i = 0; i < batch.pairedCount; ++i) {
        int index[kLanes];
        placesOf(batch, batch.paired[i], index);
        store(batch.bodies[batch.paired[i]].support, first3(readRows(batch.pairBodies.frames, index, kSupportRow)));
    }
}

}  // namespace lutka::physics::crowd::LUTKA_KERNELS
