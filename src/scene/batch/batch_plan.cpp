#include "scene/batch/batch_plan.hpp"

#include <fmt/format.h>

#include <charconv>

#include "core/files.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_text.hpp"
#include "scene/asset/load_words.hpp"
#include "scene/description/scenario.hpp"
#include "scene/description/scene_file.hpp"

namespace lutka::scene {
namespace {

constexpr int kMostItems = 100'000;
constexpr long long kLargestBatchSeed = 999'999'999'999'999'999;  // as on the command line

void readModel(const JsonCursor& item, const std::filesystem::path& folder, const nlohmann::json& value,
               BatchModel& model) {
    if (value.is_string()) {
        model.name = item.text();
    } else {
        item.expectObject({"model"}, {"profile", "rig"});
        if (item.has("model")) model.name = item["model"].text();
        if (item.has("profile")) {
            model.profileName = item["profile"].text();
            model.profile = folder / model.profileName;
        }
        if (item.has("rig") && item["rig"].oneOf({"humanoid", "any"}) == 1) model.rig = physics::RigKind::any;
    }
    if (model.name.empty()) item.report("expected the path of a model");
    model.file = folder / model.name;
}

void readScene(const JsonCursor& item, const std::filesystem::path& folder, BatchScene& scene) {
    scene.name = item.text();
    if (!item.readable()) return;
    if (isSceneFile(scene.name)) {
        scene.file = folder / scene.name;
        return;
    }
    std::string known;
    for (const ScenarioInfo& info : scenarioRegistry()) {
        if (info.name == scene.name) return;
        known += fmt::format("{}, ", info.name);
    }
    item.report("expected one of " + known + "or a file *.scene.json");
}

// [0, 1, 2] or {"from": 0, "count": 100}.
void readSeeds(const JsonCursor& seeds, const nlohmann::json& value, std::vector<std::uint64_t>& list) {
    list.clear();
    if (value.is_object()) {
        seeds.expectObject({"from", "count"});
        const auto from = seeds["from"].wholeNumber(0, kLargestBatchSeed - kMostItems);
        const auto count = seeds["count"].wholeNumber(1, kMostItems);
        for (long long i = 0; from && count && i < *count; ++i)
            list.push_back(static_cast<std::uint64_t>(*from + i));
        return;
    }
    if (!seeds.expectArray(1, kMostItems)) return;
    for (std::size_t i = 0; i < seeds.size(); ++i)
        if (const auto seed = seeds[i].wholeNumber(0, kLargestBatchSeed))
            list.push_back(static_cast<std::uint64_t>(*seed));
}

void readOptions(const JsonCursor& root, BatchPlan& plan) {
    if (root.has("count")) plan.count = static_cast<int>(root["count"].wholeNumber(1, 10'000).value_or(1));
    if (root.has("seconds")) plan.seconds = root["seconds"].number(0.0F, 3600.0F);
    if (root.has("solver")) plan.solver = physics::solverNamed(root["solver"].text());
    if (root.has("solver") && !plan.solver) root["solver"].report("expected stock, bullet or crowd");
    if (root.has("bake")) plan.bake = root["bake"].truth().value_or(false);
}

// A scene file is one row a model, whatever the seeds.
void readRows(const JsonCursor& root, BatchPlan& plan) {
    std::size_t scenesRows = 0;
    for (const BatchScene& scene : plan.scenes)
        scenesRows += scene.file ? 1 : plan.seeds.size();
    if (scenesRows * plan.models.size() > BatchPlan::kMostRows) {
        root.report(fmt::format("expected at most {} rows, models × scenes × seeds are {}", BatchPlan::kMostRows,
                                scenesRows * plan.models.size()));
        return;
    }
    plan.rows.reserve(scenesRows * plan.models.size());
    for (std::uint32_t model = 0; model < plan.models.size(); ++model) {
        for (std::uint32_t scene = 0; scene < plan.scenes.size(); ++scene) {
            if (plan.scenes[scene].file) {
                plan.rows.push_back({model, scene, 0});
                continue;
            }
            for (const std::uint64_t seed : plan.seeds)
                plan.rows.push_back({model, scene, seed});
        }
    }
}

constexpr JsonDocumentKind kBatchDocument{"batch", "docs/howto.md describes the list"};

}  // namespace

Result<BatchPlan> batchFromJson(std::string_view text, std::string_view source, const std::filesystem::path& folder) {
    std::vector<std::string> duplicates;
    const Result<nlohmann::json> parsed = parseJson(text, source, duplicates);
    if (!parsed) return parsed.error();
    const nlohmann::json& document = parsed.value();
    std::vector<std::string> problems = checkFormat(document, "lutka.batch", BatchPlan::kVersion);
    if (!problems.empty()) return refusedDocument(kBatchDocument, source, problems);
    problems = duplicates;
    const JsonCursor root(document, problems);
    root.expectObject({"format", "version", "models", "scenes"},
                      {"seeds", "count", "seconds", "solver", "bake", "description"});
    BatchPlan plan;
    if (root.has("description")) static_cast<void>(root["description"].text());
    if (root.has("models") && root["models"].expectArray(1, kMostItems)) {
        plan.models.resize(root["models"].size());
        for (std::size_t i = 0; i < plan.models.size(); ++i)
            readModel(root["models"][i], folder, document["models"][i], plan.models[i]);
    }
    if (root.has("scenes") && root["scenes"].expectArray(1, kMostItems)) {
        plan.scenes.resize(root["scenes"].size());
        for (std::size_t i = 0; i < plan.scenes.size(); ++i)
            readScene(root["scenes"][i], folder, plan.scenes[i]);
    }
    if (root.has("seeds")) readSeeds(root["seeds"], document["seeds"], plan.seeds);
    readOptions(root, plan);
    if (problems.empty()) readRows(root, plan);
    if (!problems.empty()) return refusedDocument(kBatchDocument, source, problems);
    return plan;
}

Result<BatchPlan> loadBatch(const std::filesystem::path& file) {
    constexpr std::size_t mostBytes = std::size_t{64} << 20U;
    const Result<std::vector<unsigned char>> bytes = readFile(file, mostBytes);
    if (!bytes) return bytes.error();
    const auto* text = reinterpret_cast<const char*>(bytes.value().data());
    return batchFromJson({text, bytes.value().size()}, file.string(), file.parent_path());
}

Result<BatchShard> parseBatchShard(std::string_view text) {
    constexpr int kMostShards = 100'000;
    BatchShard shard;
    const char* end = text.data() + text.size();
    const auto number = std::from_chars(text.data(), end, shard.number);
    const bool slash = number.ec == std::errc() && number.ptr != end && *number.ptr == '/';
    const auto of = slash ? std::from_chars(number.ptr + 1, end, shard.of) : number;
    if (slash && of.ec == std::errc() && of.ptr == end && shard.of >= 1 && shard.of <= kMostShards &&
        shard.number >= 1 && shard.number <= shard.of)
        return shard;
    return Error{ErrorCode::usage, fmt::format("'{}' is no shard", text), "--shard",
                 "give its number and how many there are, as 3/8"};
}

}  // namespace lutka::scene
