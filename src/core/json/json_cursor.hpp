#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace lutka {

/// A place in a JSON document that is read strictly: whatever is not as expected is reported with its JSON pointer, and
/// reading goes on with a harmless value, so that one pass lists every problem.
class JsonCursor {
  public:
    /// `problems` gains a line a problem and must outlive the cursor and all made from it.
    JsonCursor(const nlohmann::json& document, std::vector<std::string>& problems)
        : value_(&document), problems_(&problems) {}

    /// A member or item; one that is not there reads as nothing (its absence is expectObject()'s to report).
    [[nodiscard]] JsonCursor operator[](const char* key) const;
    [[nodiscard]] JsonCursor operator[](std::size_t index) const;
    [[nodiscard]] bool has(const char* key) const;
    [[nodiscard]] std::size_t size() const { return value_ != nullptr ? value_->size() : 0; }
    /// Whether there is a value of the type that was last expected: further checks of it make sense.
    [[nodiscard]] bool readable() const { return value_ != nullptr && !failed_; }

    void report(const std::string& expectation) const;

    /// Reports another type, each missing key of `required`, and each key that is in neither list.
    void expectObject(std::initializer_list<const char*> required,
                      std::initializer_list<const char*> optional = {}) const;
    /// True when it is an array of a size in [fewest, most].
    bool expectArray(int fewest, int most) const;

    /// A finite number in [low, high]; `low` (or 0) where it is not.
    [[nodiscard]] float number(float low, float high) const;
    /// An array of `count` finite numbers in [low, high]; always `count` long.
    [[nodiscard]] std::vector<float> numbers(std::size_t count, float low, float high) const;
    [[nodiscard]] std::optional<long long> wholeNumber() const;
    /// One in [low, high]; nothing (reported) where it is not.
    [[nodiscard]] std::optional<long long> wholeNumber(long long low, long long high) const;
    [[nodiscard]] std::string text() const;
    /// Index of the text among the choices; -1 (reported) when it is none of them.
    int oneOf(std::span<const char* const> choices) const;
    int oneOf(std::initializer_list<const char*> choices) const {
        return oneOf(std::span<const char* const>(choices.begin(), choices.size()));
    }
    [[nodiscard]] std::optional<bool> truth() const;

  private:
    JsonCursor(const nlohmann::json* value, std::string pointer, std::vector<std::string>* problems)
        : value_(value), pointer_(std::move(pointer)), problems_(problems) {}
    // Reports a value of another type; nothing where there is no value.
    void wrongType(const char* expectation) const;

    const nlohmann::json* value_ = nullptr;
    std::string pointer_;
    std::vector<std::string>* problems_;
    mutable bool failed_ = false;
};

/// What is wrong with a document's members "format" and "version", which come first: nothing else means anything
/// without them. Empty when they are `format` and `version`, or one of the versions from `oldest` on; 0: no older one.
[[nodiscard]] std::vector<std::string> checkFormat(const nlohmann::json& document, const char* format, int version,
                                                   int oldest = 0);

/// A kind of document that is refused with all that is wrong with it.
struct JsonDocumentKind {
    std::string_view name;  ///< "ragdoll profile"
    std::string_view mend;  ///< Where its members are described.
};
/// ErrorCode::input with the problems, a line each, of more than 50 the first ones.
[[nodiscard]] Error refusedDocument(const JsonDocumentKind& kind, std::string_view source,
                                    std::span<const std::string> problems);

}  // namespace lutka
