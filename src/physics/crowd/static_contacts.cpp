#include "physics/crowd/static_contacts.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "physics/crowd/detect.hpp"
#include "physics/crowd/target.hpp"

namespace lutka::physics::crowd {
namespace {

constexpr float kForeseenM = 0.002F;       // nearer than this at a substep's end is foreseen
constexpr int kForeseenFeature = 1 << 20;  // beyond those of all shapes, meshes included (collision/mesh_contacts)

// Where a shape will be in `seconds` if nothing touches its body.
PlacedShape movedOn(PlacedShape shape, const BodyState& body, const vec3& gravity, float seconds) {
    const vec3 turn = seconds * body.angularVelocity;
    const float angle = glm::length(turn);
    const mat3 turned = angle > 1e-6F ? glm::mat3_cast(glm::angleAxis(angle, turn / angle)) : mat3(1);
    const vec3& centre = body.worldFromBody.translation;
    shape.position = centre + turned * (shape.position - centre) + seconds * (body.linearVelocity + seconds * gravity);
    shape.axes = turned * shape.axes;
    return shape;
}

float speedBound(const BodyState& body, const BodyConstants& constants) {
    return glm::length(body.linearVelocity) + glm::length(body.angularVelocity) * constants.reach;
}

bool nearStatic(const PlacedStatic& geometry, const vec3& low, const vec3& high) {
    if (geometry.shape.kind != StaticShape::Kind::plane) return meet(low, high, geometry.low, geometry.high);
    const vec3 normal = geometry.axes[1];
    const vec3 lowest(normal.x > 0 ? low.x : high.x, normal.y > 0 ? low.y : high.y, normal.z > 0 ? low.z : high.z);
    return glm::dot(normal, lowest - geometry.shape.worldFromShape.translation) <= 0.0F;
}

// A plane as the kernels take it: the solid is normal · p <= offset.
struct HalfSpace {
    explicit HalfSpace(const PlacedStatic& plane)
        : normal{plane.axes[1].x, plane.axes[1].y, plane.axes[1].z},
          offset(glm::dot(plane.axes[1], plane.shape.worldFromShape.translation)) {}

    float normal[3];
    float offset;
};

void spread(Wide& to, float value) {
    for (float& lane : to.lane)
        lane = value;
}
void spread(Wide3& to, const vec3& value) {
    spread(to.x, value.x);
    spread(to.y, value.y);
    spread(to.z, value.z);
}

void setImpulses(StaticContactLanes& contact, int lane, const CarriedStatic& carried) {
    contact.normalImpulse.lane[lane] = carried.contact.normal;
    writeVector(contact.frictionImpulse, lane, carried.contact.friction);
    writeVector(contact.rollImpulse, lane, carried.roll);
}

// Puts a contact into a lane that has none.
void setContact(StaticContactLanes& contact, int lane, const StaticTouch& touch, float friction, std::uint64_t key,
                const CarriedStatic* carried) {
    writeVector(contact.localPoint, lane, touch.local);
    contact.radius.lane[lane] = touch.radius;
    writeVector(contact.normal, lane, touch.normal);
    contact.offset.lane[lane] = touch.offset;
    contact.friction.lane[lane] = friction;
    contact.key[lane] = key;
    if (carried != nullptr) setImpulses(contact, lane, *carried);
}

// The static contacts of one batch: body by body, each lane's next contact into the next of the body's slots.
class StaticContacts {
  public:
    StaticContacts(CrowdState& state, Batch& batch, const Topology& topology, float dt, float substep)
        : state_(state), batch_(batch), topology_(topology), dt_(dt), substep_(substep) {}

