#include "scene/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/files.hpp"

namespace lutka::scene {
namespace {

constexpr std::size_t kFloats = 7;
constexpr std::string_view kFormat = "lutka.recording";
constexpr int kMostDolls = 100000;
constexpr int kMostBodies = 1000;

static_assert(std::endian::native == std::endian::little, "recordings are little-endian; a big-endian host must swap");

Error broken(const std::filesystem::path& file, std::string message) {
    return {ErrorCode::input, std::move(message), file.string(), "make it anew with `lutka simulate --record`"};
}

bool inRange(int value, int low, int high) {
    return value >= low && value <= high;
}

Result<Recording> readHeader(const std::filesystem::path& file, std::string_view line) {
    const auto json = nlohmann::json::parse(line, nullptr, false);
    if (!json.is_object() || json.value("format", "") != kFormat) return broken(file, "is not a recording of ours");
    Recording recording;
    try {
        const int version = json.at("version").get<int>();
        if (!inRange(version, 1, Recording::kVersion)) {
            return broken(file,
                          fmt::format("has version {}; this program reads 1 to {}", version, Recording::kVersion));
        }
        recording.model = json.at("model").get<std::string>();
        recording.scene = json.at("scene").get<std::string>();
        recording.dt = json.at("dt").get<float>();
        recording.dolls = json.at("dolls").get<int>();
        if (version == 1) {
            recording.bodiesPerDoll = json.at("bodiesPerDoll").get<int>();
        } else {
            recording.bodiesOfDoll = json.at("bodiesOfDoll").get<std::vector<int>>();
            recording.bodiesPerDoll = recording.bodiesOfDoll.empty() ? 0 : recording.bodiesOfDoll.front();
        }
        recording.props = json.at("props").get<int>();
    } catch (const nlohmann::json::exception& wrong) {
        return broken(file, fmt::format("has a damaged first line: {}", wrong.what()));
    }
    const bool sane = recording.dt > 0.0F && recording.dt < 1.0F && inRange(recording.dolls, 1, kMostDolls) &&
                      inRange(recording.bodiesPerDoll, 1, kMostBodies) && inRange(recording.props, 0, kMostDolls);
    const bool mixedSane =
        recording.bodiesOfDoll.empty() || (static_cast<int>(recording.bodiesOfDoll.size()) == recording.dolls &&
                                           std::all_of(recording.bodiesOfDoll.begin(), recording.bodiesOfDoll.end(),
                                                       [](int count) { return inRange(count, 1, kMostBodies); }));
    if (!sane || !mixedSane) return broken(file, "has counts or a step that are out of range");
    return recording;
}

}  // namespace

Recording beginRecording(const Simulation& simulation) {
    Recording recording;
    recording.model = simulation.asset().character.name;
    recording.scene = simulation.scenario().name;
    recording.dt = simulation.options().dt;
    recording.dolls = simulation.dollCount();
    const auto bodiesOf = [&](int doll) { return static_cast<int>(simulation.assetOf(doll).profile.bodies.size()); };
    recording.bodiesPerDoll = recording.dolls > 0 ? bodiesOf(0) : 0;
    bool mixed = false;
    for (int doll = 0; doll < recording.dolls; ++doll) {
        recording.bodiesOfDoll.push_back(bodiesOf(doll));
        mixed = mixed || bodiesOf(doll) != recording.bodiesPerDoll;
    }
    if (!mixed) recording.bodiesOfDoll.clear();
    recording.props = static_cast<int>(simulation.world().props().size());
    return recording;
}

void record(Simulation& simulation, Recording& recording) {
    for (int doll = 0; doll < recording.dolls; ++doll) {
        const auto bodies = simulation.worldFromBody(doll);
        recording.frames.insert(recording.frames.end(), bodies.begin(), bodies.end());
    }
    for (int prop = 0; prop < recording.props; ++prop)
        recording.frames.push_back(simulation.worldFromProp(prop));
}

Result<void> saveRecording(const std::filesystem::path& file, const Recording& recording) {
    nlohmann::ordered_json header;
    header["format"] = kFormat;
    header["version"] = recording.bodiesOfDoll.empty() ? 1 : Recording::kVersion;
    header["model"] = recording.model;
    header["scene"] = recording.scene;
    header["dt"] = recording.dt;
    header["dolls"] = recording.dolls;
    if (recording.bodiesOfDoll.empty()) {
        header["bodiesPerDoll"] = recording.bodiesPerDoll;
    } else {
        header["bodiesOfDoll"] = recording.bodiesOfDoll;
    }
    header["props"] = recording.props;
    header["steps"] = recording.steps();
    std::string bytes = header.dump() + "\n";
    const std::size_t start = bytes.size();
    bytes.resize(start + recording.frames.size() * kFloats * sizeof(float));
    char* out = bytes.data() + start;
    for (const RigidTransform& t : recording.frames) {
        const float values[kFloats] = {t.rotation.x,    t.rotation.y,    t.rotation.z,   t.rotation.w,
                                       t.translation.x, t.translation.y, t.translation.z};
        std::memcpy(out, values, sizeof values);
        out += sizeof values;
    }
    return writeFileAtomically(file, bytes);
}

Result<Recording> loadRecording(const std::filesystem::path& file) {
    const auto bytes = readFile(file);
    if (!bytes) return bytes.error();
    const std::vector<unsigned char>& data = bytes.value();
    const auto newline = std::find(data.begin(), data.end(), static_cast<unsigned char>('\n'));
    if (newline == data.end()) return broken(file, "is not a recording of ours");
    const std::string line(data.begin(), newline);
    auto recording = readHeader(file, line);
    if (!recording) return recording;
    const std::size_t start = line.size() + 1;
    const std::size_t frameBytes = recording.value().frameSize() * kFloats * sizeof(float);
    const std::size_t payload = data.size() - start;
    if (payload == 0 || payload % frameBytes != 0) return broken(file, "is cut short");
    recording.value().frames.resize(payload / (kFloats * sizeof(float)));
    const unsigned char* in = data.data() + start;
    for (RigidTransform& t : recording.value().frames) {
        float v[kFloats];
        std::memcpy(v, in, sizeof v);
        in += sizeof v;
        t = {quat(v[3], v[0], v[1], v[2]), {v[4], v[5], v[6]}};
        if (!isFinite(t)) return broken(file, "holds a frame that is not finite");
    }
    return recording;
}

}  // namespace lutka::scene
