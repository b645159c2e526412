#include "animation/import/bvh/bvh_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <optional>

#include "animation/import/source_limits.hpp"
#include "core/letter_case.hpp"

namespace lutka::animation::rig_import::bvh {
namespace {

constexpr std::size_t kMaxNumbers = 64'000'000;
constexpr std::int64_t kMaxChannels = 6;

bool isBlank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\0';
}

std::optional<Channel> channelNamed(std::string_view word) {
    if (word.size() < 2) return std::nullopt;
    const int axis = lowerCased(word[0]) - 'x';
    if (axis < 0 || axis > 2) return std::nullopt;
    if (sameButCase(word.substr(1), "rotation")) return Channel{axis, true};
    if (sameButCase(word.substr(1), "position")) return Channel{axis, false};
    return std::nullopt;
}

class BvhParser {
  public:
    BvhParser(std::string_view text, std::string location) : text_(text), location_(std::move(location)) {
        if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
    }

    std::optional<Error> parse() {
        if (!sameButCase(word(), "HIERARCHY")) fail("does not begin with HIERARCHY");
        while (!failed_ && readRoot()) {
        }
        if (!failed_) readMotion();
        return failed_;
    }

    BvhDocument document;

  private:
    void fail(const std::string& message) {
        if (failed_) return;
        const auto line = std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n') + 1;
        failed_ = Error{ErrorCode::input, fmt::format("{} (line {})", message, line), location_,
                        "export the motion again as BVH"};
    }

    std::string_view word() {
        while (at_ < text_.size() && isBlank(text_[at_]))
            ++at_;
        const std::size_t start = at_;
        while (at_ < text_.size() && !isBlank(text_[at_]))
            ++at_;
        return text_.substr(start, at_ - start);
    }

    // A name may hold blanks: it is the rest of the line, without a brace at its end.
    std::string restOfLine() {
        const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
        std::string_view line = text_.substr(at_, end - at_);
        if (const std::size_t brace = line.find('{'); brace != std::string_view::npos) line = line.substr(0, brace);
        at_ += line.size();
        const std::size_t first = line.find_first_not_of(" \t");
        const std::size_t last = line.find_last_not_of(" \t");
        return first == std::string_view::npos ? "" : std::string(line.substr(first, last - first + 1));
    }

    // Programs in some countries write a comma for the point.
    static std::optional<double> asNumber(std::string_view token) {
        std::string pointed;
        if (const std::size_t comma = token.find(','); comma != std::string_view::npos) {
            if (token.find('.') != std::string_view::npos) return std::nullopt;
            pointed = token;
            pointed[comma] = '.';
            token = pointed;
        }
        if (token.starts_with('+')) token.remove_prefix(1);
        double value = 0.0;
        const auto [end, code] = std::from_chars(token.data(), token.data() + token.size(), value);
        if (code == std::errc::result_out_of_range) return 0.0;
        if (code != std::errc() || end != token.data() + token.size()) return std::nullopt;
        return std::isfinite(value) ? std::optional(value) : std::nullopt;
    }

    // "nan", "-inf", "1.#QNAN", "-1.#IND": what programs write for a number that they do not have.
    static bool isNoValue(std::string_view token) {
        if (token.starts_with('+') || token.starts_with('-')) token.remove_prefix(1);
        return sameButCase(token.substr(0, 3), "nan") || sameButCase(token.substr(0, 3), "inf") ||
               token.substr(0, 3) == "1.#";
    }

    double number() {
        const std::string_view token = word();
        const std::optional<double> value = asNumber(token);
        if (!value) fail(fmt::format("'{}' is no number", token.substr(0, 20)));
        return value.value_or(0.0);
    }

    void expect(std::string_view wanted) {
        const std::string_view found = word();
        if (!sameButCase(found, wanted)) fail(fmt::format("'{}' stands where {} should", found.substr(0, 20), wanted));
    }

    // One ROOT with all below it; false at MOTION and at the end.
    bool readRoot() {
        const std::string_view kind = word();
        if (kind.empty() || sameButCase(kind, "MOTION")) return false;
        if (!sameButCase(kind, "ROOT") && !sameButCase(kind, "JOINT")) {
            fail(fmt::format("'{}' stands where ROOT or MOTION should", kind.substr(0, 20)));
            return false;
        }
        std::vector<int> open;
        addJoint(restOfLine(), -1);
        open.push_back(static_cast<int>(document.joints.size()) - 1);
        expect("{");
        while (!failed_ && !open.empty())
            readEntry(open);
        return !failed_;
    }

    void addJoint(std::string name, int parent) {
        if (document.joints.size() >= kMaxNodes) return fail(fmt::format("more than {} joints", kMaxNodes));
        Joint joint;
        joint.name = std::move(name);
        joint.parent = parent;
        joint.firstValue = document.channelCount;
        document.joints.push_back(std::move(joint));
    }

    // One line of the innermost open joint.
    void readEntry(std::vector<int>& open) {
        const auto joint = static_cast<std::size_t>(open.back());
        const std::string_view kind = word();
        if (kind == "}") {
            open.pop_back();
        } else if (sameButCase(kind, "OFFSET")) {
            for (int axis = 0; axis < 3; ++axis)
                document.joints[joint].offset[axis] = number();
        } else if (sameButCase(kind, "CHANNELS")) {
            readChannels(document.joints[joint]);
        } else if (sameButCase(kind, "JOINT") || sameButCase(kind, "End")) {
            std::string name = restOfLine();
            if (sameButCase(kind, "End")) name = "EndSite_" + document.joints[joint].name;
            addJoint(std::move(name), open.back());
            if (static_cast<int>(open.size()) >= kMaxDepth)
                return fail(fmt::format("joints nested deeper than {}", kMaxDepth));
            open.push_back(static_cast<int>(document.joints.size()) - 1);
            expect("{");
        } else {
            fail(kind.empty() ? "the hierarchy breaks off"
                              : fmt::format("'{}' stands where a joint's data should", kind.substr(0, 20)));
        }
    }