    void find() {
        batch_.contacts.clear();
        batch_.nearShapes = false;
        batch_.nearPlanes.clear();
        batch_.nearMotions.clear();
        for (std::vector<int>& near : batch_.nearStatics)
            near.clear();
        for (int lane = 0; lane < batch_.used; ++lane) {
            const Doll& doll = state_.dolls[batch_.doll[lane]];
            batch_.carriedKeys[lane].clear();
            for (const CarriedStatic& touch : doll.statics)
                batch_.carriedKeys[lane].push_back(touch.contact.key);
            const Bounds bounds = worldBounds(doll, dt_, farther_);
            for (int i = 0; i < static_cast<int>(state_.statics.size()); ++i) {
                if (!state_.statics[i].shape.filter.collidesWith(doll.filter)) continue;
                if (!nearStatic(state_.statics[i], bounds.low, bounds.high)) continue;
                const bool isPlane = state_.statics[i].shape.kind == StaticShape::Kind::plane;
                std::vector<int>& near = isPlane ? batch_.nearPlanes : batch_.nearStatics[lane];
                batch_.nearShapes = batch_.nearShapes || !isPlane;
                if (!isPlane || std::find(near.begin(), near.end(), i) == near.end()) near.push_back(i);
            }
        }
        for (int body = 0; body < topology_.bodyCount(); ++body) {
            firstSlot_ = batch_.contacts.size();
            batch_.firstContact[body] = static_cast<int>(firstSlot_);
            for (const int plane : batch_.nearPlanes)
                findOnPlane(body, plane);
            firstSlot_ = batch_.contacts.size();
            for (int lane = 0; lane < batch_.used; ++lane)
                findOf(body, lane);
        }
        batch_.firstContact[topology_.bodyCount()] = static_cast<int>(batch_.contacts.size());
        giveRoom();
    }

  private:
    // How far the bodies may go until they must be looked at again.
    void giveRoom() {
        // Whatever comes near something else than planes is looked at again in every substep; until then it may go as
        // far as that is away, beyond what the bounds were grown by.
        Wide apart;
        for (int lane = 0; lane < kLanes; ++lane)
            apart.lane[lane] = state_.tuning.staticMargin + apartFromShapes(lane < batch_.used ? lane : 0);
        for (BodyLanes& body : batch_.bodies)
            body.room = apart;
        const BatchView view = batch_.view(topology_);
        for (const PlacedStatic& geometry : state_.statics) {
            if (geometry.shape.kind != StaticShape::Kind::plane) continue;
            const HalfSpace plane(geometry);
            state_.kernels->limitRoom(view, plane.normal, plane.offset, state_.tuning.staticMargin, kForesight * dt_);
        }
    }

    // Metres between the doll's bounds and the nearest static that is no plane.
    float apartFromShapes(int lane) const {
        const Bounds bounds = worldBounds(state_.dolls[batch_.doll[lane]], dt_, farther_);
        float apart = kFarM;
        for (const PlacedStatic& geometry : state_.statics) {
            if (geometry.shape.kind == StaticShape::Kind::plane) continue;
            const vec3 gap = glm::max(geometry.low - bounds.high, bounds.low - geometry.high);
            apart = std::min(apart, std::max({gap.x, gap.y, gap.z, 0.0F}));
        }
        return apart;
    }

    // Planes are the same for all lanes.
    void findOnPlane(int body, int index) {
        const HalfSpace plane(state_.statics[index]);
        const vec3 normal = state_.statics[index].axes[1];
        const BatchView view = batch_.view(topology_);
        for (int shape = 0; shape < topology_.shapeCount(body); ++shape) {
            const CorePoints points = corePoints(topology_.shapeOf(body, shape));
            for (int i = 0; i < points.count; ++i) {
                const vec3 local = topology_.inBody(body, shape, points.local[i]);
                const float point[3] = {local.x, local.y, local.z};
                const unsigned lanes =
                    state_.kernels->findNearPlane(view, body, point, points.radius, plane.normal, plane.offset,
                                                  state_.tuning.staticMargin, kForesight * dt_);
                if (lanes != 0)
                    putPlane({body, shape}, index, lanes, {local, points.radius, normal, plane.offset, 0.0F, i});
            }
        }
    }

    // One of a body's shapes.
    struct ShapeRef {
        int body;
        int shape;
    };

