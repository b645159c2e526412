#include "stress_conditions.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>
#include <utility>

#include "physics/collision/shape.hpp"

namespace lutka::bench {
namespace {

using physics::BodyState;
using physics::RagdollProfile;
using physics::StaticShape;

constexpr float kFrame = 1.0F / 60.0F;

vec3 centreOf(const RagdollProfile& profile, const std::vector<BodyState>& bodies) {
    vec3 centre(0);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        centre += bodies[i].worldFromBody.translation * (profile.bodies[i].massKg / profile.totalMassKg);
    return centre;
}

void turnAll(std::vector<BodyState>& bodies, const vec3& centre, const quat& turn) {
    for (BodyState& body : bodies) {
        body.worldFromBody.rotation = turn * body.worldFromBody.rotation;
        body.worldFromBody.translation = centre + turn * (body.worldFromBody.translation - centre);
    }
}

void moveAll(std::vector<BodyState>& bodies, const vec3& by) {
    for (BodyState& body : bodies)
        body.worldFromBody.translation += by;
}

void spinAll(std::vector<BodyState>& bodies, const vec3& centre, const vec3& velocity, const vec3& rate) {
    for (BodyState& body : bodies) {
        body.linearVelocity = velocity + glm::cross(rate, body.worldFromBody.translation - centre);
        body.angularVelocity = rate;
    }
}

StaticShape box(const vec3& centre, const vec3& halfExtents) {
    StaticShape shape;
    shape.kind = StaticShape::Kind::box;
    shape.worldFromShape.translation = centre;
    shape.halfExtents = halfExtents;
    return shape;
}

vec3 anyAxis(Random& random) {
    return glm::normalize(vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1F, 1)));
}

StressCondition at(std::string name, std::string scene, std::vector<float> frames) {
    StressCondition made{std::move(name), std::move(scene)};
    made.frames = std::move(frames);
    return made;
}

void addRates(std::vector<StressCondition>& all) {
    for (const char* scene : {"drop", "throw", "stairs"}) {
        for (const int rate : {20, 30, 50, 60, 90, 120, 144, 240})
            all.push_back(
                at(std::string(scene) + "-hz" + std::to_string(rate), scene, {1.0F / static_cast<float>(rate)}));
        all.push_back(at(std::string(scene) + "-varies", scene,
                         {0.033F, 0.007F, 0.016F, 0.004F, 0.021F, 0.030F, 0.011F, 0.0166F, 0.025F, 0.005F}));
        std::vector<float> hitch(30, kFrame);
        hitch.back() = 0.1F;
        all.push_back(at(std::string(scene) + "-hitch", scene, hitch));
    }
}

void addSizes(std::vector<StressCondition>& all) {
    for (const char* scene : {"drop", "throw"}) {
        const auto add = [&](const std::string& name, const std::function<void(StressCondition&)>& set) {
            StressCondition made{std::string(scene) + "-" + name, scene};
            set(made);
            all.push_back(std::move(made));
        };
        for (const auto& [name, height] :
             {std::pair("0.2m", 0.2F), std::pair("0.5m", 0.5F), std::pair("4m", 4.0F), std::pair("20m", 20.0F)})
            add(name, [h = height](StressCondition& c) {
                c.heightM = h;
                c.seconds = h > 3.0F ? 12.0F : 6.0F;
            });
        for (const float mass : {0.5F, 5.0F, 300.0F, 5000.0F})
            add(std::to_string(static_cast<int>(mass)) + "kg", [&](StressCondition& c) { c.fit.totalMassKg = mass; });
        add("moon", [](StressCondition& c) {
            c.gravity = {0, -1.62F, 0};
            c.seconds = 15.0F;
        });
        add("2g", [](StressCondition& c) { c.gravity = {0, -19.62F, 0}; });
        add("5g", [](StressCondition& c) { c.gravity = {0, -49.0F, 0}; });
        add("sidewards", [](StressCondition& c) { c.gravity = {3, -9.0F, 2}; });
        add("weightless", [](StressCondition& c) { c.gravity = vec3(0); });
        add("ice", [](StressCondition& c) { c.friction = 0.0F; });
        add("rubber", [](StressCondition& c) { c.friction = 3.0F; });
        add("hulls", [](StressCondition& c) { c.fit.hulls = true; });
        add("shapes3", [](StressCondition& c) { c.fit.mostShapes = 3; });
        add("fullbody", [](StressCondition& c) {
            c.fit.allTrunkBodies = c.fit.neckBody = c.fit.toeBodies = c.fit.shoulderBodies = true;
        });
        add("uniform", [](StressCondition& c) { c.fit.massPreset = physics::MassPreset::uniform; });
        add("boxes", [](StressCondition& c) {
            c.change = [](RagdollProfile& profile) {
                for (physics::BodyProfile& body : profile.bodies) {
                    physics::BodyShape& shape = body.shape;
                    if (shape.kind != physics::BodyShape::Kind::capsule) continue;
                    shape.halfExtents = {shape.radius, shape.halfLength + shape.radius, shape.radius};
                    shape.kind = physics::BodyShape::Kind::box;
                }
            };
        });
        add("spheres", [](StressCondition& c) {
            c.change = [](RagdollProfile& profile) {
                for (physics::BodyProfile& body : profile.bodies)
                    body.shape.kind = physics::BodyShape::Kind::sphere;
            };
        });
    }
}

