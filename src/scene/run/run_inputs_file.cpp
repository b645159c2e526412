#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "core/files.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_text.hpp"
#include "scene/run/run_inputs.hpp"

namespace lutka::scene {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kInputsFormat = "lutka.inputs";
constexpr std::string_view kInputsEnding = ".inputs.json";
constexpr int kMostInputSteps = 100'000'000;
constexpr int kMostEntries = 1'000'000;  // of hits, pulls and checks, each
constexpr int kMostDollsHere = 100'000;
constexpr int kMostBodiesHere = 1000;
constexpr float kFarthest = 1e6F;   // metres
constexpr float kStrongest = 1e9F;  // N s and N
constexpr std::size_t kHashDigits = 8;

std::string joinedHashes(const std::vector<std::uint32_t>& bodies) {
    std::string text;
    text.reserve(bodies.size() * kHashDigits);
    for (const std::uint32_t hash : bodies)
        fmt::format_to(std::back_inserter(text), "{:08x}", hash);
    return text;
}

template <class Number>
bool fromHex(std::string_view text, Number& number) {
    const auto [stopped, failed] = std::from_chars(text.data(), text.data() + text.size(), number, 16);
    return failed == std::errc() && stopped == text.data() + text.size();
}

std::vector<std::uint32_t> readHashes(const JsonCursor& at) {
    const std::string text = at.text();
    std::vector<std::uint32_t> bodies(text.size() / kHashDigits);
    bool good = text.size() % kHashDigits == 0;
    for (std::size_t i = 0; good && i < bodies.size(); ++i)
        good = fromHex(std::string_view(text).substr(i * kHashDigits, kHashDigits), bodies[i]);
    if (!good && at.readable()) at.report("expected hashes of eight hexadecimal digits each");
    return bodies;
}

vec3 readVectorOf(const JsonCursor& at, float most) {
    const std::vector<float> v = at.numbers(3, -most, most);
    return {v[0], v[1], v[2]};
}

int readCount(const JsonCursor& at, int most) {
    return static_cast<int>(at.wholeNumber(0, most).value_or(0));
}

TimedHit readTimedHit(const JsonCursor& at) {
    at.expectObject({"step", "doll", "body", "impulse", "at"});
    return {readCount(at["step"], kMostInputSteps), readCount(at["doll"], kMostDollsHere),
            readCount(at["body"], kMostBodiesHere), readVectorOf(at["impulse"], kStrongest),
            readVectorOf(at["at"], kFarthest)};
}

TimedPull readTimedPull(const JsonCursor& at) {
    at.expectObject({"from", "until", "doll", "body", "at", "to", "maxForceN"});
    return {readCount(at["from"], kMostInputSteps),  readCount(at["until"], kMostInputSteps),
            readCount(at["doll"], kMostDollsHere),   readCount(at["body"], kMostBodiesHere),
            readVectorOf(at["at"], kFarthest),       readVectorOf(at["to"], kFarthest),
            at["maxForceN"].number(0.0F, kStrongest)};
}

RunInputs::Check readCheck(const JsonCursor& at) {
    at.expectObject({"step", "bodies"});
    return {readCount(at["step"], kMostInputSteps), readHashes(at["bodies"])};
}

template <class Entry>
std::vector<Entry> readEntries(const JsonCursor& at, Entry (*read)(const JsonCursor&)) {
    std::vector<Entry> entries;
    if (!at.expectArray(0, kMostEntries)) return entries;
    for (std::size_t i = 0; i < at.size(); ++i)
        entries.push_back(read(at[i]));
    return entries;
}

RunInputs readInputs(const nlohmann::json& document, std::vector<std::string>& problems) {
    const JsonCursor at(document, problems);
    at.expectObject(
        {"format", "version", "program", "model", "profile", "settings", "hits", "pulls", "steps", "checks"});
    RunInputs inputs;
    inputs.program = at["program"].text();
    inputs.model = at["model"].text();
    if (!fromHex(at["profile"].text(), inputs.profile)) at["profile"].report("expected sixteen hexadecimal digits");
    if (const auto settings = document.find("settings"); settings != document.end() && settings->is_object()) {
        for (const auto& [key, value] : settings->items())
            inputs.settings[key] = at["settings"][key.c_str()].text();
    } else {
        at["settings"].report("expected an object of texts");
    }
    inputs.hits = readEntries(at["hits"], &readTimedHit);
    inputs.pulls = readEntries(at["pulls"], &readTimedPull);
    inputs.steps = readCount(at["steps"], kMostInputSteps);
    inputs.checks = readEntries(at["checks"], &readCheck);
    return inputs;
}

}  // namespace

bool isInputsFile(const std::filesystem::path& file) {
    return file.filename().string().ends_with(kInputsEnding);
}

std::string inputsToJson(const RunInputs& inputs) {
    Json json = {{"format", kInputsFormat},
                 {"version", RunInputs::kVersion},
                 {"program", inputs.program},
                 {"model", inputs.model},
                 {"profile", fmt::format("{:016x}", inputs.profile)},
                 {"settings", Json::object()},
                 {"hits", Json::array()},
                 {"pulls", Json::array()},
                 {"steps", inputs.steps},
                 {"checks", Json::array()}};
    for (const auto& [key, value] : inputs.settings)
        json["settings"][key] = value;
    for (const TimedHit& hit : inputs.hits)
        json["hits"].push_back({{"step", hit.step},
                                {"doll", hit.doll},
                                {"body", hit.body},
                                {"impulse", jsonVector(hit.impulse)},
                                {"at", jsonVector(hit.bodyPoint)}});
    for (const TimedPull& pull : inputs.pulls)
        json["pulls"].push_back({{"from", pull.from},
                                 {"until", pull.until},
                                 {"doll", pull.doll},
                                 {"body", pull.body},
                                 {"at", jsonVector(pull.bodyPoint)},
                                 {"to", jsonVector(pull.worldTarget)},
                                 {"maxForceN", jsonNumber(pull.maxForceN)}});
    for (const RunInputs::Check& check : inputs.checks)
        json["checks"].push_back({{"step", check.step}, {"bodies", joinedHashes(check.bodies)}});
    return jsonText(json);
}

Result<void> saveInputs(const std::filesystem::path& file, const RunInputs& inputs) {
    return writeFileAtomically(file, inputsToJson(inputs));
}

Result<RunInputs> inputsFromJson(std::string_view text, std::string_view source) {
    std::vector<std::string> problems;
    const Result<nlohmann::json> parsed = parseJson(text, source, problems);
    if (!parsed) return parsed.error();
    if (problems.empty()) problems = checkFormat(parsed.value(), kInputsFormat, RunInputs::kVersion);
    RunInputs inputs;
    if (problems.empty()) inputs = readInputs(parsed.value(), problems);
    if (problems.empty()) return inputs;
    return Error{ErrorCode::input, fmt::format("{}", fmt::join(problems, "; ")), std::string(source),
                 "make it anew with `lutka simulate --record`"};
}

Result<RunInputs> loadInputs(const std::filesystem::path& file) {
    constexpr std::size_t mostBytes = std::size_t{64} << 20U;  // as a scene, which is most of it
    const auto bytes = readFile(file, mostBytes);
    if (!bytes) return bytes.error();
    const auto* text = reinterpret_cast<const char*>(bytes.value().data());
    return inputsFromJson({text, bytes.value().size()}, file.string());
}

}  // namespace lutka::scene
