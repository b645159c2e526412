#include "physics/crowd/static_contacts.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "physics/collision/friction.hpp"
#include "physics/crowd/bounds.hpp"
#include "physics/crowd/target.hpp"

namespace lutka::physics::crowd {
namespace {

constexpr float kForeseenM = 0.002F;  // nearer than this at a substep's end is foreseen
constexpr int kForeseenFeature =
    1 << 20;  // beyond those of all shapes but MeshContact::kFirstCrossing's, which leave it room

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

// Makes a lane repeat lane 0, of which only what differs from lane to lane on a plane is taken.
void copyContact(StaticContactLanes& contact, int lane) {
    contact.offset.lane[lane] = contact.offset.lane[0];
    contact.key[lane] = contact.key[0];
    contact.normalImpulse.lane[lane] = contact.normalImpulse.lane[0];
    writeVector(contact.frictionImpulse, lane, readVector(contact.frictionImpulse, 0));
    writeVector(contact.rollImpulse, lane, readVector(contact.rollImpulse, 0));
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
    StaticContacts(CrowdState& state, Batch& batch, const Topology& topology, const StaticSearch& search)
        : state_(state),
          batch_(batch),
          topology_(topology),
          dt_(search.seconds),
          substep_(search.substep),
          keepsPressing_(search.keepsPressing) {}

    void find() {
        const bool onlyPlanes = nearPlanesOnly();
        const std::size_t planes = batch_.nearPlanes.size();
        batch_.nearShapes = false;
        batch_.nearPlanes.clear();
        batch_.nearMotions.clear();
        for (std::vector<int>& near : batch_.nearStatics)
            near.clear();
        for (int lane = 0; lane < batch_.used; ++lane) {
            const Doll& doll = state_.dolls[batch_.doll[lane]];
            const Aabb bounds = worldBounds(doll, dt_, farther_);
            for (int i = 0; i < static_cast<int>(state_.statics.size()); ++i) {
                if (!state_.statics[i].shape.filter.collidesWith(doll.filter)) continue;
                if (!nearStatic(state_.statics[i], bounds.low, bounds.high)) continue;
                const bool isPlane = state_.statics[i].shape.kind == StaticShape::Kind::plane;
                std::vector<int>& near = isPlane ? batch_.nearPlanes : batch_.nearStatics[lane];
                batch_.nearShapes = batch_.nearShapes || !isPlane;
                if (!isPlane || std::find(near.begin(), near.end(), i) == near.end()) near.push_back(i);
            }
        }
        const bool samePoints = findNearPlanes();
        if (!(samePoints && onlyPlanes && nearPlanesOnly() && planes == batch_.nearPlanes.size() && renew()))
            findAnew();
        giveRoom();
    }

  private:
    bool nearPlanesOnly() const {
        return std::all_of(std::begin(batch_.nearStatics), std::end(batch_.nearStatics),
                           [](const std::vector<int>& near) { return near.empty(); });
    }

    // Which points are near which planes. Returns whether these are those of the search before, in whatever lanes.
    bool findNearPlanes() {
        const std::size_t count = topology_.points.size();
        std::vector<unsigned char>& lanes = batch_.planeLanes;
        std::vector<unsigned char>& before = batch_.planeLanesBefore;
        std::swap(lanes, before);
        lanes.resize(count * batch_.nearPlanes.size());
        const BatchView view = batch_.view(topology_);
        for (std::size_t i = 0; i < batch_.nearPlanes.size(); ++i) {
            const HalfSpace plane(state_.statics[batch_.nearPlanes[i]]);
            state_.kernels->findNearPlane(view, topology_.points.data(), static_cast<int>(count), plane.normal,
                                          plane.offset, state_.tuning.staticMargin, kForesight * dt_,
                                          lanes.data() + i * count);
        }
        return std::equal(lanes.begin(), lanes.end(), before.begin(), before.end(),
                          [](unsigned char a, unsigned char b) { return (a == 0) == (b == 0); });
    }

    // Calls `visit` with each point that is near a plane, the plane and the lanes, in the order of the contacts, from
    // the point `place` of the topology on to the end of its body.
    template <class Visit>
    void visitBody(std::size_t& place, int body, Visit visit) const {
        const std::vector<PlanePoint>& points = topology_.points;
        std::size_t end = place;
        while (end < points.size() && points[end].body == body)
            ++end;
        for (std::size_t plane = 0; plane < batch_.nearPlanes.size(); ++plane) {
            for (std::size_t i = place; i < end; ++i) {
                const unsigned lanes = batch_.planeLanes[plane * points.size() + i];
                if (lanes != 0) visit(points[i], batch_.nearPlanes[plane], lanes);
            }
        }
        place = end;
    }

    void findAnew() {
        batch_.contacts.clear();
        for (int lane = 0; lane < batch_.used; ++lane) {
            batch_.carriedKeys[lane].clear();
            for (const CarriedStatic& touch : state_.dolls[batch_.doll[lane]].statics)
                batch_.carriedKeys[lane].push_back(touch.contact.key);
        }
        std::size_t place = 0;
        for (int body = 0; body < topology_.bodyCount(); ++body) {
            batch_.firstContact[body] = static_cast<int>(batch_.contacts.size());
            visitBody(place, body, [&](const PlanePoint& point, int plane, unsigned lanes) {
                putPlane(emptyContact(body), point, plane, lanes);
            });
            firstSlot_ = batch_.contacts.size();
            for (int lane = 0; lane < batch_.used; ++lane) {
                const std::size_t slot = findOf(body, lane);
                if (keepsPressing_) keepPressing(body, lane, slot);
            }
        }
        batch_.firstContact[topology_.bodyCount()] = static_cast<int>(batch_.contacts.size());
    }

    // What lies still has the contacts of the search before: they stay where they are, with all that they carry. False
    // where they do not fit what the dolls have kept of them, since a doll has come, gone or been placed.
    bool renew() {
        std::size_t place = 0;
        std::size_t slot = 0;
        std::size_t kept[kLanes]{};
        bool fits = true;
        for (int body = 0; body < topology_.bodyCount(); ++body) {
            visitBody(place, body, [&](const PlanePoint& point, int plane, unsigned) {
                fits = fits && slot < batch_.contacts.size() && isKept(batch_.contacts[slot], point, plane, kept);
                ++slot;
            });
        }
        for (int lane = 0; lane < batch_.used; ++lane)
            fits = fits && kept[lane] == state_.dolls[batch_.doll[lane]].statics.size();
        if (!fits || slot != batch_.contacts.size()) return false;
        place = slot = 0;
        for (int body = 0; body < topology_.bodyCount(); ++body) {
            visitBody(place, body, [&](const PlanePoint& point, int plane, unsigned lanes) {
                renewContact(batch_.contacts[slot++], point, plane, lanes);
            });
        }
        return true;
    }

    // Whether a contact is of that point and plane, and its impulses are those that the dolls have kept next: `kept`
    // counts them.
    bool isKept(const StaticContactLanes& contact, const PlanePoint& point, int plane,
                std::size_t (&kept)[kLanes]) const {
        const StaticShape& shape = state_.statics[plane].shape;
        if (contact.body != point.body || readVector(contact.normal, 0) != state_.statics[plane].axes[1] ||
            contact.friction.lane[0] != shape.friction * kBodyFriction ||
            readVector(contact.localPoint, 0) != vec3(point.local[0], point.local[1], point.local[2]))
            return false;
        const std::uint64_t key = staticKey(plane, point.body, point.shape, point.feature);
        for (int lane = 0; lane < batch_.used; ++lane) {
            if (contact.key[lane] == 0 || contact.normalImpulse.lane[lane] <= 0.0F) continue;
            const std::vector<CarriedStatic>& statics = state_.dolls[batch_.doll[lane]].statics;
            if (contact.key[lane] != key || kept[lane] == statics.size()) return false;
            const CarriedContact& carried = statics[kept[lane]++].contact;
            if (carried.key != key || carried.normal != contact.normalImpulse.lane[lane]) return false;
        }
        return true;
    }

    void renewContact(StaticContactLanes& contact, const PlanePoint& point, int index, unsigned lanes) {
        const PlacedStatic& plane = state_.statics[index];
        const float offset = HalfSpace(plane).offset;
        const std::uint64_t key = staticKey(index, point.body, point.shape, point.feature);
        contact.near = 0;
        for (int lane = 0; lane < batch_.used; ++lane) {
            const bool meets = touches(plane, point.body, lane, lanes);
            if (!meets || contact.key[lane] == 0 || contact.normalImpulse.lane[lane] <= 0.0F)
                setImpulses(contact, lane, {});
            contact.offset.lane[lane] = meets ? offset : -kFarM;
            contact.key[lane] = meets ? key : 0;
        }
        for (int lane = batch_.used; lane < kLanes; ++lane) {
            copyContact(contact, lane);
        }
    }

    // Sets BodyLanes::room: how many metres each body's surface may still move before a static contact could be
    // missing.
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
        const Aabb bounds = worldBounds(state_.dolls[batch_.doll[lane]], dt_, farther_);
        float apart = kFarM;
        for (const PlacedStatic& geometry : state_.statics) {
            if (geometry.shape.kind == StaticShape::Kind::plane) continue;
            const vec3 gap = glm::max(geometry.low - bounds.high, bounds.low - geometry.high);
            apart = std::min(apart, std::max({gap.x, gap.y, gap.z, 0.0F}));
        }
        return apart;
    }