void addLimits(std::vector<StressCondition>& all) {
    const auto add = [&](const std::string& name, const std::function<void(physics::ConstraintProfile&)>& set) {
        for (const char* scene : {"drop", "throw"}) {
            StressCondition made{std::string(scene) + "-" + name, scene};
            made.measuredFrom = 0.5F;  // the pose that it starts in may be beyond them
            made.change = [set](RagdollProfile& profile) {
                for (physics::ConstraintProfile& constraint : profile.constraints)
                    set(constraint);
            };
            all.push_back(std::move(made));
        }
    };
    add("locked", [](physics::ConstraintProfile& c) {
        c.hinge = {0, 0};
        c.cone = {0.001F, 0.001F, 0.001F};
    });
    add("locked1deg", [](physics::ConstraintProfile& c) {
        c.hinge = {-0.0174F, 0.0174F};
        c.cone = {0.0174F, 0.0174F, 0.0174F};
    });
    add("blade", [](physics::ConstraintProfile& c) { c.cone = {0.001F, 2.0F, 0.001F}; });
    add("wide", [](physics::ConstraintProfile& c) {
        c.hinge = {-kPi, kPi};
        c.cone = {3.1F, 3.1F, 3.1F};
    });
    add("loose", [](physics::ConstraintProfile& c) { c.frictionNm = 0.0F; });
    add("rusty", [](physics::ConstraintProfile& c) { c.frictionNm = 1e4F; });
    add("sprung", [](physics::ConstraintProfile& c) { c.spring = {1e4F, 10.0F, quat(1, 0, 0, 0)}; });
}

