// data_path MODEL: the cost of every arrow of the data path on one model, in turn, as CSV; and the ratio of import +
// map + fit to Assimp's own reading of the file, which is the floor of any import that uses it.
//
// Medians over interleaved rounds, so that a noisy machine treats all alike.
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <chrono>
#include <cstring>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "animation/pose.hpp"
#include "animation/pose_batch.hpp"
#include "animation/skinning.hpp"
#include "physics/rig/doll_poser.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/draw/draw_simulation.hpp"
#include "timing.hpp"

namespace {

using namespace lutka;

struct Case {
    std::string name;
    std::string unit;  // what `count` counts
    double count = 1;
    std::function<void()> run;
    std::vector<double> ms;
};

// As a program would read a rigged model with Assimp alone.
void readWithAssimp(const std::string& file) {
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(file, aiProcess_Triangulate | aiProcess_SortByPType |
                                                       aiProcess_CalcTangentSpace | aiProcess_GenSmoothNormals |
                                                       aiProcess_LimitBoneWeights | aiProcess_JoinIdenticalVertices);
    if (scene == nullptr) fmt::print(stderr, "{}\n", importer.GetErrorString());
}

constexpr int kInstances = 1000;
constexpr int kRounds = 15;
constexpr int kSkinPasses = 10;

// What the crowd's cases read and write: one array for all instances, so that they leave the cache as a crowd's do.
struct Crowd {
    const scene::RagdollAsset& asset;
    std::size_t joints = asset.character.skeleton.parents.size();
    std::vector<RigidTransform> bodies;  // of one doll
    std::vector<RigidTransform> worldFromBody;
    std::vector<RigidTransform> worldFromModel;
    std::vector<RigidTransform> locals;
    std::vector<RigidTransform> poses;
    std::vector<RigidTransform> poseCopies;
    std::vector<animation::SkinMatrix> palettes;
    std::vector<animation::SkinMatrix> paletteCopies;
    std::vector<int> instances;
    TaskPool pool;
    TaskPool twoThreads{2};
    animation::PoseBatch batch{asset.character.skeleton, pool};
    physics::DollPoser poser{asset.rig, asset.character.skeleton, pool};
    physics::DollPoser poserOnTwo{asset.rig, asset.character.skeleton, twoThreads};

    explicit Crowd(const scene::RagdollAsset& from) : asset(from) {
        const animation::Skeleton& skeleton = asset.character.skeleton;
        std::vector<physics::BodyState> states(asset.profile.bodies.size());
        physics::bodiesFromPose(asset.rig, skeleton.bindModelFromJoint, {}, states);
        for (const physics::BodyState& state : states)
            bodies.push_back(state.worldFromBody);
        for (int i = 0; i < kInstances; ++i) {
            worldFromBody.insert(worldFromBody.end(), bodies.begin(), bodies.end());
            locals.insert(locals.end(), skeleton.nodeParentFromJoint.begin(), skeleton.nodeParentFromJoint.end());
        }
        worldFromModel.resize(kInstances);
        instances.resize(kInstances);
        std::iota(instances.begin(), instances.end(), 0);
        poses.resize(locals.size());
        poseCopies.resize(locals.size());
        palettes.resize(locals.size());
        paletteCopies.resize(locals.size());
    }

    template <class Body>
    void each(const Body& body) {
        for (std::size_t i = 0; i < kInstances; ++i)
            body(i * joints);
    }
    [[nodiscard]] double jointCount() const { return static_cast<double>(joints) * kInstances; }
    [[nodiscard]] physics::DollPoser::Source source(float alpha) const {
        return {worldFromBody, worldFromBody, alpha, worldFromModel, {}, {}};
    }
};

// A simulation's dolls as they are drawn, without a renderer: all in motion or all at rest.
struct Drawn {
    std::unique_ptr<scene::Simulation> simulation;
    std::vector<RigidTransform> frames[2];  // to be shown in turn
    scene::SimulationDrawer drawer;
    render::FrameDescription frame;
    std::size_t next = 0;

    explicit Drawn(const scene::RagdollAsset& asset) {
        auto scenario = scene::makeScenario({.name = "spread", .count = kInstances}, asset);
        scene::SimulationOptions options;
        options.world.solver = physics::SolverKind::crowd;
        options.measure = false;
        simulation = std::move(scene::Simulation::create(asset, std::move(scenario).value(), options)).value();
        for (std::vector<RigidTransform>& bodies : frames) {
            for (int doll = 0; doll < kInstances; ++doll) {
                const auto of = simulation->worldFromBody(doll);
                bodies.insert(bodies.end(), of.begin(), of.end());
            }
        }
        for (RigidTransform& body : frames[1])
            body.translation.y += 0.01F;
    }
    void draw(bool moving) {
        if (moving) ++next;
        simulation->show(frames[next % 2]);
        frame.clear();
        drawer.draw(*simulation, render::CharacterHandle{0}, {}, 0.5F, 1.0F, frame);
    }
};

struct Vertices {
    const animation::Character& character;
    std::vector<std::vector<vec3>> positions, normals, copies;

