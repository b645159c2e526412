#include "physics/world/world_view.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace lutka::physics {
namespace {

template <class IdType>
std::string nothing(std::string_view kind, IdType id, int count) {
    if (!id.isSet()) return fmt::format("the {}'s id is of nothing", kind);
    return fmt::format("{} {} (generation {}) is not in this world of {}", kind, id.index, id.generation, count);
}

}  // namespace

void WorldView::refuse(std::string_view call, std::string_view why) const {
    ++refusals_;
    const std::string message = fmt::format("World::{}: {}; the call is refused", call, why);
    if (refusalSink_)
        refusalSink_(message);
    else
        std::fprintf(stderr, "%s\n", message.c_str());
}

int WorldView::checked(std::string_view call, DollId doll) const {
    const int place = dollIds_.placeOf(doll);
    if (place < 0) refuse(call, nothing("doll", doll, dollIds_.count()));
    return place;
}

int WorldView::checked(std::string_view call, PropId prop) const {
    const int place = propIds_.placeOf(prop);
    if (place < 0) refuse(call, nothing("prop", prop, propIds_.count()));
    return place;
}

int WorldView::checked(std::string_view call, StaticId fixed) const {
    const int place = staticIds_.placeOf(fixed);
    if (place < 0) refuse(call, nothing("static", fixed, staticIds_.count()));
    return place;
}

const RagdollProfile& WorldView::profileOf(DollId doll) const {
    static const RagdollProfile none;
    const int place = checked("profileOf", doll);
    return place < 0 ? none : profileAt(place);
}

vec3 WorldView::inertiaOf(DollId doll, int body) const {
    const int place = checked("inertiaOf", doll);
    if (place < 0) return vec3(0);
    if (body < 0 || body >= static_cast<int>(profileAt(place).bodies.size())) {
        refuse("inertiaOf", fmt::format("the doll has no body {}", body));
        return vec3(0);
    }
    return inertiaAt(place, body);
}

void WorldView::getBodies(DollId doll, std::span<BodyState> bodies) const {
    const int place = checked("getBodies", doll);
    if (place < 0) return;
    const std::size_t count = profileAt(place).bodies.size();
    if (bodies.size() != count)
        refuse("getBodies", fmt::format("room for {} bodies, the doll has {}", bodies.size(), count));
    else
        getBodiesAt(place, bodies);
}

bool WorldView::isAsleep(DollId doll) const {
    const int place = checked("isAsleep", doll);
    return place >= 0 && isAsleepAt(place);
}

const DynamicProp& WorldView::propOf(PropId prop) const {
    static const DynamicProp none;
    const int place = checked("propOf", prop);
    return place < 0 ? none : propAt(place);
}

BodyState WorldView::propState(PropId prop) const {
    const int place = checked("propState", prop);
    return place < 0 ? BodyState{} : propStateAt(place);
}

std::optional<RayHit> WorldView::rayTest(const vec3& from, const vec3& to, std::uint32_t layers) const {
    if (isFinite(from) && isFinite(to)) return castRay(from, to, layers);
    refuse("rayTest", "an end is not finite");
    return std::nullopt;
}

}  // namespace lutka::physics