void addStarts(std::vector<StressCondition>& all) {
    const auto add = [&](const std::string& name, auto place) {
        StressCondition made{name};
        made.place = place;
        all.push_back(std::move(made));
        return &all.back();
    };
    using Bodies = std::vector<BodyState>;
    add("upside-down", [](Bodies& bodies, const RagdollProfile& profile, Random&) {
        turnAll(bodies, centreOf(profile, bodies), glm::angleAxis(kPi, vec3(0, 0, 1)));
        moveAll(bodies, {0, 0.3F * profile.heightM, 0});
    });
    for (const float spin : {20.0F, 50.0F, 100.0F})
        add("spin" + std::to_string(static_cast<int>(spin)),
            [spin](Bodies& bodies, const RagdollProfile& profile, Random& random) {
                moveAll(bodies, {0, profile.heightM, 0});
                spinAll(bodies, centreOf(profile, bodies), vec3(0), spin * anyAxis(random));
            });
    for (const float depth : {0.05F, 0.3F, 1.0F}) {
        StressCondition* made = add("in-floor" + std::to_string(static_cast<int>(100 * depth)),
                                    [depth](Bodies& bodies, const RagdollProfile& profile, Random& random) {
                                        vec3 low(1e9F);
                                        for (const BodyState& body : bodies)
                                            low = glm::min(low, body.worldFromBody.translation);
                                        moveAll(bodies, {0, -low.y - depth, 0});
                                        spinAll(bodies, centreOf(profile, bodies), vec3(0), vec3(0));
                                        for (BodyState& body : bodies)
                                            body.linearVelocity.x = random.uniform(-0.1F, 0.1F);
                                    });
        made->measuredFrom = 3.0F;
        made->seconds = 8.0F;
    }
    {
        StressCondition* made = add("in-wall", [](Bodies& bodies, const RagdollProfile& profile, Random& random) {
            moveAll(bodies, {0.1F * random.uniform(-1, 1), 0, 0.1F * random.uniform(-1, 1) + 0.0F * profile.heightM});
        });
        made->build = [](std::vector<StaticShape>& statics) { statics.push_back(box({0, 1, 0}, {2, 1, 0.2F})); };
        made->measuredFrom = 3.0F;
        made->seconds = 8.0F;
    }
    {
        StressCondition* made = add("in-doll", [](Bodies&, const RagdollProfile&, Random&) {});
        made->dolls = 2;
        made->measuredFrom = 3.0F;
        made->seconds = 10.0F;
    }
    {
        StressCondition* made = add("in-dolls8", [](Bodies&, const RagdollProfile&, Random&) {});
        made->dolls = 8;
        made->measuredFrom = 3.0F;
        made->seconds = 12.0F;
    }
    for (const float speed : {50.0F, 100.0F, 200.0F}) {
        const std::string text = std::to_string(static_cast<int>(speed));
        add("floor-" + text + "mps", [speed](Bodies& bodies, const RagdollProfile& profile, Random& random) {
            moveAll(bodies, {0, profile.heightM, 0});
            turnAll(bodies, centreOf(profile, bodies), glm::angleAxis(random.uniform(-3, 3), anyAxis(random)));
            spinAll(bodies, centreOf(profile, bodies), {0.2F * speed, -speed, 0}, anyAxis(random));
        });
        for (const float thick : {0.1F, 0.02F}) {
            StressCondition* made = add(
                "wall" + std::to_string(static_cast<int>(1000.0F * thick)) + "mm-" + text + "mps",
                [speed](Bodies& bodies, const RagdollProfile& profile, Random& random) {
                    moveAll(bodies, {0, 0.5F * profile.heightM, 0});
                    turnAll(bodies, centreOf(profile, bodies), glm::angleAxis(random.uniform(-3, 3), anyAxis(random)));
                    spinAll(bodies, centreOf(profile, bodies), {0, 0, speed}, anyAxis(random));
                });
            made->build = [thick](std::vector<StaticShape>& statics) {
                statics.push_back(box({0, 5, 5}, {8, 8, 0.5F * thick}));
            };
            made->wall = 5.0F;
        }
    }
}

// Pulls both hands towards two points `apart` metres from each other.
void hangUp(StressRun& run, float force, float apart) {
    for (const physics::Role role : {physics::Role::leftHand, physics::Role::rightHand}) {
        const int hand = physics::bodyOf(run.profile, role);
        const float side = role == physics::Role::leftHand ? 0.5F : -0.5F;
        if (hand < 0) continue;
        run.drags.push_back(run.world.addDrag(
            {run.world.dolls()[0], hand, vec3(0), vec3(side * apart, 1.2F * run.profile.heightM, 0), force}));
    }
}