    explicit Vertices(const animation::Character& from) : character(from) {
        for (const animation::SkinnedMesh& mesh : character.meshes) {
            positions.emplace_back(mesh.positions.size());
            normals.emplace_back(mesh.positions.size());
            copies.emplace_back(mesh.positions.size() * 2);
        }
    }
    [[nodiscard]] double count() const {
        double sum = 0;
        for (const auto& mesh : positions)
            sum += static_cast<double>(mesh.size());
        return sum;
    }
    // Not the whole of what skinning moves: it also reads a vertex's joints and weights.
    void copy() {
        for (std::size_t i = 0; i < copies.size(); ++i) {
            const std::size_t bytes = positions[i].size() * sizeof(vec3);
            std::memcpy(static_cast<void*>(copies[i].data()), positions[i].data(), bytes);
            std::memcpy(static_cast<void*>(copies[i].data() + positions[i].size()), normals[i].data(), bytes);
        }
    }
};

// Import, mapping and fit beside Assimp alone; the first four cases.
void addFileCases(const std::string& file, const scene::LoadOptions& options, const scene::RagdollAsset& asset,
                  std::vector<Case>& cases) {
    cases.push_back({"assimp reads", "file", 1, [=] { readWithAssimp(file); }, {}});
    cases.push_back({"importCharacter",
                     "file",
                     1,
                     [=] { static_cast<void>(animation::importCharacter(file, options.import)); },
                     {}});
    cases.push_back(
        {"mapHumanoid", "character", 1, [&asset] { static_cast<void>(animation::mapHumanoid(asset.character)); }, {}});
    cases.push_back({"fitRagdoll",
                     "character",
                     1,
                     [&asset] { static_cast<void>(physics::fitRagdoll(asset.character, asset.map)); },
                     {}});
}

void addPoseCases(Crowd& crowd, std::vector<Case>& cases) {
    const auto add = [&](const char* name, std::function<void()> run) {
        cases.push_back({name, "joint", crowd.jointCount(), std::move(run), {}});
    };
    const animation::Skeleton& skeleton = crowd.asset.character.skeleton;
    const std::size_t joints = crowd.joints;
    add("localToModel, one by one", [&crowd, &skeleton, joints] {
        crowd.each([&](std::size_t at) {
            animation::localToModel(skeleton, std::span(crowd.locals).subspan(at, joints),
                                    std::span(crowd.poses).subspan(at, joints));
        });
    });
    add("poseFromBodies, one by one", [&crowd, &skeleton, joints] {
        crowd.each([&](std::size_t at) {
            physics::poseFromBodies(crowd.asset.rig, skeleton, crowd.bodies, {},
                                    std::span(crowd.poses).subspan(at, joints));
        });
    });
    add("skinMatrices, one by one", [&crowd, &skeleton, joints] {
        crowd.each([&](std::size_t at) {
            animation::skinMatrices(skeleton.bindModelFromJoint, std::span(crowd.poses).subspan(at, joints),
                                    std::span(crowd.palettes).subspan(at, joints));
        });
    });
    add("PoseBatch: local to model and palette",
        [&crowd] { crowd.batch.run(crowd.instances, crowd.locals, crowd.palettes, crowd.poses); });
    add("DollPoser: bodies to palette",
        [&crowd] { crowd.poser.run(crowd.source(1.0F), crowd.instances, crowd.palettes); });
    add("DollPoser: between two steps, poses too",
        [&crowd] { crowd.poser.run(crowd.source(0.5F), crowd.instances, crowd.palettes, crowd.poses); });
    add("DollPoser: the same on two threads",
        [&crowd] { crowd.poserOnTwo.run(crowd.source(0.5F), crowd.instances, crowd.palettes, crowd.poses); });
    add("copy of poses and palettes", [&crowd] {
        std::memcpy(static_cast<void*>(crowd.paletteCopies.data()), crowd.palettes.data(),
                    crowd.palettes.size() * sizeof crowd.palettes[0]);
        std::memcpy(static_cast<void*>(crowd.poseCopies.data()), crowd.poses.data(),
                    crowd.poses.size() * sizeof crowd.poses[0]);
    });
}

void addDrawerCases(Drawn& drawn, std::vector<Case>& cases) {
    cases.push_back({"SimulationDrawer: dolls in motion", "doll", kInstances, [&drawn] { drawn.draw(true); }, {}});
    // Twice first: what has just come to rest is posed once more.
    const auto rest = [&drawn] {
        for (int time = 0; time < kSkinPasses; ++time)
            drawn.draw(false);
    };
    cases.push_back({"SimulationDrawer: coming to rest",
                     "doll",
                     2 * kInstances,
                     [&drawn] {
                         drawn.draw(false);
                         drawn.draw(false);
                     },
                     {}});
    cases.push_back({"SimulationDrawer: dolls at rest", "doll", kInstances * kSkinPasses, rest, {}});
}

void addSkinCases(Vertices& vertices, std::span<const animation::SkinMatrix> palette, std::vector<Case>& cases) {
    const auto add = [&](const char* name, std::function<void()> run) {
        // Several times over, or the cases before would decide how much of the mesh the cache holds.
        const auto again = [run = std::move(run)] {
            for (int pass = 0; pass < kSkinPasses; ++pass)
                run();
        };
        cases.push_back({name, "vertex", vertices.count() * kSkinPasses, again, {}});
    };
    const auto skin = [&vertices, palette](InstructionSet set, bool wide) {
        for (std::size_t i = 0; i < vertices.positions.size(); ++i) {
            const auto& run = wide ? static_cast<void (*)(InstructionSet, const animation::SkinnedMesh&,
                                                          std::span<const animation::SkinMatrix>, std::span<vec3>,
                                                          std::span<vec3>, std::span<vec4>)>(animation::skinVertices)
                                   : animation::skinVerticesByScalars;
            run(set, vertices.character.meshes[i], palette, vertices.positions[i], vertices.normals[i], {});
        }
    };
    add("skinVertices, scalars", [=] { skin(InstructionSet::baseline, false); });
    add("skinVertices, four wide", [=] { skin(InstructionSet::baseline, true); });
    if (hasInstructionSet(InstructionSet::avx2)) {
        add("skinVertices, scalars with AVX2's flags", [=] { skin(InstructionSet::avx2, false); });
        add("skinVertices, eight wide", [=] { skin(InstructionSet::avx2, true); });
    }
    add("copy of positions and normals", [&vertices] { vertices.copy(); });
}

// Median over the rounds of the sum of the first cases over the sum of the second.
double ratioOf(std::span<const Case> cases, std::initializer_list<const char*> over,
               std::initializer_list<const char*> under) {
    std::vector<double> ratios;
    for (std::size_t round = 0; round < kRounds; ++round) {
        const auto sum = [&](std::initializer_list<const char*> names) {
            double ms = 0;
            for (const char* name : names)
                for (const Case& one : cases)
                    if (one.name == name) ms += one.ms[round];
            return ms;
        };
        ratios.push_back(sum(over) / sum(under));
    }
    return medianOf(ratios);
}

void printRatios(std::span<const Case> cases) {
    fmt::print("# (import + map + fit) / assimp alone: {:.2f}\n",
               ratioOf(cases, {"importCharacter", "mapHumanoid", "fitRagdoll"}, {"assimp reads"}));
    fmt::print("# (propagation + palette) / copy of their bytes: {:.2f}\n",
               ratioOf(cases, {"PoseBatch: local to model and palette"}, {"copy of poses and palettes"}));
    fmt::print("# (bodies to pose and palette) / copy of their bytes: {:.2f}\n",
               ratioOf(cases, {"DollPoser: between two steps, poses too"}, {"copy of poses and palettes"}));
    fmt::print("# one thread / two: {:.2f}\n",
               ratioOf(cases, {"DollPoser: between two steps, poses too"}, {"DollPoser: the same on two threads"}));
    fmt::print("# skinning, scalars / four wide: {:.2f}\n",
               ratioOf(cases, {"skinVertices, scalars"}, {"skinVertices, four wide"}));
    if (!hasInstructionSet(InstructionSet::avx2)) return;
    fmt::print("# skinning, scalars / eight wide, same flags: {:.2f}\n",
               ratioOf(cases, {"skinVertices, scalars with AVX2's flags"}, {"skinVertices, eight wide"}));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        fmt::print(stderr, "usage: data_path MODEL\n");
        return 2;
    }
    const std::string file = argv[1];
    scene::LoadOptions options;
    options.import.loadTextures = false;
    const auto loaded = scene::loadRagdoll(file, options);
    if (!loaded) {
        fmt::print(stderr, "{}\n", loaded.error().text());
        return 3;
    }
    const scene::RagdollAsset& asset = *loaded.value();
    Crowd crowd(asset);
    Drawn drawn(asset);
    Vertices vertices(asset.character);
    std::vector<Case> cases;
    addFileCases(file, options, asset, cases);
    addPoseCases(crowd, cases);
    addDrawerCases(drawn, cases);
    if (vertices.count() > 0) addSkinCases(vertices, std::span(crowd.palettes).first(crowd.joints), cases);
    for (int round = 0; round < kRounds; ++round) {
        for (Case& one : cases)
            one.ms.push_back(timeOf(one.run));
    }
    fmt::print("case,unit,count,ms,ns_per_unit\n");
    for (const Case& one : cases) {
        const double ms = medianOf(one.ms);
        fmt::print("\"{}\",{},{:.0f},{:.4f},{:.2f}\n", one.name, one.unit, one.count, ms, ms * 1e6 / one.count);
    }
    printRatios(cases);
    return 0;
}