    // One of a body's shapes.
    struct ShapeRef {
        int body;
        int shape;
    };

    // Whether the lane's doll is to touch a plane with a point that is near it in `lanes`.
    bool touches(const PlacedStatic& plane, int body, int lane, unsigned lanes) const {
        return (lanes >> static_cast<unsigned>(lane) & 1U) != 0 &&
               plane.shape.filter.collidesWith(state_.dolls[batch_.doll[lane]].filter) &&
               !isKinematic(batch_, body, lane);
    }

    // The same point of a body in all `lanes`.
    void putPlane(StaticContactLanes& contact, const PlanePoint& point, int index, unsigned lanes) {
        const PlacedStatic& plane = state_.statics[index];
        const float offset = HalfSpace(plane).offset;
        spread(contact.localPoint, {point.local[0], point.local[1], point.local[2]});
        spread(contact.normal, plane.axes[1]);
        spread(contact.radius, point.radius);
        spread(contact.friction, plane.shape.friction * kBodyFriction);
        const std::uint64_t key = staticKey(index, point.body, point.shape, point.feature);
        for (int lane = 0; lane < kLanes; ++lane) {
            const int from = lane < batch_.used ? lane : 0;
            if (!touches(plane, point.body, from, lanes)) continue;
            contact.offset.lane[lane] = offset;
            contact.key[lane] = key;
            const CarriedStatic* carried = carriedStatic(from, key);
            if (carried != nullptr) setImpulses(contact, lane, *carried);
        }
    }

