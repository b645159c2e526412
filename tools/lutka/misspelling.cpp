#include "misspelling.hpp"

#include <algorithm>
#include <vector>

#include "core/letter_case.hpp"

namespace lutka::cli {
namespace {

// Optimal string alignment: Levenshtein's distance, and neighbours that are swapped count once.
std::size_t changesBetween(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> rows(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                rows[i][j] = i + j;
                continue;
            }
            const auto same = [&](std::size_t inA, std::size_t inB) {
                return lowerCased(a[inA]) == lowerCased(b[inB]);
            };
            const std::size_t other = same(i - 1, j - 1) ? 0 : 1;
            rows[i][j] = std::min({rows[i - 1][j] + 1, rows[i][j - 1] + 1, rows[i - 1][j - 1] + other});
            const bool swapped = i > 1 && j > 1 && same(i - 1, j - 2) && same(i - 2, j - 1);
            if (swapped) rows[i][j] = std::min(rows[i][j], rows[i - 2][j - 2] + 1);
        }
    }
    return rows[a.size()][b.size()];
}

std::string_view withoutDashes(std::string_view word) {
    return word.substr(std::min(word.find_first_not_of('-'), word.size()));
}

// Whether the letters of `part` stand in `word` in their order, the first in front: as words are shortened. Two letters
// stand so in almost any.
bool isShortFor(std::string_view part, std::string_view word) {
    constexpr std::size_t kFewest = 3;
    part = withoutDashes(part);
    word = withoutDashes(word);
    if (part.size() < kFewest || word.empty() || lowerCased(part.front()) != lowerCased(word.front())) return false;
    std::size_t at = 0;
    for (const char letter : word)
        at += at < part.size() && lowerCased(letter) == lowerCased(part[at]) ? 1 : 0;
    return at == part.size();
}

}  // namespace

std::string likelyMeant(std::string_view given, std::span<const std::string> words) {
    constexpr std::size_t kLongest = 40;  // no word of ours is longer
    if (given.size() < 2 || given.size() > kLongest) return {};
    std::string nearest;
    std::size_t fewest = std::max<std::size_t>(given.size() / 3, 1) + 1;
    for (const std::string& word : words) {
        const std::size_t changes = changesBetween(given, word);
        if (changes >= fewest) continue;
        fewest = changes;
        nearest = word;
    }
    if (!nearest.empty() && fewest <= 1) return nearest;
    const auto shortFor = [&](const std::string& word) { return isShortFor(given, word); };
    const auto found = std::find_if(words.begin(), words.end(), shortFor);
    return found == words.end() ? nearest : *found;
}

}  // namespace lutka::cli
