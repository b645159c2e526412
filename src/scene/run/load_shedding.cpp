#include "scene/run/load_shedding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "core/assert.hpp"
#include "scene/run/make_world.hpp"

namespace lutka::scene {
namespace {

using physics::BodyState;

// Dolls that pass through each other: a layer that does not collide with itself.
constexpr std::uint32_t kApartLayer = 1U << 31U;
constexpr physics::CollisionFilter kApart{kApartLayer, physics::CollisionFilter::kAll & ~kApartLayer};

Error notAMeasure(std::string_view word) {
    return {ErrorCode::usage, fmt::format("'{}' is nothing that can be spared", word), "--shed",
            "lod@METRES, lod7@METRES, apart@METRES, slow@METRES, slow3@METRES and frozen@METRES can be, with commas"};
}

// One word of the list into the settings.
bool parseMeasure(std::string_view word, ShedSettings& settings) {
    const std::size_t at = word.find('@');
    if (at == std::string_view::npos) return false;
    const std::string number(word.substr(at + 1));
    char* end = nullptr;
    const float metres = std::strtof(number.c_str(), &end);
    if (number.empty() || *end != '\0' || !(metres >= 0.0F) || !std::isfinite(metres)) return false;
    const std::string_view name = word.substr(0, at);
    if (name == "lod" || name == "lod7") {
        settings.lodFrom = metres;
        settings.lodLevel = name == "lod" ? physics::LodLevel::limbs : physics::LodLevel::block;
    } else if (name == "apart") {
        settings.apartFrom = metres;
    } else if (name == "frozen") {
        settings.frozenFrom = metres;
    } else if (name.starts_with("slow")) {
        settings.slowFrom = metres;
        settings.slowEvery = 2;
        const std::string_view every = name.substr(4);
        if (every.empty()) return true;
        const auto [stop, error] = std::from_chars(every.data(), every.data() + every.size(), settings.slowEvery);
        return error == std::errc() && stop == every.data() + every.size() && settings.slowEvery >= 2 &&
               settings.slowEvery <= 8;
    } else {
        return false;
    }
    return true;
}

}  // namespace

Result<ShedSettings> parseShedSettings(std::string_view list) {
    ShedSettings settings;
    while (!list.empty()) {
        const std::string_view word = list.substr(0, list.find(','));
        list.remove_prefix(std::min(word.size() + 1, list.size()));
        if (!parseMeasure(word, settings)) return notAMeasure(word);
    }
    return settings;
}

LoadShedder::LoadShedder(std::span<const Kind> kinds, physics::World& world,
                         std::span<const physics::StaticShape> statics, const physics::WorldSettings& worldSettings,
                         const ShedSettings& settings)
    : near_(world), settings_(settings), dolls_(kinds.size()) {
    LUTKA_ASSERT(world.dolls().size() == kinds.size() && settings.slowEvery >= 2);
    for (int index = 0; index < static_cast<int>(kinds.size()); ++index) {
        const Kind& kind = kinds[index];
        auto lod = lods_.find(kind.profile);
        if (lod == lods_.end())
            lod = lods_.emplace(kind.profile, makeLodProfile(*kind.profile, *kind.rig, settings.lodLevel)).first;
        dolls_[index].profile = kind.profile;
        dolls_[index].lod = &lod->second;
        dolls_[index].id = world.dolls()[index];
    }
    if (settings.slowFrom == ShedSettings::kOff) return;
    slow_ = makeWorld(worldSettings, settings.slowEvery);
    for (const physics::StaticShape& shape : statics)
        slow_->addStatic(shape);
}

physics::World& LoadShedder::worldOf(const Doll& doll) const {
    return doll.measures.slow ? *slow_ : near_;
}

physics::DollId LoadShedder::idIn(const physics::World& world, int index) const {
    const Doll& doll = dolls_[index];
    return !doll.measures.frozen && &worldOf(doll) == &world ? doll.id : physics::DollId{};
}

LoadShedder::Measures LoadShedder::wanted(const Doll& doll, float distance) const {
    const auto taken = [&](bool now, float from) {
        return distance >= (now ? from * (1.0F - settings_.hysteresis) : from);
    };
    Measures to;
    to.frozen = taken(doll.measures.frozen, settings_.frozenFrom);
    to.lod = taken(doll.measures.lod, settings_.lodFrom);
    to.apart = taken(doll.measures.apart, settings_.apartFrom);
    to.slow = taken(doll.measures.slow, settings_.slowFrom);
    return to;
}

bool LoadShedder::mayChange(const Doll& doll) const {
    // A slow doll is ahead of what is drawn until the time of its step has passed.
    if (phase_ != 0 && (doll.measures.slow || settings_.slowFrom < ShedSettings::kOff)) return false;
    if (doll.measures.frozen) return true;
    const physics::World& world = worldOf(doll);
    return !world.isAsleep(doll.id) && !world.isDragged(doll.id);
}

void LoadShedder::getStates(int index, std::span<BodyState> bodies) const {
    const Doll& doll = dolls_[index];
    if (doll.measures.frozen) {
        std::copy(doll.stopped.begin(), doll.stopped.end(), bodies.begin());
        return;
    }
    if (!doll.measures.lod) {
        worldOf(doll).getBodies(doll.id, bodies);
        return;
    }
    merged_.resize(doll.lod->profile.bodies.size());
    worldOf(doll).getBodies(doll.id, merged_);
    lodToFull(*doll.lod, *doll.profile, merged_, doll.lodFromMember, bodies);
}

void LoadShedder::getBodies(int index, std::span<RigidTransform> worldFromBody) const {
    const Doll& doll = dolls_[index];
    if (doll.measures.slow && !doll.measures.frozen && !doll.after.empty()) {
        const float alpha =
            static_cast<float>(phase_ == 0 ? settings_.slowEvery : phase_) / static_cast<float>(settings_.slowEvery);
        for (std::size_t i = 0; i < worldFromBody.size(); ++i)
            worldFromBody[i] = interpolate(doll.before[i], doll.after[i], alpha);
        return;
    }
    full_.resize(worldFromBody.size());
    getStates(index, full_);
    for (std::size_t i = 0; i < worldFromBody.size(); ++i)
        worldFromBody[i] = full_[i].worldFromBody;
}

void LoadShedder::takeOut(int index) {
    Doll& doll = dolls_[index];
    if (doll.measures.frozen) return;
    worldOf(doll).removeDoll(doll.id);
    if (doll.measures.slow) std::erase(slowOnes_, index);
    doll.id = {};
}

void LoadShedder::putIn(int index, std::span<const BodyState> bodies) {
    Doll& doll = dolls_[index];
    doll.before.clear();
    doll.after.clear();
    if (doll.measures.frozen) {
        doll.stopped.assign(bodies.begin(), bodies.end());
        return;
    }
    if (doll.measures.lod) {
        doll.lodFromMember.resize(bodies.size());
        merged_.resize(doll.lod->profile.bodies.size());
        fullToLod(*doll.lod, *doll.profile, bodies, merged_, doll.lodFromMember);
        doll.id = worldOf(doll).addDoll(doll.lod->profile, merged_);
    } else {
        doll.id = worldOf(doll).addDoll(*doll.profile, bodies);
    }
    if (doll.measures.slow) slowOnes_.push_back(index);
    if (doll.measures.apart) worldOf(doll).setDollFilter(doll.id, kApart);
}

void LoadShedder::change(int index, const Measures& to) {
    Doll& doll = dolls_[index];
    ++switches_;
    Measures onlyApart = doll.measures;
    onlyApart.apart = to.apart;
    if (onlyApart == to && !to.frozen) {
        doll.measures = to;
        worldOf(doll).setDollFilter(doll.id, to.apart ? kApart : physics::CollisionFilter{});
        return;
    }
    if (doll.measures.frozen && to.frozen) {  // nothing to be seen; taken up when it thaws
        doll.measures = to;
        return;
    }
    std::vector<BodyState> bodies(doll.profile->bodies.size());
    getStates(index, bodies);
    takeOut(index);
    doll.measures = to;
    putIn(index, bodies);
}

void LoadShedder::stepSlow(float dt) {
    const auto show = [&](int doll, std::vector<RigidTransform>& to) {
        full_.resize(dolls_[doll].profile->bodies.size());
        getStates(doll, full_);
        to.resize(full_.size());
        for (std::size_t i = 0; i < full_.size(); ++i)
            to[i] = full_[i].worldFromBody;
    };
    for (const int doll : slowOnes_)
        show(doll, dolls_[doll].before);
    slow_->step(dt * static_cast<float>(settings_.slowEvery));
    for (const int doll : slowOnes_)
        show(doll, dolls_[doll].after);
}

void LoadShedder::step(float dt, const vec3& eye) {
    std::vector<RigidTransform>& bodies = shown_;
    for (int index = 0; index < static_cast<int>(dolls_.size()); ++index) {
        if (!mayChange(dolls_[index])) continue;
        bodies.resize(dolls_[index].profile->bodies.size());
        getBodies(index, bodies);
        const Measures to = wanted(dolls_[index], glm::distance(bodies[0].translation, eye));
        if (to != dolls_[index].measures) change(index, to);
    }
    near_.step(dt);
    if (slow_ == nullptr) return;
    if (phase_ == 0) stepSlow(dt);
    phase_ = (phase_ + 1) % settings_.slowEvery;
}

bool LoadShedder::still(int index) const {
    const Doll& doll = dolls_[index];
    if (doll.measures.frozen) return true;
    return !doll.measures.slow && worldOf(doll).isAsleep(doll.id);
}

LoadShedder::Counts LoadShedder::counts() const {
    Counts counts;
    for (const Doll& doll : dolls_) {
        counts.lod += doll.measures.lod ? 1 : 0;
        counts.apart += doll.measures.apart ? 1 : 0;
        counts.slow += doll.measures.slow ? 1 : 0;
        counts.frozen += doll.measures.frozen ? 1 : 0;
    }
    return counts;
}

}  // namespace lutka::scene
