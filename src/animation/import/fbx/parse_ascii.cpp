#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "animation/import/fbx/limits.hpp"
#include "animation/import/fbx/parsers.hpp"

namespace lutka::animation::rig_import::fbx {
namespace {

// From so many numbers on a row of them is kept as an array.
constexpr std::size_t kFew = 8;

bool isBlank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

bool isWord(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '|' ||
           c == '-' || c == '+' || c == '.' || c == '#';
}

class AsciiParser {
  public:
    AsciiParser(Document& document, std::string location)
        : document_(document),
          text_(reinterpret_cast<const char*>(document.bytes.data()), document.bytes.size()),
          location_(std::move(location)) {}

    std::optional<Error> parse() {
        if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
        readList(document_.root, 1);
        if (!failed_ && at_ < text_.size()) fail("a closing brace without an opening one");
        if (const Record* header = document_.root.child("FBXHeaderExtension"); header != nullptr) {
            if (const Record* version = header->child("FBXVersion"); version != nullptr)
                document_.version = static_cast<int>(version->integer(0));
        }
        return failed_;
    }

  private:
    void fail(const std::string& message) {
        if (failed_) return;
        int line = 1;
        for (const char c : text_.substr(0, at_))
            line += c == '\n' ? 1 : 0;
        failed_ =
            Error{ErrorCode::input, fmt::format("{} (line {})", message, line), location_, "export the file again"};
    }

    void skipBlanks() {
        while (at_ < text_.size()) {
            if (text_[at_] == ';') {
                at_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
            } else if (isBlank(text_[at_])) {
                ++at_;
            } else {
                return;
            }
        }
    }

    [[nodiscard]] char next() {
        skipBlanks();
        return at_ < text_.size() ? text_[at_] : '\0';
    }

    // Records up to the closing brace, which stays, or the document's end.
    void readList(Record& parent, int depth) {
        if (depth > kMaxRecordDepth) return fail(fmt::format("records are nested deeper than {}", kMaxRecordDepth));
        while (!failed_) {
            const char c = next();
            if (c == '\0' || c == '}') return;
            const std::size_t start = at_;
            while (at_ < text_.size() && isWord(text_[at_]))
                ++at_;
            const std::string_view name = text_.substr(start, at_ - start);
            if (name.empty() || next() != ':') return fail("a record without a name");
            ++at_;
            if (++records_ > kMaxRecords) return fail(fmt::format("more than {} records", kMaxRecords));
            Record& record = parent.children.emplace_back();
            record.name = name;
            readValues(record);
            if (!failed_ && next() == '{') {
                ++at_;
                readList(record, depth + 1);
                close();
            }
        }
    }

    void close() {
        if (failed_) return;
        if (next() != '}') return fail("a list breaks off");
        ++at_;
    }

    // A word that a colon follows is the next record's name, no value.
    [[nodiscard]] bool startsRecord() const {
        std::size_t at = at_;
        while (at < text_.size() && isWord(text_[at]))
            ++at;
        while (at < text_.size() && (text_[at] == ' ' || text_[at] == '\t'))
            ++at;
        return at < text_.size() && text_[at] == ':';
    }

    void readValues(Record& record) {
        std::vector<double> plain;  // a long row of numbers, as FBX 6 writes its arrays
        bool more = true;
        for (bool first = true; more && !failed_; first = false) {
            const char c = next();
            // Nothing at all (`Name: {` or an empty line), or nothing before a comma.
            if (c == ',' && first) {
                ++at_;
                continue;
            }
            if (c == '\0' || c == '{' || c == '}' || (first && c != '"' && startsRecord())) break;
            if (!plain.empty() && isNumber(c)) {
                if (countNumber()) plain.push_back(numberAsReal());
            } else {
                if (!plain.empty()) spread(plain, record);
                if (++values_ > kMaxValues) return fail(fmt::format("more than {} values", kMaxValues));
                readValue(c, record);
                if (record.values.size() == kFew) plain = asRow(record);
            }
            more = !failed_ && next() == ',';
            if (more) ++at_;
        }
        if (!plain.empty()) record.values.emplace_back(std::move(plain));
    }

    bool countNumber() {
        if (++numbers_ > kMaxArrayNumbers) fail(fmt::format("more than {} numbers in arrays", kMaxArrayNumbers));
        return !failed_;
    }

    // Takes the values over when all are numbers.
    static std::vector<double> asRow(Record& record) {
        for (const Value& value : record.values) {
            if (!std::holds_alternative<std::int64_t>(value) && !std::holds_alternative<double>(value)) return {};
        }
        std::vector<double> row = record.numbers();
        record.values.clear();
        return row;
    }