    // The same point of a body in all `lanes`.
    void putPlane(const ShapeRef& of, int index, unsigned lanes, const StaticTouch& touch) {
        const int body = of.body;
        StaticContactLanes& contact = emptyContact(body);
        const StaticShape& plane = state_.statics[index].shape;
        spread(contact.localPoint, touch.local);
        spread(contact.normal, touch.normal);
        spread(contact.radius, touch.radius);
        spread(contact.friction, plane.friction * kBodyFriction);
        const std::uint64_t key = staticKey(index, body, of.shape, touch.feature);
        for (int lane = 0; lane < kLanes; ++lane) {
            const int from = lane < batch_.used ? lane : 0;
            const Doll& doll = state_.dolls[batch_.doll[from]];
            if ((lanes >> static_cast<unsigned>(from) & 1U) == 0 || !plane.filter.collidesWith(doll.filter)) continue;
            if (isKinematic(batch_, body, from)) continue;
            contact.offset.lane[lane] = touch.offset;
            contact.key[lane] = key;
            const CarriedStatic* carried = carriedStatic(from, key);
            if (carried != nullptr) setImpulses(contact, lane, *carried);
        }
    }

    void findOf(int body, int lane) {
        if (batch_.nearStatics[lane].empty() || isKinematic(batch_, body, lane)) return;
        const Doll& doll = state_.dolls[batch_.doll[lane]];
        const BodyLanes& lanes = batch_.bodies[body];
        const vec3 moved = glm::abs(doll.rootVelocity) * (kForesight * dt_) + farther_;
        const vec3 low = readVector(lanes.low, lane) - moved;
        const vec3 high = readVector(lanes.high, lane) + moved;
        std::size_t slot = firstSlot_;
        const BodyState moving = readBody(lanes, lane);
        for (const int index : batch_.nearStatics[lane]) {
            const PlacedStatic& geometry = state_.statics[index];
            if (!nearStatic(geometry, low, high)) continue;
            const float range =
                state_.tuning.shapeMargin + kForesight * substep_ * speedBound(moving, topology_.bodies[body]);
            for (int shape = 0; shape < topology_.shapeCount(body); ++shape) {
                const PlacedShape placed = placedShape(state_, doll, body, shape);
                const vec3 reach = halfBounds(placed) + range;
                if (!meet(placed.position - reach, placed.position + reach, geometry.low, geometry.high)) continue;
                const StaticTouches found = touchStatic(placed, geometry, range);
                for (int i = 0; i < found.count; ++i)
                    put(slot++, {body, shape}, lane, index, found.points[i]);
                foresee({body, shape}, lane, index, placed, found, slot);
            }
        }
        if (slot != firstSlot_)
            batch_.nearMotions.push_back({body, lane, moving.linearVelocity, moving.angularVelocity});
    }

    // The half spaces that a body is about to be in: where it passes an edge within a substep, the one that is nearest
    // at its beginning is not the one that it is in at its end.
    void foresee(const ShapeRef& of, int lane, int index, const PlacedShape& placed, const StaticTouches& found,
                 std::size_t& slot) {
        const BodyState body = readBody(batch_.bodies[of.body], lane);
        const float way = substep_ * speedBound(body, topology_.bodies[of.body]);
        if (way < kForeseenM) return;  // what comes to rest keeps its contacts
        const auto reaches = [&](const StaticTouch& touch) { return touch.separation < way + kForeseenM; };
        if (std::none_of(found.points.begin(), found.points.begin() + found.count, reaches)) return;
        const PlacedShape next = movedOn(placed, body, state_.settings.gravity, substep_);
        const StaticTouches later = touchStatic(next, state_.statics[index], kForeseenM);
        for (int i = 0; i < later.count; ++i) {
            StaticTouch touch = later.points[i];
            if (saysTheSame(found, touch.local, touch.normal)) continue;
            touch.feature += kForeseenFeature;
            put(slot++, of, lane, index, touch);
        }
    }

    void put(std::size_t slot, const ShapeRef& of, int lane, int geometry, StaticTouch touch) {
        touch.local = topology_.inBody(of.body, of.shape, touch.local);
        if (slot == batch_.contacts.size()) emptyContact(of.body);
        const std::uint64_t key = staticKey(geometry, of.body, of.shape, touch.feature);
        const CarriedStatic* carried = carriedStatic(lane, key);
        const float friction = state_.statics[geometry].shape.friction * kBodyFriction;
        setContact(batch_.contacts[slot], lane, touch, friction, key, carried);
        if (lane != 0) return;
        for (int copy = batch_.used; copy < kLanes; ++copy)
            setContact(batch_.contacts[slot], copy, touch, friction, key, carried);
    }