    void readChannels(Joint& joint) {
        const double count = number();
        if (!(count >= 0.0 && count <= static_cast<double>(kMaxChannels)) || !joint.channels.empty())
            return fail(fmt::format("joint '{}' has a wrong number of channels", joint.name));
        joint.firstValue = document.channelCount;
        for (int i = 0; i < static_cast<int>(count) && !failed_; ++i) {
            const std::string_view name = word();
            const std::optional<Channel> channel = channelNamed(name);
            if (!channel) return fail(fmt::format("'{}' is no channel", name.substr(0, 20)));
            joint.channels.push_back(*channel);
        }
        document.channelCount += joint.channels.size();
    }

    // "Frames: 12" and "Frame Time: 0.03", in which a blank may stand before the colon. Either may be missing.
    void readMotion() {
        std::optional<double> stated;
        bool timed = false;
        std::string_view token = word();
        while (!failed_ && !token.empty() && !isNumeral(token)) {
            std::string label(token);
            token = word();
            while (!token.empty() && !isNumeral(token)) {
                label += token;
                token = word();
            }
            if (token.empty()) break;
            const double value = asNumber(token).value_or(0.0);
            const bool frames = sameButCase(std::string_view(label).substr(0, 6), "Frames");
            const bool time = sameButCase(std::string_view(label).substr(0, 9), "FrameTime");
            if (!frames && !time) return fail(fmt::format("'{}' stands where Frames or Frame Time should", label));
            if (frames) stated = value;
            if (time) setFrameTime(value);
            timed = timed || time;
            token = word();
        }
        if (failed_ || document.channelCount == 0) return;
        if (!timed && !token.empty()) {
            document.warnings.push_back(
                fmt::format("does not say how long a frame takes: took 1/{:.0f} s", 1.0 / document.frameSeconds));
        }
        readFrames(token, stated);
    }

    static bool isNumeral(std::string_view token) { return asNumber(token).has_value() || isNoValue(token); }

    void setFrameTime(double seconds) {
        if (seconds > 0.0 && seconds < 60.0) {
            document.frameSeconds = seconds;
            return;
        }
        document.warnings.push_back(
            fmt::format("says that a frame takes {} s: took 1/{:.0f} s", seconds, 1.0 / document.frameSeconds));
    }

    void readFrames(std::string_view token, std::optional<double> stated) {
        std::size_t without = 0;
        for (; !token.empty(); token = word()) {
            const std::optional<double> value = asNumber(token);
            if (!value && !isNoValue(token)) {
                const auto end = text_.begin() + static_cast<std::ptrdiff_t>(at_);
                document.warnings.push_back(fmt::format("the motion was read up to line {}, where '{}' is no number",
                                                        std::count(text_.begin(), end, '\n') + 1, token.substr(0, 20)));
                break;
            }
            if (document.frames.size() >= kMaxNumbers)
                return fail(fmt::format("more than {} numbers of motion", kMaxNumbers));
            without += value ? 0 : 1;
            // Such a channel stays where it was.
            const std::size_t count = document.frames.size();
            const float before = count >= document.channelCount ? document.frames[count - document.channelCount] : 0.0F;
            document.frames.push_back(value ? static_cast<float>(*value) : before);
        }
        const std::size_t whole = document.frames.size() / document.channelCount;
        const std::size_t rest = document.frames.size() - whole * document.channelCount;
        document.frames.resize(whole * document.channelCount);
        if (without > 0) {
            document.warnings.push_back(
                fmt::format("{} of the motion's numbers are none (nan) and keep the frame before", without));
        }
        if (stated && static_cast<double>(whole) != *stated) {
            document.warnings.push_back(
                fmt::format("the file says that it has {:.0f} frames, but {} are there", *stated, whole));
        } else if (rest > 0) {
            document.warnings.push_back(
                fmt::format("the motion has {} numbers beyond its {} frames, which were left out", rest, whole));
        }
    }

    std::string_view text_;
    std::string location_;
    std::size_t at_ = 0;
    std::optional<Error> failed_;
};

}  // namespace

glm::dmat4 BvhDocument::parentFromJoint(std::size_t joint, std::size_t frame) const {
    const Joint& source = joints[joint];
    glm::dvec3 place = source.offset;
    glm::dmat4 turn(1.0);
    for (std::size_t i = 0; i < source.channels.size(); ++i) {
        const double value = frames[frame * channelCount + source.firstValue + i];
        glm::dvec3 axis(0);
        axis[source.channels[i].axis] = 1.0;
        if (source.channels[i].turns)
            turn = glm::rotate(turn, glm::radians(value), axis);
        else
            place[source.channels[i].axis] = value;
    }
    return glm::translate(glm::dmat4(1.0), place) * turn;
}

bool isBvh(std::string_view beginning) {
    if (beginning.starts_with("\xEF\xBB\xBF")) beginning.remove_prefix(3);
    const std::size_t start = beginning.find_first_not_of(" \t\r\n");
    return start != std::string_view::npos && sameButCase(beginning.substr(start, 9), "HIERARCHY");
}

Result<BvhDocument> parseBvh(std::string_view text, const std::string& location) {
    BvhParser parser(text, location);
    if (std::optional<Error> failed = parser.parse()) return *std::move(failed);
    if (parser.document.joints.empty()) return Error{ErrorCode::input, "has no joints", location, ""};
    return std::move(parser.document);
}

}  // namespace lutka::animation::rig_import::bvh
