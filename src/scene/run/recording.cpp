#include "scene/run/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/files.hpp"
#include "core/input_file.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_text.hpp"

namespace lutka::scene {
namespace {

constexpr std::size_t kFloats = 7;
constexpr std::size_t kBodyBytes = kFloats * sizeof(float);
constexpr std::size_t kMostBytes = std::size_t{4} << 30U;
constexpr std::size_t kMostHeaderBytes = std::size_t{4} << 20U;
constexpr std::size_t kMostNameBytes = std::size_t{1} << 16U;
constexpr std::size_t kBodiesAtOnce = 40000;  // while a file is read: a megabyte
constexpr const char* kFormat = "lutka.recording";
constexpr int kMostDolls = 100000;
constexpr int kMostBodies = 1000;
constexpr int kMostFigures = 10000;
constexpr long long kMostSteps = 100'000'000;
constexpr float kLeastStep = 1e-6F;
constexpr float kMostOffUnit = 1e-2F;  // of a rotation's squared length

static_assert(std::endian::native == std::endian::little, "recordings are little-endian; a big-endian host must swap");

Error broken(const std::filesystem::path& file, std::string message) {
    return {ErrorCode::input, std::move(message), file.string(), "make it anew with `lutka simulate --record`"};
}

// What is wrong with the header, each with its JSON pointer; the parts that are right are in `recording`.
void readHeader(const JsonCursor& at, int version, Recording& recording) {
    const char* bodies = version == 1 ? "bodiesPerDoll" : "bodiesOfDoll";
    at.expectObject({"format", "version", "model", "scene", "dt", "dolls", bodies, "props"}, {"steps", "figure"});
    recording.model = at["model"].text();
    recording.scene = at["scene"].text();
    if (at.has("figure")) recording.figure = static_cast<int>(at["figure"].wholeNumber(1, kMostFigures).value_or(0));
    recording.dt = at["dt"].number(kLeastStep, 1.0F);
    recording.dolls = static_cast<int>(at["dolls"].wholeNumber(1, kMostDolls).value_or(1));
    if (version == 1) {
        recording.bodiesPerDoll = static_cast<int>(at[bodies].wholeNumber(1, kMostBodies).value_or(1));
    } else if (at[bodies].expectArray(recording.dolls, recording.dolls)) {
        for (std::size_t doll = 0; doll < at[bodies].size(); ++doll) {
            const auto count = at[bodies][doll].wholeNumber(1, kMostBodies);
            recording.bodiesOfDoll.push_back(static_cast<int>(count.value_or(1)));
        }
        recording.bodiesPerDoll = recording.bodiesOfDoll.front();
    }
    recording.props = static_cast<int>(at["props"].wholeNumber(0, kMostDolls).value_or(0));
}

/// The first line of the file.
struct Header {
    Recording recording;                 ///< Without frames.
    std::optional<long long> stepCount;  ///< How many frames should follow.
    std::size_t bytes = 0;               ///< Of the line, with its end.
};

// `start` holds the file's first bytes, the line among them.
Result<Header> readHeader(const std::filesystem::path& file, std::span<const unsigned char> start) {
    const auto newline = std::find(start.begin(), start.end(), static_cast<unsigned char>('\n'));
    if (newline == start.end()) return broken(file, "is not a recording of ours");
    const std::string line(start.begin(), newline);
    std::vector<std::string> problems;
    const Result<nlohmann::json> parsed = parseJson(line, file.string(), problems);
    if (!parsed) return broken(file, "is not a recording of ours");
    const JsonCursor at(parsed.value(), problems);
    if (!at.has("format")) return broken(file, "is not a recording of ours");
    Header header;
    header.bytes = line.size() + 1;
    at["format"].oneOf({kFormat});
    const auto version = at["version"].wholeNumber(1, Recording::kVersion);
    if (problems.empty() && version) readHeader(at, static_cast<int>(*version), header.recording);
    if (problems.empty() && at.has("steps")) header.stepCount = at["steps"].wholeNumber(1, kMostSteps);
    if (problems.empty()) return header;
    return broken(file, fmt::format("has a damaged first line: {}", fmt::join(problems, "; ")));
}

// Whether a file of that size holds the frames that its first line promises.
Result<void> checkSize(const std::filesystem::path& file, const Header& header, std::size_t fileBytes) {
    const std::size_t payload = fileBytes - header.bytes;
    const std::size_t frameBytes = header.recording.frameSize() * kBodyBytes;
    if (payload == 0 || payload % frameBytes != 0) return broken(file, "is cut short");
    const auto steps = static_cast<long long>(payload / frameBytes);
    if (header.stepCount && *header.stepCount != steps)
        return broken(file, fmt::format("is cut short: {} of its {} steps are there", steps, *header.stepCount));
    return {};
}

// `bytes` are those of whole bodies.
Result<void> appendFrames(const std::filesystem::path& file, std::span<const unsigned char> bytes,
                          std::vector<RigidTransform>& frames) {
    for (; !bytes.empty(); bytes = bytes.subspan(kBodyBytes)) {
        float v[kFloats];
        std::memcpy(v, bytes.data(), sizeof v);
        const RigidTransform t = {quat(v[3], v[0], v[1], v[2]), {v[4], v[5], v[6]}};
        if (!isFinite(t)) return broken(file, "holds a frame that is not finite");
        if (std::abs(glm::dot(t.rotation, t.rotation) - 1.0F) > kMostOffUnit)
            return broken(file, "holds a rotation that is none");
        if (!isPlace(t.translation))
            return broken(file, fmt::format("holds a body more than {} m away", kFarthestPlaceM));
        frames.push_back(t);
    }
    return {};
}

}  // namespace

Recording beginRecording(const Simulation& simulation) {
    Recording recording;
    recording.model = simulation.asset().character.name;
    recording.scene = simulation.scenario().name;
    const animation::Character& character = simulation.asset().character;
    if (character.figures.size() > 1) recording.figure = character.figure + 1;
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
    header["model"] = recording.model.substr(0, kMostNameBytes);
    header["scene"] = recording.scene.substr(0, kMostNameBytes);
    if (recording.figure > 0) header["figure"] = recording.figure;
    header["dt"] = recording.dt;
    header["dolls"] = recording.dolls;
    if (recording.bodiesOfDoll.empty()) {
        header["bodiesPerDoll"] = recording.bodiesPerDoll;
    } else {
        header["bodiesOfDoll"] = recording.bodiesOfDoll;
    }
    header["props"] = recording.props;
    header["steps"] = recording.steps();
    std::string bytes = header.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    const std::size_t start = bytes.size();
    bytes.resize(start + recording.frames.size() * kBodyBytes);
    char* out = bytes.data() + start;
    for (const RigidTransform& t : recording.frames) {
        const float values[kFloats] = {t.rotation.x,    t.rotation.y,    t.rotation.z,   t.rotation.w,
                                       t.translation.x, t.translation.y, t.translation.z};
        std::memcpy(out, values, sizeof values);
        out += sizeof values;
    }
    return writeFileAtomically(file, bytes);
}

Result<Recording> recordingFromBytes(std::span<const unsigned char> data, const std::filesystem::path& file) {
    Result<Header> header = readHeader(file, data.first(std::min(data.size(), kMostHeaderBytes)));
    if (!header) return header.error();
    if (const auto fits = checkSize(file, header.value(), data.size()); !fits) return fits.error();
    Recording recording = std::move(header.value().recording);
    const auto sound = appendFrames(file, data.subspan(header.value().bytes), recording.frames);
    if (!sound) return sound.error();
    return recording;
}

Result<Recording> loadRecording(const std::filesystem::path& file) {
    const Result<InputFile> in = InputFile::open(file);
    if (!in) return in.error();
    const std::size_t size = in.value().size();
    std::vector<unsigned char> piece(std::min(size, kMostHeaderBytes));
    if (const auto there = in.value().read(0, piece); !there) return there.error();
    Result<Header> header = readHeader(file, piece);
    if (!header) return header.error();
    if (size > kMostBytes) return broken(file, fmt::format("is larger than {} bytes", kMostBytes));
    if (const auto fits = checkSize(file, header.value(), size); !fits) return fits.error();
    Recording recording = std::move(header.value().recording);
    for (std::size_t at = header.value().bytes; at < size; at += piece.size()) {
        piece.resize(std::min(size - at, kBodiesAtOnce * kBodyBytes));
        if (const auto there = in.value().read(at, piece); !there) return there.error();
        if (const auto sound = appendFrames(file, piece, recording.frames); !sound) return sound.error();
    }
    return recording;
}

}  // namespace lutka::scene
