#include "animation/humanoid/name_evidence.hpp"

#include <algorithm>
#include <array>
#include <bitset>
#include <initializer_list>
#include <string>

#include "animation/humanoid/name_lexicon.hpp"
#include "animation/humanoid/name_tokens.hpp"
#include "core/letter_case.hpp"

namespace lutka::animation {
namespace {

constexpr float kClear = 4.5F;        // the word has one meaning in all conventions
constexpr float kBareLimb = 2.3F;     // "arm", "leg": mostly the upper arm, the thigh or the shin
constexpr float kOther = -2.5F;       // the name speaks of another part
constexpr float kRootIsNone = -1.0F;  // "root": what hangs on it tells what it is
constexpr float kNoRole = -4.0F;      // fingers, face, props, controls
constexpr float kTwistLoss = -4.5F;   // a twist joint is still nearest to its own part

struct PartScore {
    Part part;
    float score;
};

class Concepts {
  public:
    explicit Concepts(const std::vector<std::string>& words) {
        for (const std::string& word : words) {
            const auto meaning = conceptOf(word);
            if (meaning && *meaning != Concept::noise) bits_.set(static_cast<std::size_t>(*meaning));
        }
    }
    [[nodiscard]] bool has(Concept meaning) const { return bits_.test(static_cast<std::size_t>(meaning)); }
    [[nodiscard]] bool hasAny(std::initializer_list<Concept> meanings) const {
        return std::any_of(meanings.begin(), meanings.end(), [this](Concept m) { return has(m); });
    }
    [[nodiscard]] bool empty() const { return bits_.none(); }

