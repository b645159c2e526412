#include "support/soak.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "core/memory_use.hpp"
#include "core/random.hpp"
#include "physics/rig/rig.hpp"
#include "scene/run/make_world.hpp"
#include "support/dolls.hpp"
#include "support/rigs.hpp"

namespace lutka::test {
namespace {

constexpr float kFrame = 1.0F / 60.0F;
constexpr float kHalfSide = 12.0F;  // of the box, metres
constexpr std::size_t kGoneRemembered = 1000;

physics::StaticShape wall(const vec3& centre, const vec3& halfExtents) {
    physics::StaticShape shape;
    shape.kind = physics::StaticShape::Kind::box;
    shape.worldFromShape.translation = centre;
    shape.halfExtents = halfExtents;
    return shape;
}

class Soak {
  public:
    explicit Soak(const SoakOptions& options) : options_(options), profiles_{makeDoll(), makeDoll()} {
        profiles_[1].bodies[0].massKg *= 1.1F;
        const animation::Skeleton skeleton = makeBiped().skeleton;
        looked_.resize(profiles_[0].bodies.size());
        standing_.resize(profiles_[0].bodies.size());
        bodiesFromPose(physics::bindRig(profiles_[0], skeleton).value(), skeleton.bindModelFromJoint, {}, standing_);
        physics::WorldSettings settings;
        settings.solver = options.solver;
        world_ = scene::makeWorld(settings);
        world_->addStatic({});
        for (const float side : {-1.0F, 1.0F}) {
            world_->addStatic(wall({side * kHalfSide, 5, 0}, {0.5F, 20, kHalfSide}));
            world_->addStatic(wall({0, 5, side * kHalfSide}, {kHalfSide, 20, 0.5F}));
        }
        for (int i = 0; i < options.dolls; ++i)
            add();
    }

    SoakResult run() {
        const auto steps = static_cast<long long>(options_.seconds * 60.0);
        const auto warm = static_cast<long long>(options_.warmUpSeconds * 60.0);
        double due = 0.0;
        while (result_.steps < steps && result_.wrong.empty()) {
            for (due += options_.addedASecond / 60.0; due >= 1.0; due -= 1.0)
                replaceOldest();
            throwOne();
            const auto before = std::chrono::steady_clock::now();
            world_->step(kFrame);
            const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - before;
            if (++result_.steps <= warm) continue;
            const bool early = result_.steps <= warm + (steps - warm) / 4;
            const bool late = result_.steps > steps - (steps - warm) / 4;
            if (early || late) note(early ? early_ : late_, taken.count());
            check();
        }
        result_.caught = static_cast<long long>(world_->caught().size());
        result_.stepMsEarly = medianOf(early_.ms);
        result_.stepMsLate = medianOf(late_.ms);
        result_.residentGrowthMb = late_.mostMb - early_.mostMb;
        return result_;
    }

  private:
    struct Quarter {
        std::vector<double> ms;
        double mostMb = 0.0;
    };

    static double medianOf(std::vector<double>& values) {
        if (values.empty()) return 0.0;
        std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
        return values[values.size() / 2];
    }

    // A sample now and then: an hour has 216,000 steps, and what is kept here must not look like growth.
    void note(Quarter& quarter, double ms) {
        if (quarter.ms.capacity() == 0) quarter.ms.reserve(4096);
        if (result_.steps % 17 != 0 || quarter.ms.size() >= 4096) return;
        quarter.ms.push_back(ms);
        quarter.mostMb = std::max(quarter.mostMb, static_cast<double>(residentBytes()) / 1e6);
    }

    void add() {
        const physics::RagdollProfile& profile = profiles_[random_.next() % 2];
        const vec3 at{random_.uniform(-8, 8), random_.uniform(0, 5), random_.uniform(-8, 8)};
        const vec3 velocity{random_.uniform(-4, 4), 0, random_.uniform(-4, 4)};
        std::vector<physics::BodyState> bodies = standing_;
        for (physics::BodyState& body : bodies) {
            body.worldFromBody.translation += at;
            body.linearVelocity = velocity;
        }
        const physics::DollId id = world_->addDoll(profile, bodies);
        if (!id.isSet()) result_.wrong = "a doll was refused";
        living_.push_back(id);
        ++result_.added;
    }

    void replaceOldest() {
        const physics::DollId oldest = living_.front();
        living_.pop_front();
        world_->removeDoll(oldest);
        gone_.push_back(oldest);
        if (gone_.size() > kGoneRemembered) gone_.pop_front();
        add();
    }

    void throwOne() {
        const physics::DollId doll = living_[random_.next() % living_.size()];
        const vec3 impulse{random_.uniform(-300, 300), random_.uniform(0, 500), random_.uniform(-300, 300)};
        std::vector<physics::BodyState>& bodies = looked_;
        world_->getBodies(doll, bodies);
        world_->applyImpulse(doll, 0, impulse, bodies[0].worldFromBody.translation);
    }

    void tell(const std::string& what) { result_.wrong = "step " + std::to_string(result_.steps) + ": " + what; }

    void check() {
        for (const physics::DollId doll : living_)
            if (!world_->has(doll)) tell("a living doll's id is lost");
        for (const physics::DollId doll : gone_)
            if (world_->has(doll)) tell("a gone doll's id is another's");
        std::vector<physics::BodyState>& bodies = looked_;
        world_->getBodies(living_[static_cast<std::size_t>(result_.steps) % living_.size()], bodies);
        for (const physics::BodyState& body : bodies)
            if (!isFinite(body.worldFromBody)) tell("not finite");
    }

    SoakOptions options_;
    std::array<physics::RagdollProfile, 2> profiles_;
    std::vector<physics::BodyState> standing_;  // the figure at the origin, at rest
    Random random_{7};
    std::unique_ptr<physics::World> world_;
    std::vector<physics::BodyState> looked_;
    std::deque<physics::DollId> living_;
    std::deque<physics::DollId> gone_;
    Quarter early_;
    Quarter late_;
    SoakResult result_;
};

}  // namespace

SoakResult soak(const SoakOptions& options) {
    return Soak(options).run();
}

}  // namespace lutka::test