    // Returns the slot after the lane's last contact.
    std::size_t findOf(int body, int lane) {
        if (batch_.nearStatics[lane].empty() || isKinematic(batch_, body, lane)) return firstSlot_;
        const Doll& doll = state_.dolls[batch_.doll[lane]];
        const BodyLanes& lanes = batch_.bodies[body];
        const vec3 moved = glm::abs(doll.rootVelocity) * (kForesight * dt_) + farther_;
        const vec3 low = readVector(lanes.low, lane) - moved;
        const vec3 high = readVector(lanes.high, lane) + moved;
        std::size_t slot = firstSlot_;
        const BodyState moving = readBody(lanes, lane);
        bool isNear = false;
        for (const int index : batch_.nearStatics[lane]) {
            const PlacedStatic& geometry = state_.statics[index];
            if (!nearStatic(geometry, low, high)) continue;
            isNear = true;
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
        // Without a contact, too: an impact elsewhere may turn it towards what it is near.
        if (isNear) batch_.nearMotions.push_back({body, lane, moving.linearVelocity, moving.angularVelocity});
        return slot;
    }

    // A contact that has stopped a body within the substep is farther off than the body, as it moves now, can reach.
    void keepPressing(int body, int lane, std::size_t slot) {
        const auto isFound = [&](std::uint64_t key) {
            return std::any_of(batch_.contacts.begin() + batch_.firstContact[body], batch_.contacts.end(),
                               [&](const StaticContactLanes& contact) { return contact.key[lane] == key; });
        };
        for (const CarriedStatic& pressed : state_.dolls[batch_.doll[lane]].statics) {
            if (pressed.body != body || isFound(pressed.contact.key)) continue;
            const StaticTouch touch{
                .local = pressed.local, .radius = pressed.radius, .normal = pressed.normal, .offset = pressed.offset};
            putAt(slot++, body, lane, geometryOfKey(pressed.contact.key), touch, pressed.contact.key);
        }
    }

    // A contact stands for one face or edge of a box or mesh, as a half space. A body that slides past an edge within a
    // substep is nearest to one of them at its beginning and inside another at its end. So the search is made a second
    // time, for where the body will be if nothing stops it, and what that finds is added.
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
        putAt(slot, of.body, lane, geometry, touch, staticKey(geometry, of.body, of.shape, touch.feature));
    }

    // `touch.local` in the body's space.
    void putAt(std::size_t slot, int body, int lane, int geometry, const StaticTouch& touch, std::uint64_t key) {
        if (slot == batch_.contacts.size()) emptyContact(body);
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
    bool keepsPressing_;
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

void findStatics(CrowdState& state, Batch& batch, const Topology& topology, const StaticSearch& search) {
    StaticContacts(state, batch, topology, search).find();
}

}  // namespace lutka::physics::crowd