    void spread(std::vector<double>& row, Record& record) {
        values_ += row.size();
        if (values_ > kMaxValues) return fail(fmt::format("more than {} values", kMaxValues));
        for (const double value : row)
            record.values.emplace_back(value);
        row.clear();
    }

    [[nodiscard]] static bool isNumber(char c) { return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.'; }

    std::string_view numberText() {
        const std::size_t start = at_;
        while (at_ < text_.size() && text_[at_] != ',' && text_[at_] != '}' && text_[at_] != '{' &&
               !isBlank(text_[at_]))
            ++at_;
        std::string_view word = text_.substr(start, at_ - start);
        if (word.starts_with('+')) word.remove_prefix(1);
        return word;
    }

    double numberAsReal() {
        const std::string_view word = numberText();
        double value = 0.0;
        const char* end = word.data() + word.size();
        const auto [parsed, code] = std::from_chars(word.data(), end, value);
        // "1.#INF", "-nan(ind)" and the like: no number, but no reason to give the file up.
        if (code == std::errc::invalid_argument) fail(fmt::format("'{}' is no number", word.substr(0, 20)));
        // Microsoft's spelling begins with a digit.
        if (parsed != end && *parsed == '#') return std::numeric_limits<double>::quiet_NaN();
        return code == std::errc() ? value : 0.0;
    }

    void readValue(char c, Record& record) {
        if (c == '"') {
            record.values.emplace_back(quoted());
        } else if (c == '*') {
            readArray(record);
        } else if (isNumber(c)) {
            readNumber(record);
        } else if (isWord(c)) {
            const std::size_t start = at_;
            while (at_ < text_.size() && isWord(text_[at_]))
                ++at_;
            record.values.emplace_back(text_.substr(start, at_ - start));
        } else {
            fail("a value that is neither number, text nor array");
        }
    }

    // Whole numbers stay exact: they may be the ids of objects.
    void readNumber(Record& record) {
        const std::size_t start = at_;
        const std::string_view word = numberText();
        std::int64_t whole = 0;
        const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), whole);
        if (code == std::errc() && end == word.data() + word.size()) {
            record.values.emplace_back(whole);
            return;
        }
        at_ = start;
        record.values.emplace_back(numberAsReal());
    }

    // *12 { a: 1,2,3 }
    void readArray(Record& record) {
        ++at_;
        (void)numberText();  // the count is not trusted
        if (next() != '{') return fail("an array without numbers");
        ++at_;
        std::vector<double> numbers;
        if (next() == 'a') {
            ++at_;
            if (next() != ':') return fail("an array without numbers");
            ++at_;
        }
        while (!failed_ && (isNumber(next()) || isWord(next()))) {  // "nan" and "inf" are words
            if (countNumber()) numbers.push_back(numberAsReal());
            if (next() == ',') ++at_;
        }
        close();
        record.values.emplace_back(std::move(numbers));
    }

    std::string_view quoted() {
        const std::size_t start = ++at_;
        const std::size_t end = text_.find('"', start);
        if (end == std::string_view::npos) {
            fail("a text breaks off");
            return {};
        }
        at_ = end + 1;
        const std::string_view raw = text_.substr(start, end - start);
        if (raw.find('&') == std::string_view::npos) return raw;
        return document_.texts.emplace_back(unescaped(raw));
    }

    static std::string unescaped(std::string_view raw) {
        std::string out;
        constexpr std::pair<std::string_view, char> kEscapes[] = {
            {"&quot;", '"'}, {"&cr;", '\r'}, {"&lf;", '\n'}, {"&amp;", '&'}};
        for (std::size_t at = 0; at < raw.size();) {
            std::size_t length = 1;
            char c = raw[at];
            for (const auto& [escape, meant] : kEscapes) {
                if (!raw.substr(at).starts_with(escape)) continue;
                c = meant;
                length = escape.size();
            }
            out += c;
            at += length;
        }
        return out;
    }

    Document& document_;
    std::string_view text_;
    std::string location_;
    std::size_t at_ = 0;
    std::size_t records_ = 0;
    std::size_t values_ = 0;
    std::size_t numbers_ = 0;
    std::optional<Error> failed_;
};

}  // namespace

std::optional<Error> parseAscii(Document& document, const std::string& location) {
    return AsciiParser(document, location).parse();
}

}  // namespace lutka::animation::rig_import::fbx