void addPulls(std::vector<StressCondition>& all) {
    for (const auto& [name, force, apart] : {std::tuple("pinned", 5e3F, 1.0F), std::tuple("pinned-hard", 1e5F, 1.0F),
                                             std::tuple("racked", 5e3F, 2.6F), std::tuple("racked-hard", 1e5F, 2.6F)}) {
        StressCondition made{name};
        made.seconds = 60.0F;
        made.act = [force = force, apart = apart](StressRun& run, int step, double) {
            if (step == 0) hangUp(run, force, apart * run.profile.heightM / 1.75F);
        };
        all.push_back(std::move(made));
    }
    for (const float force : {1500.0F, 2e4F, 1e6F}) {
        StressCondition made{"shaken-" + std::to_string(static_cast<int>(force)) + "N"};
        made.seconds = 30.0F;
        made.act = [force](StressRun& run, int step, double seconds) {
            const int hand = std::max(physics::bodyOf(run.profile, physics::Role::rightHand), 0);
            const float t = static_cast<float>(seconds);
            physics::Drag drag{run.world.dolls()[0], hand, vec3(0)};
            drag.worldTarget = {std::sin(7.0F * t), 1.5F + 0.7F * std::sin(5.0F * t), std::cos(9.0F * t)};
            drag.maxForceN = force;
            if (step == 0)
                run.drags.push_back(run.world.addDrag(drag));
            else
                run.world.setDrag(run.drags[0], drag);
        };
        all.push_back(std::move(made));
    }
    {
        StressCondition made{"into-floor"};  // a hand is pulled into the floor and held there
        made.seconds = 20.0F;
        made.act = [](StressRun& run, int step, double) {
            const int hand = std::max(physics::bodyOf(run.profile, physics::Role::rightHand), 0);
            if (step == 60) run.world.addDrag({run.world.dolls()[0], hand, vec3(0), {0, -0.5F, 0}, 1500.0F});
        };
        all.push_back(std::move(made));
    }
    for (const float impulse : {300.0F, 2000.0F}) {
        StressCondition made{"hit-" + std::to_string(static_cast<int>(impulse)) + "Ns"};
        made.seconds = 20.0F;
        made.act = [impulse](StressRun& run, int step, double) {
            if (step % 60 != 30 || step > 600) return;
            const auto doll = run.world.dolls()[0];
            std::vector<BodyState> bodies(run.profile.bodies.size());
            run.world.getBodies(doll, bodies);
            const auto body = static_cast<std::size_t>(run.random.next() % bodies.size());
            const float size = impulse * run.profile.bodies[body].massKg / run.profile.totalMassKg * 4.0F;
            run.world.applyImpulse(doll, static_cast<int>(body), size * anyAxis(run.random),
                                   bodies[body].worldFromBody.translation);
        };
        all.push_back(std::move(made));
    }
    {
        StressCondition made{"teleported"};
        made.seconds = 20.0F;
        made.addsEnergy = true;
        made.act = [](StressRun& run, int step, double) {
            if (step % 37 == 36 && step < 600) run.world.setBodies(run.world.dolls()[0], run.start);
        };
        all.push_back(std::move(made));
    }
}

void addLong(std::vector<StressCondition>& all) {
    for (const char* scene : {"drop", "stairs", "throw"}) {
        StressCondition made{std::string(scene) + "-600s", scene};
        made.seconds = 600.0F;
        made.sleeping = false;
        made.creepFrom = 60.0F;
        all.push_back(std::move(made));
    }
    {
        StressCondition made{"heap12-120s"};
        made.dolls = 12;
        made.seconds = 120.0F;
        made.sleeping = false;
        made.creepFrom = 60.0F;
        made.measuredFrom = 5.0F;
        all.push_back(std::move(made));
    }
    {
        StressCondition made{"heap12-changed"};  // one is taken away and another added four times a second
        made.dolls = 12;
        made.seconds = 20.0F;
        made.measuredFrom = 5.0F;
        made.addsEnergy = true;
        made.act = [](StressRun& run, int step, double) {
            if (step % 15 != 14 || step < 300) return;
            const std::size_t place = 1 + run.random.next() % (run.world.dolls().size() - 1);
            run.world.removeDoll(run.world.dolls()[place]);
            std::vector<BodyState> bodies = run.start;
            moveAll(bodies, {run.random.uniform(-0.5F, 0.5F), 2.0F, run.random.uniform(-0.5F, 0.5F)});
            run.world.addDoll(run.profile, bodies);
        };
        all.push_back(std::move(made));
    }
    {
        StressCondition made{"heap12-struck"};  // a ball hits the heap once it sleeps
        made.dolls = 12;
        made.seconds = 30.0F;
        made.measuredFrom = 5.0F;
        made.addsEnergy = true;
        made.act = [](StressRun& run, int step, double) {
            if (step != 900) return;
            physics::DynamicProp ball;
            ball.shape.kind = physics::BodyShape::Kind::sphere;
            ball.shape.radius = 0.25F;
            ball.massKg = 60.0F;
            ball.state.worldFromBody.translation = {-4, 0.8F, 0};
            ball.state.linearVelocity = {15, 0, 0};
            run.world.addProp(ball);
        };
        all.push_back(std::move(made));
    }
}

}  // namespace

std::vector<StressCondition> stressConditions() {
    std::vector<StressCondition> all;
    all.reserve(256);  // so that what a call returns stays where it is
    addRates(all);
    addSizes(all);
    addLimits(all);
    addStarts(all);
    addPulls(all);
    addLong(all);
    return all;
}

}  // namespace lutka::bench
