#include <fmt/format.h>

#include <cmath>

#include "animation/export/write_glb.hpp"
#include "animation/skinning.hpp"
#include "bindings/keep_model.hpp"
#include "bindings/sealed.hpp"
#include "bindings/simulation_object.hpp"
#include "scene/measure/report.hpp"
#include "scene/run/bake.hpp"

namespace lutka::python {
namespace {

using physics::BodyState;

void checkAlpha(float alpha) {
    if (alpha >= 0.0F && alpha <= 1.0F) return;
    raise({ErrorCode::usage, fmt::format("alpha is {}", alpha), "alpha",
           "0 is the state before the last step, 1 the present one"});
}

int stepsOf(const SimulationObject& simulation, double seconds) {
    const double steps = std::round(seconds / static_cast<double>(simulation.facts().options().dt));
    if (steps >= 0.0 && steps <= 1e9) return static_cast<int>(steps);
    raise({ErrorCode::usage, fmt::format("{} seconds", seconds), "seconds", "give a finite number of at least 0"});
}

void stepOnce(SimulationObject& simulation) {
    simulation.use([](scene::Simulation& s) { s.step(); });
    heedSignals();
}

void step(SimulationObject& simulation, int count) {
    if (count < 0) raise({ErrorCode::usage, fmt::format("{} steps", count), "step()", "give a number of at least 0"});
    for (int i = 0; i < count; ++i)
        stepOnce(simulation);
}

std::vector<BodyState> statesOf(SimulationObject& simulation, int doll) {
    std::vector<BodyState> states(simulation.ragdollOf(doll)->profile.bodies.size());
    simulation.use([&](scene::Simulation& s) { s.getBodies(doll, states); });
    return states;
}

py::array_t<float> velocities(SimulationObject& simulation, int doll) {
    const std::vector<BodyState> states = statesOf(simulation, simulation.checkedDoll("velocities", doll));
    py::array_t<float> array({static_cast<py::ssize_t>(states.size()), py::ssize_t{6}});
    auto rows = array.mutable_unchecked<2>();
    for (py::ssize_t body = 0; body < rows.shape(0); ++body) {
        const BodyState& state = states[static_cast<std::size_t>(body)];
        for (py::ssize_t axis = 0; axis < 3; ++axis) {
            rows(body, axis) = state.linearVelocity[static_cast<int>(axis)];
            rows(body, axis + 3) = state.angularVelocity[static_cast<int>(axis)];
        }
    }
    return array;
}

// Rows of (x, y, z, w, px, py, pz), and of linear and angular velocities; what is missing is at rest.
void setBodies(SimulationObject& simulation, int doll, const py::object& frames, const py::object& motion) {
    simulation.checkedDoll("set_bodies", doll);
    const auto count = static_cast<py::ssize_t>(simulation.ragdollOf(doll)->profile.bodies.size());
    const auto places = rowsOf(frames, count, kFrameNumbers, "set_bodies(): frames");
    std::vector<BodyState> states(static_cast<std::size_t>(count));
    for (py::ssize_t body = 0; body < count; ++body) {
        const float* row = places.data(body, 0);
        RigidTransform& frame = states[static_cast<std::size_t>(body)].worldFromBody;
        frame = {quat(row[3], row[0], row[1], row[2]), vec3(row[4], row[5], row[6])};
        const float length = glm::length(frame.rotation);
        if (!(std::abs(length - 1.0F) < 1e-2F))
            raise({ErrorCode::usage, fmt::format("the rotation of body {} has length {}", body, length), "set_bodies()",
                   "give unit quaternions (x, y, z, w)"});
        frame.rotation = glm::normalize(frame.rotation);
    }
    if (!motion.is_none()) {
        const auto rates = rowsOf(motion, count, 6, "set_bodies(): velocities");
        for (py::ssize_t body = 0; body < count; ++body) {
            const float* row = rates.data(body, 0);
            states[static_cast<std::size_t>(body)].linearVelocity = {row[0], row[1], row[2]};
            states[static_cast<std::size_t>(body)].angularVelocity = {row[3], row[4], row[5]};
        }
    }
    simulation.command("set_bodies", [&](scene::Simulation& s) {
        s.world().setBodies(s.dollId(doll), states);
        s.refresh();
    });
}

using Vector = std::optional<vec3>;

void push(SimulationObject& simulation, bool impulse, int doll, const py::object& which, const vec3& amount,
          const Vector& point) {
    const char* call = impulse ? "apply_impulse" : "apply_force";
    const int body = simulation.checkedBody(call, doll, which);
    simulation.command(call, [&](scene::Simulation& s) {
        const vec3 at = point.value_or(s.worldFromBody(doll)[static_cast<std::size_t>(body)].translation);
        if (impulse)
            s.world().applyImpulse(s.dollId(doll), body, amount, at);
        else
            s.world().applyForce(s.dollId(doll), body, amount, at);
    });
}

// The constraint above a body, as the world counts them.
int jointAbove(const SimulationObject& simulation, const char* call, int doll, const py::object& which) {
    const int body = simulation.checkedBody(call, doll, which);
    if (body > 0) return body - 1;
    raise({ErrorCode::usage, "the root hangs on nothing and has no motor", std::string(call) + "()",
           "name any other body"});
}

// What the motor holds when it is told nothing: the joint as it is.
void targetNow(const physics::RagdollProfile& profile, int joint, std::span<const RigidTransform> bodies,
               physics::JointMotor& motor) {
    const physics::ConstraintProfile& constraint = profile.constraints[static_cast<std::size_t>(joint)];
    const RigidTransform& parent = bodies[static_cast<std::size_t>(constraint.parent)];
    const RigidTransform& child = bodies[static_cast<std::size_t>(constraint.child)];
    motor.target = glm::normalize(glm::conjugate(parent.rotation * constraint.parentFromFrame.rotation) *
                                  (child.rotation * constraint.childFromFrame.rotation));
    motor.angle = 2.0F * std::atan2(motor.target.z, motor.target.w);
    if (motor.angle > kPi) motor.angle -= 2.0F * kPi;
    if (motor.angle < -kPi) motor.angle += 2.0F * kPi;
}

void setMotor(SimulationObject& simulation, int doll, const py::object& which, const py::kwargs& given) {
    const int joint = jointAbove(simulation, "set_motor", doll, which);
    Keywords keywords("set_motor", given);
    physics::JointMotor motor;
    std::optional<quat> target;
    std::optional<float> angle;
    keywords.take("target", target);
    keywords.take("angle", angle);
    keywords.take("stiffness", motor.stiffness);
    keywords.take("damping", motor.damping);
    keywords.take("max_torque", motor.maxTorqueNm);
    keywords.take("rate", motor.rate);
    keywords.finish();
    if (target && !(std::abs(glm::length(*target) - 1.0F) < 1e-2F))
        raise({ErrorCode::usage, "the target is no unit quaternion", "set_motor()", "give (x, y, z, w) of length 1"});
    simulation.command("set_motor", [&](scene::Simulation& s) {
        targetNow(s.assetOf(doll).profile, joint, s.worldFromBody(doll), motor);
        if (target) motor.target = glm::normalize(*target);
        if (angle) motor.angle = *angle;
        s.world().setMotor(s.dollId(doll), joint, motor);
    });
}

void clearMotor(SimulationObject& simulation, int doll, const py::object& which) {
    const int joint = jointAbove(simulation, "clear_motor", doll, which);
    simulation.command("clear_motor", [&](scene::Simulation& s) { s.world().setMotor(s.dollId(doll), joint, {}); });
}

/// A pull on a body, until it is removed or the simulation is reset.
class DragObject {
  public:
    DragObject(SimulationPointer simulation, int doll, physics::Drag drag) : simulation_(std::move(simulation)) {
        simulation_->command("drag", [&](scene::Simulation& s) {
            drag.doll = s.dollId(doll);
            id_ = s.world().addDrag(drag);
            resets_ = simulation_->resets();
        });
    }

