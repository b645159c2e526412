#include "physics/crowd/reports.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace lutka::physics::crowd {
namespace {

using Side = ContactReport::Side;

void add(const Wide& impulse, Wide& sum) {
    for (int lane = 0; lane < kLanes; ++lane)
        sum.lane[lane] += impulse.lane[lane];
}

void reportStatics(CrowdState& state, const Batch& batch) {
    for (const StaticPush& push : batch.pushes) {
        ContactReport report;
        report.a = state.dolls[batch.doll[push.lane]].side;
        report.a.body = push.body;
        report.b = {Side::Kind::fixed, {}, {}, state.staticIds[geometryOfKey(push.key)], 0};
        report.position = push.position;
        report.normal = push.normal;
        report.impulse = push.impulse;
        state.reports.push_back(report);
    }
}

void reportPairs(CrowdState& state) {
    for (std::size_t block = 0; block < state.pairs.size(); ++block) {
        for (int lane = 0; lane < kLanes; ++lane) {
            const int index = state.touchOfLane[block][lane];
            const float impulse = state.impulseSums[block].lane[lane];
            if (index < 0 || impulse <= 0.0F) continue;
            const PairTouch& touch = state.touches[index];
            ContactReport report;
            report.a = state.dolls[touch.dollA].side;
            report.a.body = touch.bodyA;
            report.b = state.dolls[touch.dollB].side;
            report.b.body = touch.bodyB;
            report.normal = touch.touch.normal;
            const Doll& b = state.dolls[touch.dollB];
            const PrimitiveShape& shape = state.groupOf(b).topology.shapeOf(touch.bodyB, touch.shapeB);
            const float radius = shape.isAngular() ? 0.0F : shape.radius;
            report.position =
                bodyState(state, b, touch.bodyB).worldFromBody * touch.touch.localB + report.normal * radius;
            report.impulse = impulse;
            state.reports.push_back(report);
        }
    }
}

}  // namespace

void beginReports(CrowdState& state) {
    state.reports.clear();
    if (!state.settings.contactReports) return;
    for (Batch* batch : state.active) {
        batch->pushes.clear();
        openSums(*batch);
    }
    state.impulseSums.assign(state.pairs.size(), Wide{});
}

void sumImpulses(CrowdState& state, const Job& job) {
    for (Batch* batch : job.batches) {
        for (std::size_t i = 0; i < batch->contacts.size(); ++i)
            add(batch->contacts[i].normalImpulse, batch->impulseSums[i]);
    }
    for (std::size_t i = job.firstBlock; i < job.firstBlock + job.blockCount; ++i)
        add(state.pairs[i].normalImpulse, state.impulseSums[i]);
}

void openSums(Batch& batch) {
    batch.impulseSums.assign(batch.contacts.size(), Wide{});
}

void closeSums(const CrowdState& state, Batch& batch) {
    for (std::size_t i = 0; i < batch.contacts.size(); ++i) {
        const StaticContactLanes& contact = batch.contacts[i];
        for (int lane = 0; lane < batch.used; ++lane) {
            const float impulse = batch.impulseSums[i].lane[lane];
            if (contact.key[lane] == 0 || impulse <= 0.0F) continue;
            const std::uint64_t key = contact.key[lane];
            auto known = std::find_if(batch.pushes.begin(), batch.pushes.end(),
                                      [&](const StaticPush& push) { return push.key == key && push.lane == lane; });
            if (known == batch.pushes.end())
                known = batch.pushes.insert(known, {key, lane, contact.body, {}, {}, 0.0F});
            known->normal = readVector(contact.normal, lane);
            const vec3 core = bodyState(state, state.dolls[batch.doll[lane]], contact.body).worldFromBody *
                              readVector(contact.localPoint, lane);
            known->position = core - known->normal * (glm::dot(known->normal, core) - contact.offset.lane[lane]);
            known->impulse += impulse;
        }
    }
}

void makeReports(CrowdState& state) {
    if (!state.settings.contactReports) return;
    for (Batch* batch : state.active) {
        closeSums(state, *batch);
        reportStatics(state, *batch);
    }
    reportPairs(state);
}

}  // namespace lutka::physics::crowd
