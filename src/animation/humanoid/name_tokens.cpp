#include "animation/humanoid/name_tokens.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "animation/humanoid/name_lexicon.hpp"
#include "core/letter_case.hpp"

namespace lutka::animation {
namespace {

constexpr char32_t kBadCharacter = 0xFFFD;

// One code point from the front of `text`, which is shortened by it; malformed bytes give kBadCharacter.
char32_t takeCodePoint(std::string_view& text) {
    const auto lead = static_cast<unsigned char>(text.front());
    const int length = lead < 0x80 ? 1 : lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC0 ? 2 : 0;
    if (length == 0 || static_cast<int>(text.size()) < length) {
        text.remove_prefix(1);
        return kBadCharacter;
    }
    char32_t code = length == 1 ? lead : lead & (0x7FU >> length);
    for (int i = 1; i < length; ++i)
        code = (code << 6U) | (static_cast<unsigned char>(text[i]) & 0x3FU);
    text.remove_prefix(static_cast<std::size_t>(length));
    return code;
}

// Full-width ASCII to ASCII, Latin letters with accents to those without (ß is left to the caller).
char32_t fold(char32_t code) {
    constexpr std::u32string_view kAccented = U"àáâãäåçèéêëìíîïñòóôõöùúûüýÀÁÂÃÄÅÇÈÉÊËÌÍÎÏÑÒÓÔÕÖÙÚÛÜÝ";
    constexpr std::string_view kPlain = "aaaaaaceeeeiiiinooooouuuuyAAAAAACEEEEIIIINOOOOOUUUUY";
    static_assert(kAccented.size() == kPlain.size());
    if (code >= 0xFF01 && code <= 0xFF5E) return code - 0xFEE0;
    if (const auto at = kAccented.find(code); at != std::u32string_view::npos) return static_cast<char32_t>(kPlain[at]);
    return code;
}

// The name in ASCII: folded, East Asian body words translated (set off by blanks), all else a blank.
std::string toAscii(std::string_view name) {
    std::u32string codes;
    while (!name.empty()) {
        const char32_t code = fold(takeCodePoint(name));
        codes += code == U'ß' ? U"ss" : std::u32string(1, code);
    }
    std::string ascii;
    for (std::size_t at = 0; at < codes.size();) {
        if (codes[at] < 0x80) {
            ascii += static_cast<char>(codes[at++]);
            continue;
        }
        const auto words = cjkWords();
        const auto word = std::find_if(words.begin(), words.end(), [&](const auto& entry) {
            return codes.compare(at, entry.first.size(), entry.first) == 0;
        });
        if (word == words.end()) {
            ascii += ' ';
            ++at;
        } else {
            ascii.append(" ").append(word->second).append(" ");
            at += word->first.size();
        }
    }
    return ascii;
}

enum class CharClass { other, lower, upper, digit };

CharClass classOf(char c) {
    if (c >= 'a' && c <= 'z') return CharClass::lower;
    if (c >= 'A' && c <= 'Z') return CharClass::upper;
    return c >= '0' && c <= '9' ? CharClass::digit : CharClass::other;
}

bool isDigits(std::string_view token) {
    return !token.empty() && classOf(token.front()) == CharClass::digit;
}

// "LeftUpLeg_02" → Left Up Leg 02; "LThigh" → L Thigh; the tokens keep their case.
std::vector<std::string_view> splitAtCase(std::string_view name) {
    std::vector<std::string_view> tokens;
    std::size_t begin = 0;
    for (std::size_t at = 0; at <= name.size(); ++at) {
        const CharClass here = at < name.size() ? classOf(name[at]) : CharClass::other;
        const CharClass before = at > begin ? classOf(name[at - 1]) : CharClass::other;
        const bool lowerNext = at + 1 < name.size() && classOf(name[at + 1]) == CharClass::lower;
        const bool digits = here == CharClass::digit;
        const bool newWord = here == CharClass::upper && (before == CharClass::lower || lowerNext);
        const bool cut = here == CharClass::other || digits != (before == CharClass::digit) || newWord;
        if (!cut || (at == begin && here != CharClass::other)) continue;
        if (at > begin) tokens.push_back(name.substr(begin, at - begin));
        begin = here == CharClass::other ? at + 1 : at;
    }
    return tokens;
}

// Whether a word may stand glued inside another: short ones only where they are common in rigs.
bool gluable(std::string_view word) {
    constexpr std::array<std::string_view, 6> kShort{"up", "lo", "dn", "ik", "fk", "pe"};
    if (word.size() < 3) return std::find(kShort.begin(), kShort.end() - 1, word) != kShort.end() - 1;
    return conceptOf(word).has_value();
}

// Cuts a glued word into lexicon words ("upperarm", "lefthand"), the fewest there are; false when it can't be.
bool segment(const std::string& word, std::vector<std::string>& pieces) {
    constexpr int kNone = 99;
    const int size = static_cast<int>(word.size());
    std::vector<int> count(size + 1, kNone);
    std::vector<int> from(size + 1, 0);
    count[0] = 0;
    for (int end = 1; end <= size; ++end) {
        for (int begin = 0; begin < end; ++begin) {
            const std::string_view piece(word.data() + begin, static_cast<std::size_t>(end - begin));
            const bool longEnough = size > 3 || word.starts_with("ik") || word.starts_with("fk");
            const bool sideLetter = (piece == "l" || piece == "r") && (begin == 0 || end == size) && longEnough;
            if (count[begin] + 1 >= count[end] || !(sideLetter || gluable(piece))) continue;
            count[end] = count[begin] + 1;
            from[end] = begin;
        }
    }
    if (count[size] >= kNone) return false;
    std::vector<std::string> reversed;
    for (int end = size; end > 0; end = from[end])
        reversed.push_back(word.substr(from[end], end - from[end]));
    pieces.insert(pieces.end(), reversed.rbegin(), reversed.rend());
    return true;
}

void addWord(const std::string& word, NameTokens& tokens) {
    const auto meaning = conceptOf(word);
    if (meaning == Concept::leftSide || meaning == Concept::rightSide) {
        tokens.side = *meaning == Concept::leftSide ? Side::left : Side::right;
    } else if (word.size() > 1) {
        tokens.words.push_back(word);
    }
}

// "L5", "T12", "jL5S1": vertebrae (Xsens), not sides.
bool namesVertebra(std::string_view name) {
    if (!name.empty() && name.front() == 'j') name.remove_prefix(1);
    int groups = 0;
    while (!name.empty()) {
        if (std::string_view("CTLS").find(name.front()) == std::string_view::npos) return false;
        std::size_t digits = 1;
        while (digits < name.size() && classOf(name[digits]) == CharClass::digit)
            ++digits;
        if (digits == 1 || digits > 3) return false;
        name.remove_prefix(digits);
        ++groups;
    }
    return groups > 0;
}

// "Bip01FBXASC032LFBXASC032Thigh": how FBX writes characters that its older versions had no names with, as three
// digits.
std::string withoutFbxEscapes(std::string_view name) {
    constexpr std::string_view kMark = "FBXASC";
    constexpr std::size_t kDigits = 3;
    std::string out;
    while (!name.empty()) {
        const std::string_view digits = name.size() < kMark.size() ? "" : name.substr(kMark.size(), kDigits);
        const bool isEscape = name.starts_with(kMark) && digits.size() == kDigits &&
                              std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
        const int code = isEscape ? std::atoi(std::string(digits).c_str()) : 0;
        const bool known = code >= ' ' && code < 127;  // ASCII that is printed
        out += known ? static_cast<char>(code) : isEscape ? ' ' : name.front();
        name.remove_prefix(isEscape ? kMark.size() + kDigits : 1);
    }
    return out;
}

}  // namespace

NameTokens tokenise(std::string_view escaped) {
    const std::string whole = withoutFbxEscapes(escaped);
    std::string_view name = whole;
    while (!name.empty() && (name.back() == ':' || name.back() == '|' || name.back() == ' '))
        name.remove_suffix(1);
    if (const auto colon = name.find_last_of(":|"); colon != std::string_view::npos) name.remove_prefix(colon + 1);
    NameTokens tokens;
    if (namesVertebra(name)) {
        tokens.words.emplace_back("vertebra");
        return tokens;
    }
    const std::string ascii = toAscii(name);
    for (const std::string_view token : splitAtCase(ascii)) {
        if (isDigits(token)) {
            tokens.numbers.push_back(std::atoi(std::string(token.substr(0, 6)).c_str()));
            continue;
        }
        const std::string word = lowerCased(token);
        std::vector<std::string> pieces;
        if (conceptOf(word) || word.size() < 3 || !segment(word, pieces)) pieces = {word};
        for (const std::string& piece : pieces)
            addWord(piece, tokens);
    }
    return tokens;
}

}  // namespace lutka::animation
