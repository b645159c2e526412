// puppets: what a crowd of dolls with muscles costs beside the same crowd without, stepped in turn, as CSV
// (docs/puppets.md). Muscles hold the start pose; `pinned` dolls stay up by their hips, the others fall.
#include <fmt/format.h>

#include <memory>
#include <vector>

#include "physics/crowd/crowd_world.hpp"
#include "physics/powered/puppet.hpp"
#include "support/dolls.hpp"
#include "timing.hpp"

namespace {

using namespace lutka;
using physics::BodyState;
using physics::RagdollProfile;

constexpr float kFrame = 1.0F / 60.0F;
constexpr int kSteps = 240;
constexpr int kRounds = 5;

// The doll in its joints' neutral pose.
std::vector<BodyState> standing(const RagdollProfile& profile, const vec3& position) {
    std::vector<BodyState> bodies(profile.bodies.size());
    bodies[0].worldFromBody = {quat(1, 0, 0, 0), position};
    for (const physics::ConstraintProfile& constraint : profile.constraints) {
        const RigidTransform& parent = bodies[constraint.parent].worldFromBody;
        bodies[constraint.child].worldFromBody =
            parent * constraint.parentFromFrame * inverse(constraint.childFromFrame);
    }
    return bodies;
}

// A field of dolls two metres apart, dropped by 5 cm.
class Field {
  public:
    Field(const RagdollProfile& profile, int count, bool powered, float pinForceN) {
        physics::WorldSettings settings;
        settings.sleeping = false;
        world_ = physics::createCrowdWorld(settings);
        world_->addStatic(physics::StaticShape{});
        for (int i = 0; i < count; ++i) {
            const auto start =
                standing(profile, {2.0F * static_cast<float>(i % 10), 1.1F, 2.0F * static_cast<float>(i / 10)});
            const physics::DollId doll = world_->addDoll(profile, start);
            std::vector<RigidTransform>& pose = poses_.emplace_back();
            for (const BodyState& body : start)
                pose.push_back(body.worldFromBody);
            physics::PuppetSettings puppet;
            puppet.pinForceN = pinForceN;
            puppet.knockOutTilt = 10.0F;  // never
            if (powered)
                puppets_.push_back(std::make_unique<physics::Puppet>(*world_, doll, profile, 0, start, puppet));
        }
    }
    double stepMs() {
        return timeOf([&] {
            for (std::size_t i = 0; i < puppets_.size(); ++i)
                puppets_[i]->prepare(poses_[i], poses_[i], kFrame);
            world_->step(kFrame);
        });
    }

  private:
    std::unique_ptr<physics::World> world_;
    std::vector<std::unique_ptr<physics::Puppet>> puppets_;
    std::vector<std::vector<RigidTransform>> poses_;
};

}  // namespace

int main() {
    const RagdollProfile profile = test::makeDoll();
    fmt::print("dolls,pinned,limp_ms,powered_ms,ratio\n");
    for (const int count : {1, 10, 100, 500}) {
        for (const bool pinned : {false, true}) {
            std::vector<double> limp;
            std::vector<double> powered;
            for (int round = 0; round < kRounds; ++round) {
                Field fields[2]{{profile, count, false, 0.0F}, {profile, count, true, pinned ? 3000.0F : 0.0F}};
                for (int i = 0; i < kSteps; ++i) {
                    limp.push_back(fields[0].stepMs());
                    powered.push_back(fields[1].stepMs());
                }
            }
            const double a = medianOf(limp);
            const double b = medianOf(powered);
            fmt::print("{},{},{:.4f},{:.4f},{:.2f}\n", count, pinned ? "yes" : "no", a, b, b / a);
        }
    }
    return 0;
}