  private:
    std::bitset<64> bits_;
};

void set(PartScores& scores, std::initializer_list<PartScore> values) {
    scores.values.fill(kOther);
    for (const PartScore& value : values)
        scores[value.part] = value.score;
}

bool scoreArm(const Concepts& c, PartScores& scores) {
    const bool low = c.has(Concept::lower);
    if (c.has(Concept::forearm) || (c.has(Concept::arm) && low)) {
        set(scores, {{Part::lowerArm, kClear}});
    } else if (c.has(Concept::elbow)) {
        set(scores, {{Part::lowerArm, 4.0F}});
    } else if (c.has(Concept::upperArm) || (c.has(Concept::arm) && c.has(Concept::upper))) {
        set(scores, {{Part::upperArm, kClear}});
    } else if (c.has(Concept::wrist)) {
        set(scores, {{Part::hand, kClear}, {Part::lowerArm, -0.5F}});
    } else if (c.has(Concept::hand)) {
        set(scores, {{Part::hand, kClear}});
    } else if (c.has(Concept::clavicle)) {
        set(scores, {{Part::clavicle, kClear}});
    } else if (c.has(Concept::shoulder)) {
        set(scores, {{Part::clavicle, 2.2F}, {Part::upperArm, 2.0F}});
    } else if (c.has(Concept::arm)) {
        set(scores, {{Part::upperArm, kBareLimb}, {Part::clavicle, 0.8F}, {Part::lowerArm, 0.8F}, {Part::hand, -1.0F}});
    } else {
        return false;
    }
    return true;
}

bool scoreLeg(const Concepts& c, bool sided, PartScores& scores) {
    const bool low = c.has(Concept::lower);
    if (c.has(Concept::shin) || (c.has(Concept::leg) && low)) {
        set(scores, {{Part::lowerLeg, kClear}});
    } else if (c.has(Concept::knee)) {
        set(scores, {{Part::lowerLeg, 4.0F}});
    } else if (c.has(Concept::thigh) || (c.has(Concept::leg) && c.has(Concept::upper))) {
        set(scores, {{Part::upperLeg, kClear}});
    } else if (c.has(Concept::ankle)) {
        set(scores, {{Part::foot, 4.0F}});
    } else if (c.has(Concept::toes)) {
        set(scores, {{Part::toes, kClear}, {Part::foot, -0.5F}});
    } else if (c.has(Concept::heel)) {
        set(scores, {{Part::foot, -1.5F}});
    } else if (c.has(Concept::foot) && low) {
        set(scores, {{Part::toes, 3.0F}, {Part::foot, 2.0F}});  // "ForeFoot"
    } else if (c.has(Concept::foot)) {
        set(scores, {{Part::foot, 4.0F}, {Part::toes, 0.5F}});
    } else if (sided && c.hasAny({Concept::hip, Concept::hips})) {
        // A sided pelvis lies between the hips and the thigh; a sided hip usually is the thigh.
        set(scores, {{Part::upperLeg, c.has(Concept::hip) ? 2.5F : -1.0F}});
    } else if (c.has(Concept::leg)) {
        set(scores, {{Part::lowerLeg, 2.0F}, {Part::upperLeg, kBareLimb}, {Part::foot, -1.5F}});
    } else {
        return false;
    }
    return true;
}

void scoreTrunk(const Concepts& c, bool sided, PartScores& scores) {
    const bool low = c.has(Concept::lower);
    const bool up = c.has(Concept::upper);
    if (sided && c.has(Concept::chest)) {
        set(scores, {{Part::clavicle, 0.8F}});
    } else if (c.hasAny({Concept::hips, Concept::hip}) || (low && c.hasAny({Concept::torso, Concept::body}))) {
        set(scores, {{Part::hips, kClear}, {Part::trunk, low && c.has(Concept::body) ? -0.5F : -1.5F}});
    } else if (c.has(Concept::neck)) {
        set(scores, {{Part::neck, 4.0F}, {Part::head, -0.5F}, {Part::chest, -1.5F}});
    } else if (c.has(Concept::head)) {
        set(scores, {{Part::head, kClear}, {Part::neck, -1.5F}});
    } else if (c.has(Concept::chest)) {
        set(scores, {{Part::chest, 4.0F}, {Part::trunk, 2.0F}});
    } else if (up && c.hasAny({Concept::torso, Concept::body})) {
        set(scores, {{Part::chest, 4.0F}, {Part::trunk, 1.5F}});
    } else if (c.has(Concept::torso)) {
        set(scores, {{Part::chest, 2.5F}, {Part::trunk, 2.5F}, {Part::hips, 0.5F}});
    } else if (c.has(Concept::abdomen)) {
        set(scores, {{Part::trunk, 3.0F}, {Part::chest, -0.5F}, {Part::hips, -0.5F}});
    } else if (c.has(Concept::spine)) {
        // One convention numbers the spine on up to the head.
        set(scores, {{Part::trunk, 3.0F},
                     {Part::chest, up ? 3.0F : 2.5F},
                     {Part::hips, 0.0F},
                     {Part::neck, -0.5F},
                     {Part::head, -0.5F}});
    } else if (c.has(Concept::body)) {
        set(scores, {{Part::hips, 1.0F}, {Part::trunk, 0.5F}, {Part::chest, 0.5F}});
    } else if (c.has(Concept::root)) {
        scores.values.fill(kRootIsNone);
        scores[Part::hips] = 0.5F;
    }
}

bool takesNoRole(const Concepts& c, const NameTokens& tokens) {
    const bool trunk = c.hasAny({Concept::spine, Concept::chest, Concept::torso, Concept::neck, Concept::hips});
    const bool onlyMiddle = std::all_of(tokens.words.begin(), tokens.words.end(), [](const std::string& word) {
        return conceptOf(word) != Concept::finger || word == "mid" || word == "middle";
    });
    if (c.has(Concept::finger) && !(trunk && onlyMiddle)) return !c.has(Concept::toes);
    return c.hasAny({Concept::control, Concept::end, Concept::face, Concept::hair, Concept::cloth, Concept::prop,
                     Concept::creature});
}

// "FootIK.L": a control by its name; where it moves skin it is the foot.
void keepBelowControl(const Concepts& c, NameEvidence& evidence) {
    constexpr float kControlLoss = -1.0F;
    evidence.control = c.has(Concept::control) &&
                       !c.hasAny({Concept::finger, Concept::end, Concept::face, Concept::hair, Concept::cloth,
                                  Concept::prop, Concept::creature, Concept::twist, Concept::root});
    if (!evidence.control) return;
    evidence.partsIfSkinned = evidence.parts;
    for (float& score : evidence.partsIfSkinned.values)
        score += kControlLoss;
}

bool isCarriedOnBack(std::string_view word) {
    constexpr std::array<std::string_view, 12> kWords{"cape", "capes",   "cloak", "cloaks", "backpack", "rucksack",
                                                      "wing", "jetpack", "wings", "elytra", "tail",     "tails"};
    return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

bool hasWord(const std::vector<std::string>& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

// Words that mean a part in French only, where the side is told in French: "main gauche" is a hand, "arme droite" a
// weapon.
void readFrench(std::string_view name, std::vector<std::string>& words) {
    const std::string lower = lowerCased(name);
    if (lower.find("gauche") == std::string::npos && lower.find("droit") == std::string::npos) return;
    std::replace(words.begin(), words.end(), std::string("main"), std::string("hand"));
    std::replace(words.begin(), words.end(), std::string("arme"), std::string("weapon"));
}

}  // namespace

NameEvidence nameEvidence(std::string_view name) {
    NameTokens tokens = tokenise(name);
    readFrench(name, tokens.words);
    const Concepts concepts(tokens.words);
    NameEvidence evidence;
    evidence.side = tokens.side;
    evidence.words = tokens.words;
    evidence.numbers = tokens.numbers;
    const bool sided = tokens.side != Side::center;
    if (!scoreArm(concepts, evidence.parts) && !scoreLeg(concepts, sided, evidence.parts)) {
        scoreTrunk(concepts, sided, evidence.parts);
    }
    const bool fourLegged =
        (hasWord(tokens.words, "fore") || hasWord(tokens.words, "back")) && concepts.has(Concept::leg);
    // The front of a skirt, a tail of hair.
    evidence.worn = concepts.hasAny({Concept::cloth, Concept::hair});
    evidence.creature = !evidence.worn && (fourLegged || concepts.has(Concept::creature));
    evidence.tail = !evidence.worn && (hasWord(tokens.words, "tail") || hasWord(tokens.words, "tails"));
    evidence.bareLimb = evidence.parts[Part::upperArm] == kBareLimb || evidence.parts[Part::upperLeg] == kBareLimb;
    evidence.face = concepts.has(Concept::face);
    evidence.finger = concepts.has(Concept::finger) && !concepts.has(Concept::toes);
    evidence.thumb = hasWord(tokens.words, "thumb") || hasWord(tokens.words, "thumbs");
    evidence.onBack = std::any_of(tokens.words.begin(), tokens.words.end(), isCarriedOnBack);
    evidence.held = concepts.has(Concept::prop);
    evidence.helper = concepts.hasAny({Concept::twist, Concept::control, Concept::end, Concept::prop});
    evidence.meaningful = !concepts.empty();
    keepBelowControl(concepts, evidence);
    if (takesNoRole(concepts, tokens) || evidence.creature) {
        for (float& score : evidence.parts.values)
            score = std::min(score, 0.0F) * 0.2F + kNoRole;
    } else if (concepts.has(Concept::twist)) {
        for (float& score : evidence.parts.values)
            score += kTwistLoss;
        // One convention calls its neck "NeckTwist".
        if (concepts.has(Concept::neck)) evidence.parts[Part::neck] = 1.5F;
    }
    return evidence;
}

bool isSecondSegment(const NameEvidence& above, const NameEvidence& name) {
    if (!name.meaningful || name.side != above.side || name.words.size() < above.words.size()) return false;
    if (!std::equal(above.words.begin(), above.words.end(), name.words.begin())) return false;
    return std::none_of(name.words.begin() + static_cast<std::ptrdiff_t>(above.words.size()), name.words.end(),
                        [](const std::string& word) { return conceptOf(word).has_value(); });
}

}  // namespace lutka::animation
