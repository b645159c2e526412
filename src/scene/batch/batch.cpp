#include "scene/batch/batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "animation/export/write_glb.hpp"
#include "core/files.hpp"
#include "core/input_file.hpp"
#include "core/random.hpp"
#include "scene/description/scene_file.hpp"
#include "scene/measure/quality_json.hpp"
#include "scene/run/bake.hpp"
#include "scene/run/scene_cast.hpp"

namespace lutka::scene {
namespace {

using RowJson = nlohmann::ordered_json;

constexpr const char* kColumns =
    "row,model,profile,rig,scene,seed,count,state,steps,state_hash,separation_max_m,separation_p99_m,limit_max_deg,"
    "limit_p99_deg,ground_penetration_m,self_penetration_m,doll_penetration_m,energy_growth_j,settle_s,residual_mps,"
    "caught,reason\n";
constexpr const char* kNoFigures = ",,,,,,,,,,,,";

// RFC 4180, with line breaks inside a cell as blanks: a row is a line.
std::string cell(std::string text) {
    for (char& c : text)
        if (c == '\n' || c == '\r') c = ' ';
    if (text.find_first_of(",\"") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text)
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

// The shortest decimals that read back as the same numbers.
std::string figuresOf(const Simulation& simulation) {
    const physics::Quality q = simulation.quality();
    return fmt::format("{},{:016x},{},{},{},{},{},{},{},{},{},{},{}", simulation.steps(), simulation.stateHash(),
                       q.jointSeparationM.max, q.jointSeparationM.p99, q.limitViolationDeg.max, q.limitViolationDeg.p99,
                       q.floorPenetrationM, q.selfPenetrationM, q.dollPenetrationM.max, q.energyGrowthJ,
                       q.settleSeconds ? fmt::format("{}", *q.settleSeconds) : std::string(), q.residualSpeedMps,
                       simulation.world().caught().size());
}

// Of what the file holds; a word for what can't be an input: missing, no ordinary file, larger than any reader takes.
std::string hashOfFile(const std::filesystem::path& file) {
    constexpr std::size_t kMostBytes = std::size_t{1} << 30U;
    constexpr std::size_t kAtOnce = std::size_t{1} << 20U;
    const Result<InputFile> in = InputFile::open(file);
    if (!in || in.value().size() > kMostBytes) return "unreadable";
    std::uint64_t hash = kHashStart;
    std::vector<unsigned char> piece;
    for (std::size_t at = 0; at < in.value().size(); at += piece.size()) {
        piece.resize(std::min(in.value().size() - at, kAtOnce));
        if (!in.value().read(at, piece)) return "unreadable";
        hash = hashBytes(piece.data(), piece.size(), hash);
    }
    return fmt::format("{:016x}", hash);
}

std::string dumpRow(const RowJson& json) {
    return json.dump(2, ' ', false, RowJson::error_handler_t::replace) + "\n";
}

}  // namespace

/// The scene's entities with their characters, for all seeds.
struct Batch::Cast {
    std::unique_ptr<RagdollAsset> asset;  // of a named scene
    std::optional<EntityScene> entities;  // of a scene file
    std::optional<SceneCast> cast;        // likewise
};

Batch::Batch(BatchPlan plan, Settings settings) : plan_(std::move(plan)), settings_(std::move(settings)) {}
Batch::~Batch() = default;

const std::string& Batch::bytesHash(const std::filesystem::path& file) {
    const auto known = hashes_.find(file);
    if (known != hashes_.end()) return known->second;
    return hashes_.emplace(file, hashOfFile(file)).first->second;
}

std::string Batch::fingerprint(const BatchRow& row) {
    const BatchModel& model = plan_.models[row.model];
    const BatchScene& scene = plan_.scenes[row.scene];
    RowJson inputs;
    inputs["maker"] = settings_.maker;
    inputs["model"] = {model.name, bytesHash(model.file)};
    if (model.profile) inputs["profile"] = {model.profileName, bytesHash(*model.profile)};
    inputs["rig"] = model.rig == physics::RigKind::any ? "any" : "humanoid";
    inputs["scene"] = {scene.name, scene.file ? bytesHash(*scene.file) : std::string()};
    inputs["seed"] = row.seed;
    inputs["count"] = plan_.count;
    if (plan_.seconds) inputs["seconds"] = *plan_.seconds;
    if (plan_.solver) inputs["solver"] = physics::solverName(*plan_.solver);
    inputs["bake"] = plan_.bake;
    const std::string text = dumpRow(inputs);
    return fmt::format("{:016x}", hashBytes(text.data(), text.size()));
}

// A thousand files a folder: folders stay quick to list.
std::filesystem::path Batch::fileOf(const char* kind, std::size_t row, const char* ending) const {
    return settings_.out / kind / fmt::format("{:03}", row / 1000) / fmt::format("{:06}{}", row, ending);
}

std::string Batch::lineOf(std::size_t row, RowState state, const std::string& figures,
                          const std::string& reason) const {
    const BatchRow& what = plan_.rows[row];
    const BatchModel& model = plan_.models[what.model];
    const BatchScene& scene = plan_.scenes[what.scene];
    constexpr std::array<const char*, 3> kStates{"missing", "done", "failed"};
    return fmt::format("{},{},{},{},{},{},{},{},{},{}\n", row, cell(model.name), cell(model.profileName),
                       model.rig == physics::RigKind::any ? "any" : "humanoid", cell(scene.name),
                       scene.file ? std::string() : fmt::format("{}", what.seed),
                       scene.file ? std::string() : fmt::format("{}", plan_.count),
                       kStates[static_cast<std::size_t>(state)], figures.empty() ? kNoFigures : figures, cell(reason));
}

Result<Batch::Cast> Batch::load(const BatchRow& row) const {
    const BatchModel& model = plan_.models[row.model];
    const BatchScene& scene = plan_.scenes[row.scene];
    LoadOptions load = settings_.load;
    load.profile = model.profile;
    load.fit.rig = model.rig;
    load.fit.weighByVolume = true;  // of any rig; a humanoid's total is the default one
    Cast cast;
    if (!scene.file) {
        auto asset = loadRagdoll(model.file, load);
        if (!asset) return asset.error();
        cast.asset = std::move(asset).value();
        return cast;
    }
    auto entities = loadScene(*scene.file);
    if (!entities) return entities.error();
    auto loaded = loadCast(entities.value(), model.file, load);
    if (!loaded) return loaded.error();
    cast.entities = std::move(entities).value();
    cast.cast = std::move(loaded).value();
    return cast;
}

Result<const Batch::Cast*> Batch::castOf(const BatchRow& row) {
    // All named scenes take the same.
    const auto isFile = [this](std::uint32_t scene) { return plan_.scenes[scene].file.has_value(); };
    const bool same = castOf_ && castOf_->model == row.model &&
                      (castOf_->scene == row.scene || (!isFile(row.scene) && !isFile(castOf_->scene)));
    if (!same) {
        cast_ = std::make_unique<Result<Cast>>(load(row));
        castOf_ = row;
    }
    if (!*cast_) return cast_->error();
    return &cast_->value();
}

Result<std::unique_ptr<Simulation>> Batch::begin(const BatchRow& row) {
    const Result<const Cast*> found = castOf(row);
    if (!found) return found.error();
    const Cast& cast = *found.value();
    auto scenario = cast.entities ? compileScene(*cast.entities, cast.cast->figures(), cast.cast->assetOfRagdoll)
                                  : makeScenario({plan_.scenes[row.scene].name, plan_.count, row.seed}, *cast.asset);
    if (!scenario) return scenario.error();
    SimulationOptions options = cast.entities ? simulationOptionsOf(*cast.entities) : SimulationOptions{};
    if (plan_.solver) options.world.solver = *plan_.solver;
    options.world.threads = 1;  // rows are what runs side by side
    auto assets = cast.entities ? cast.cast->pointers() : std::vector<const RagdollAsset*>{cast.asset.get()};
    return Simulation::create(std::move(assets), std::move(scenario).value(), options);
}

// Runs the row and writes its clip. The row's figures as cells, or why there are none.
Result<std::string> Batch::fall(std::size_t row) {
    const auto begun = begin(plan_.rows[row]);
    if (!begun) return begun.error();
    Simulation& simulation = *begun.value();
    const float dt = simulation.options().dt;
    const bool bake = plan_.bake && simulation.dollCount() > 0;
    ClipBaker baker(0, 1.0F / dt, "lutka_" + simulation.scenario().name);
    if (bake) baker.sample(simulation);
    const int steps = static_cast<int>(std::lround(plan_.seconds.value_or(simulation.scenario().seconds) / dt));
    for (int step = 0; step < steps; ++step) {
        settings_.afterStep();
        simulation.step();
        if (bake) baker.sample(simulation);
    }
    if (simulation.quality().nonFinite > 0)
        return Error{ErrorCode::internal, "the simulation gave numbers that are not finite", {}, {}};
    if (!bake) return figuresOf(simulation);
    const auto written =
        animation::writeGlb(fileOf("clips", row, ".glb"), simulation.assetOf(0).character, std::span(&baker.clip(), 1),
                            simulation.worldFromModel(0), animation::KeyTolerance{});
    if (!written) return written.error();
    return figuresOf(simulation);
}

Result<RowOutcome> Batch::run(std::size_t row) {
    const Result<std::string> figures = fall(row);
    if (!figures && figures.error().code == ErrorCode::output) return figures.error();
    const RowOutcome outcome{figures ? RowState::done : RowState::failed, figures ? "" : figures.error().message};
    RowJson json;
    json["format"] = "lutka.batch-row";
    json["fingerprint"] = fingerprint(plan_.rows[row]);
    json["done"] = figures.ok();
    if (!figures) json["error"] = figures.error().text();
    json["line"] = lineOf(row, outcome.state, figures ? figures.value() : std::string(), outcome.reason);
    if (auto written = writeFileAtomically(fileOf("rows", row, ".json"), dumpRow(json)); !written)
        return written.error();
    return outcome;
}

// What an earlier run left of the row, if it is of the same inputs.
std::optional<Batch::RowFile> Batch::read(std::size_t row) {
    const auto bytes = readFile(fileOf("rows", row, ".json"), std::size_t{1} << 20U);
    if (!bytes) return std::nullopt;
    const auto json = nlohmann::json::parse(bytes.value(), nullptr, false);
    if (!json.is_object()) return std::nullopt;
    const auto textOf = [&](const char* key) {
        const auto found = json.find(key);
        return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
    };
    const auto done = json.find("done");
    if (done == json.end() || !done->is_boolean() || textOf("line").empty()) return std::nullopt;
    if (textOf("fingerprint") != fingerprint(plan_.rows[row])) return std::nullopt;
    return RowFile{done->get<bool>(), textOf("error"), textOf("line")};
}

RowOutcome Batch::outcome(std::size_t row) {
    const std::optional<RowFile> file = read(row);
    if (!file) return {};
    return {file->done ? RowState::done : RowState::failed, file->error};
}

std::string Batch::summary() {
    std::string csv = kColumns;
    for (std::size_t row = 0; row < plan_.rows.size(); ++row) {
        const std::optional<RowFile> file = read(row);
        csv += file ? file->line : lineOf(row, RowState::missing, {}, {});
    }
    return csv;
}

}  // namespace lutka::scene