    // What the lane's doll has kept of that contact; null when there was none. They are looked for in nearly the order
    // that they were kept in: from where the last search ended.
    const CarriedStatic* carriedStatic(int lane, std::uint64_t key) {
        const std::vector<std::uint64_t>& keys = batch_.carriedKeys[lane];
        const auto from = keys.begin() + static_cast<std::ptrdiff_t>(cursor_[lane]);
        auto at = std::find(from, keys.end(), key);
        if (at == keys.end()) {
            at = std::find(keys.begin(), from, key);
            if (at == from) return nullptr;
        }
        const auto index = static_cast<std::size_t>(at - keys.begin());
        cursor_[lane] = index + 1 < keys.size() ? index + 1 : 0;
        return &state_.dolls[batch_.doll[lane]].statics[index];
    }

    // One that no lane has.
    StaticContactLanes& emptyContact(int body) {
        makeRoom(batch_.contacts, batch_.contacts.size() + 1);
        StaticContactLanes& fresh = batch_.contacts.emplace_back();  // of zeros
        fresh.body = body;
        spread(fresh.normal, {0, 1, 0});
        spread(fresh.offset, -kFarM);
        return fresh;
    }

    static constexpr float kFarM = 1e6F;

    CrowdState& state_;
    Batch& batch_;
    const Topology& topology_;
    float dt_;
    float substep_;
    float farther_ = state_.tuning.staticMargin - state_.tuning.pairMargin;  // than the bodies' own bounds reach
    std::size_t firstSlot_ = 0;
    std::size_t cursor_[kLanes]{};  // into Batch::carriedKeys
};

// Whether one of the body's contacts keeps that point out of that half space.
bool isHeld(const Batch& batch, const NearMotion& at, const StaticTouch& touch, const vec3& local) {
    StaticTouches known;
    known.capacity = 1;
    for (int i = batch.firstContact[at.body]; i < batch.firstContact[at.body + 1]; ++i) {
        const StaticContactLanes& contact = batch.contacts[i];
        if (contact.key[at.lane] == 0) continue;
        known.count = 1;
        known.points[0].local = readVector(contact.localPoint, at.lane);
        known.points[0].normal = readVector(contact.normal, at.lane);
        if (saysTheSame(known, local, touch.normal)) return true;
    }
    return false;
}

}  // namespace

bool straysIntoStatics(const CrowdState& state, const Batch& batch, const Topology& topology, float substep) {
    constexpr float kDeepM = 0.001F;
    for (const NearMotion& at : batch.nearMotions) {
        const BodyState body = readBody(batch.bodies[at.body], at.lane);
        const float strayed = glm::length(body.linearVelocity - at.velocity) +
                              glm::length(body.angularVelocity - at.angular) * topology.bodies[at.body].reach;
        if (strayed * substep < kDeepM) continue;
        const Doll& doll = state.dolls[batch.doll[at.lane]];
        for (const int index : batch.nearStatics[at.lane]) {
            for (int shape = 0; shape < topology.shapeCount(at.body); ++shape) {
                const PlacedShape next = movedOn(placedShape(state, doll, at.body, shape), body, vec3(0), substep);
                const StaticTouches met = touchStatic(next, state.statics[index], 0.0F);
                for (int i = 0; i < met.count; ++i) {
                    const StaticTouch& touch = met.points[i];
                    if (touch.separation < -kDeepM &&
                        !isHeld(batch, at, touch, topology.inBody(at.body, shape, touch.local)))
                        return true;
                }
            }
        }
    }
    return false;
}

void findStatics(CrowdState& state, Batch& batch, const Topology& topology, float dt, float substep) {
    StaticContacts(state, batch, topology, dt, substep).find();
}

}  // namespace lutka::physics::crowd