    [[nodiscard]] bool active() {
        return resets_ == simulation_->resets() &&
               simulation_->use([this](scene::Simulation& s) { return s.world().has(id_); });
    }
    void setTarget(const vec3& target) {
        needsToBe();
        simulation_->command("Drag.target", [&](scene::Simulation& s) {
            physics::Drag drag = s.world().dragOf(id_);
            drag.worldTarget = target;
            s.world().setDrag(id_, drag);
        });
    }
    [[nodiscard]] vec3 target() {
        needsToBe();
        return simulation_->use([this](scene::Simulation& s) { return s.world().dragOf(id_).worldTarget; });
    }
    void remove() {
        if (active()) simulation_->command("Drag.remove", [this](scene::Simulation& s) { s.world().removeDrag(id_); });
    }

  private:
    void needsToBe() {
        if (!active())
            raise({ErrorCode::usage, "this pull was removed, or its simulation reset", "Drag", "begin another"});
    }

    SimulationPointer simulation_;
    physics::DragId id_;
    int resets_ = 0;
};

DragObject drag(const SimulationPointer& simulation, int doll, const py::object& which, const vec3& target,
                const vec3& point, float maxForce) {
    const int body = simulation->checkedBody("drag", doll, which);
    return DragObject(simulation, doll, {{}, body, point, target, maxForce});
}

// All dolls' joints or palettes, posed anew where something moved.
struct Posed {
    const void* numbers = nullptr;
    py::ssize_t joints = 0;
};
template <class Part>
Posed posed(SimulationObject& simulation, float alpha, const Part& part) {
    if (simulation.facts().dollCount() == 0) return {};
    const void* numbers = simulation.use([&](scene::Simulation& s) { return part(s.poseSkins(alpha)); });
    py::ssize_t joints = 0;
    for (int doll = 0; doll < simulation.facts().dollCount(); ++doll)
        joints += simulation.ragdollOf(doll)->character.skeleton.jointCount();
    return {numbers, joints};
}

py::ssize_t firstJointOf(const SimulationObject& simulation, int doll) {
    py::ssize_t joints = 0;
    for (int before = 0; before < doll; ++before)
        joints += simulation.ragdollOf(before)->character.skeleton.jointCount();
    return joints;
}

py::array poses(const py::object& self, float alpha) {
    checkAlpha(alpha);
    const Posed all = posed(self.cast<SimulationObject&>(), alpha, [](const scene::PosedSkins& skins) {
        return static_cast<const void*>(skins.modelFromJoint(0).data());
    });
    return viewOf(all.numbers, {all.joints, kFrameNumbers}, self);
}

py::array palettes(const py::object& self, float alpha) {
    static_assert(sizeof(animation::SkinMatrix) == 12 * sizeof(float));
    checkAlpha(alpha);
    const Posed all = posed(self.cast<SimulationObject&>(), alpha, [](const scene::PosedSkins& skins) {
        return static_cast<const void*>(skins.palette(0).data());
    });
    return viewOf(all.numbers, {all.joints, 3, 4}, self);
}

py::object pose(const py::object& self, int doll, float alpha) {
    const auto& simulation = self.cast<const SimulationObject&>();
    const int joints = simulation.ragdollOf(simulation.checkedDoll("pose", doll))->character.skeleton.jointCount();
    const py::ssize_t first = firstJointOf(simulation, doll);
    return poses(self, alpha)[py::slice(first, first + joints, 1)];
}

// The skin's vertices in the world, an array a mesh.
std::vector<py::array_t<float>> skin(SimulationObject& simulation, int doll, float alpha) {
    const RagdollPointer asset = simulation.ragdollOf(simulation.checkedDoll("skin", doll));
    checkAlpha(alpha);
    std::vector<py::array_t<float>> meshes;
    std::vector<std::span<vec3>> outputs;
    for (const animation::SkinnedMesh& mesh : asset->character.meshes) {
        meshes.emplace_back(std::vector<py::ssize_t>{static_cast<py::ssize_t>(mesh.positions.size()), 3});
        outputs.emplace_back(static_cast<vec3*>(static_cast<void*>(meshes.back().mutable_data())),
                             mesh.positions.size());
    }
    simulation.use([&](scene::Simulation& s) {
        const std::span<const animation::SkinMatrix> palette = s.poseSkins(alpha).palette(doll);
        for (std::size_t i = 0; i < outputs.size(); ++i) {
            animation::skinVertices(asset->character.meshes[i], palette, outputs[i], {});
            for (vec3& position : outputs[i])
                position = s.worldFromModel(doll) * position;
        }
    });
    return meshes;
}

int bake(SimulationObject& simulation, const std::filesystem::path& file, const std::optional<double>& seconds,
         int doll, const std::string& name, bool reduce) {
    simulation.checkedDoll("bake", doll);
    const int steps = stepsOf(simulation, seconds.value_or(static_cast<double>(simulation.facts().scenario().seconds)));
    constexpr int kMostFrames = 36000;  // ten minutes at 60 Hz
    if (steps > kMostFrames)
        raise({ErrorCode::usage, fmt::format("{} frames", steps), "bake()", fmt::format("at most {}", kMostFrames)});
    keepModel(file, simulation.ragdollOf(doll)->character.file);
    scene::ClipBaker baker(doll, 1.0F / simulation.facts().options().dt, name);
    const auto sample = [&] { simulation.use([&](scene::Simulation& s) { baker.sample(s); }); };
    sample();
    for (int i = 0; i < steps; ++i) {
        stepOnce(simulation);
        sample();
    }
    const RagdollPointer asset = simulation.ragdollOf(doll);
    orRaise(withoutGil([&] {
        return animation::writeGlb(file, asset->character, std::span(&baker.clip(), 1),
                                   simulation.facts().worldFromModel(doll), animation::keysKept(!reduce));
    }));
    return steps + 1;
}

std::vector<RagdollObject> ragdollsOf(const SimulationObject& simulation) {
    std::vector<RagdollObject> all;
    for (int doll = 0; doll < simulation.facts().dollCount(); ++doll)
        all.push_back({simulation.ragdollOf(doll)});
    return all;
}

using SimulationClass = py::class_<SimulationObject, SimulationPointer>;

void bindRunning(SimulationClass& simulation) {
    // Whole from __new__ on (see sealed.hpp); pybind11 passes over the __init__ of what it knows already.
    simulation
        .def_static(
            "__new__",
            [](const py::handle& /*type*/, const RagdollObject& ragdoll, const std::string& scene,
               const py::kwargs& given) { return makeSimulation(ragdoll, scene, given); },
            py::arg("cls"), py::arg("ragdoll"), py::arg("scene") = "drop")
        .def(py::init(&makeSimulation), py::arg("ragdoll"), py::arg("scene") = "drop")
        .def_static("load", &loadSimulation, py::arg("file"), py::arg("model") = std::filesystem::path(),
                    "The simulation of a scene file (docs/scene.md); characters without a model take `model`.")
        .def("step", &step, py::arg("count") = 1, "Steps of `dt` seconds. Other threads run meanwhile.")
        .def(
            "run", [](SimulationObject& s, double seconds) { step(s, stepsOf(s, seconds)); }, py::arg("seconds"),
            "Steps for so long.")
        .def("reset", &SimulationObject::reset, "Back to the start: the same bits again. Motors and pulls are gone.")
        .def_property_readonly(
            "steps", [](SimulationObject& s) { return s.use([](scene::Simulation& w) { return w.steps(); }); },
            "Done so far.")
        .def_property_readonly(
            "seconds", [](SimulationObject& s) { return s.use([](scene::Simulation& w) { return w.seconds(); }); },
            "Simulated so far.")
        .def_property_readonly(
            "dt", [](const SimulationObject& s) { return s.facts().options().dt; }, "Seconds a step.")
        .def_property_readonly(
            "scene", [](const SimulationObject& s) { return s.facts().scenario().name; }, "The scene's name.")
        .def_property_readonly(
            "scene_seconds", [](const SimulationObject& s) { return s.facts().scenario().seconds; },
            "How long the scene takes, as its author has it.")
        .def_property_readonly(
            "doll_count", [](const SimulationObject& s) { return s.facts().dollCount(); },
            "How many dolls there are; they are counted from 0.")
        .def_property_readonly("ragdolls", &ragdollsOf, "The Ragdoll of each doll.")
        .def(
            "report",
            [](SimulationObject& s) {
                return fromJson(s.use([](scene::Simulation& w) { return scene::reportJson(w); }));
            },
            "The figures of the run, as `lutka simulate --json` has them.")
        .def_property_readonly(
            "state_hash", [](SimulationObject& s) { return s.use([](scene::Simulation& w) { return w.stateHash(); }); },
            "Of all bodies, bit for bit.")
        .def("__repr__", [](const SimulationObject& s) {
            return fmt::format("<lutka.Simulation {}: {} dolls>", s.facts().scenario().name, s.facts().dollCount());
        });
}

void bindStates(SimulationClass& simulation) {
    simulation
        .def_property_readonly(
            "bodies", [](const py::object& self) { return viewOf(self.cast<SimulationObject&>().bodies(), self); },
            "Where the bodies of all dolls are now, one doll after the other: (bodies, 7) floats, rotation (x, y, z, "
            "w) "
            "then position, world. A read-only view, without a copy: it changes with every step and keeps the "
            "simulation alive.")
        .def(
            "bodies_of",
            [](const py::object& self, int doll) {
                auto& s = self.cast<SimulationObject&>();
                return viewOf(s.bodies(s.checkedDoll("bodies_of", doll)), self);
            },
            py::arg("doll"), "The same of one doll.")
        .def("velocities", &velocities, py::arg("doll") = 0,
             "(bodies, 6) floats: linear m/s, then angular rad/s, world. A copy.")
        .def(
            "asleep",
            [](SimulationObject& s, int doll) {
                s.checkedDoll("asleep", doll);
                return s.use([&](scene::Simulation& w) { return w.isAsleep(doll); });
            },
            py::arg("doll") = 0)
        .def("poses", &poses, py::arg("alpha") = 1.0F,
             "The joints of all dolls' skins, one doll after the other: (joints, 7) floats in each doll's model space, "
             "`alpha` of the way from "
             "before the last step. A read-only view that changes with the next call of poses(), pose(), palettes() or "
             "skin().")
        .def("pose", &pose, py::arg("doll") = 0, py::arg("alpha") = 1.0F, "The same of one doll.")
        .def("palettes", &palettes, py::arg("alpha") = 1.0F,
             "The skin matrices of all dolls for a shader, (joints, 3, 4), likewise.")
        .def("skin", &skin, py::arg("doll") = 0, py::arg("alpha") = 1.0F,
             "A doll's skin in the world: an array (vertices, 3) a mesh. Copies.")
        .def(
            "world_from_model",
            [](const py::object& self, int doll) -> py::object {
                const auto& s = self.cast<const SimulationObject&>();
                return viewOf(std::span(&s.facts().worldFromModel(s.checkedDoll("world_from_model", doll)), 1),
                              self)[py::int_(0)];
            },
            py::arg("doll") = 0, "What a doll's pose is relative to: 7 floats, constant.");
}

void bindActing(SimulationClass& simulation) {
    simulation
        .def(
            "apply_impulse",
            [](SimulationObject& s, int doll, const py::object& body, const vec3& impulse, const Vector& point) {
                push(s, true, doll, body, impulse, point);
            },
            py::arg("doll"), py::arg("body"), py::arg("impulse"), py::arg("point") = py::none(),
            "An impulse in N s on a body (name or number) at a world point, its centre if none is given.")
        .def(
            "apply_force",
            [](SimulationObject& s, int doll, const py::object& body, const vec3& force, const Vector& point) {
                push(s, false, doll, body, force, point);
            },
            py::arg("doll"), py::arg("body"), py::arg("force"), py::arg("point") = py::none(),
            "A force in N throughout the next step, likewise.")
        .def("set_motor", &setMotor, py::arg("doll"), py::arg("body"),
             "A spring in the joint above a body: target=(x, y, z, w) of a cone or angle=radians of a hinge (where it "
             "is now if "
             "neither is given), stiffness N m/rad, damping N m s/rad, max_torque N m, rate=(x, y, z) rad/s.")
        .def("clear_motor", &clearMotor, py::arg("doll"), py::arg("body"), "Turns that motor off.")
        .def("drag", &drag, py::arg("doll"), py::arg("body"), py::arg("target"), py::arg("point") = vec3(0),
             py::arg("max_force") = 1500.0F,
             "Begins to pull a point of a body (in its own space) to a point of the world, with at most so many "
             "newtons.")
        .def("set_bodies", &setBodies, py::arg("doll"), py::arg("frames"), py::arg("velocities") = py::none(),
             "Places a doll: rows as in `bodies` and `velocities`, at rest if the latter are left out.")
        .def(
            "wake",
            [](SimulationObject& s, int doll) {
                s.checkedDoll("wake", doll);
                s.command("wake", [&](scene::Simulation& w) { w.world().wake(w.dollId(doll)); });
            },
            py::arg("doll") = 0);
}

}  // namespace

void bindSimulation(py::module_& module) {
    SimulationClass simulation(module, "Simulation", py::is_final(),
                               "Dolls in a scene, step by step. The same arguments give the same bits.");
    bindRunning(simulation);
    bindStates(simulation);
    bindActing(simulation);
    py::class_<DragObject> pull(module, "Drag", py::is_final(), "A pull on a body.");
    neverMadeByItself(pull, "simulation.drag(...) gives a Drag");
    pull.def_property_readonly("active", &DragObject::active, "Whether it still pulls.")
        .def_property("target", &DragObject::target, &DragObject::setTarget, "The world point that it pulls to.")
        .def("remove", &DragObject::remove, "Ends it; nothing happens when it has ended.");
    module.def(
        "bake", &bake, py::arg("simulation"), py::arg("file"), py::arg("seconds") = py::none(), py::arg("doll") = 0,
        py::arg("name") = "fall", py::arg("reduce") = true,
        "Steps the simulation from where it is, for the scene's seconds if none are given, and writes a doll's "
        "skin with "
        "its motion as an animation (.glb). Keys are left out without which no joint is off by more than 0.1 mm or "
        "0.05 degrees, unless `reduce` is False. Returns the number of frames.");
    std::vector<std::string> scenes;
    for (const scene::ScenarioInfo& info : scene::scenarioRegistry())
        scenes.emplace_back(info.name);
    module.attr("scenes") = py::tuple(py::cast(scenes));
}

}  // namespace lutka::python
