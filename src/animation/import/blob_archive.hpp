#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/rigid_transform.hpp"

namespace lutka::animation::rig_import {

/// What its bytes are all of. Not std::is_trivially_copyable: glm's types say no to it only because they start as zero.
template <class T>
concept PlainValue = std::is_standard_layout_v<T> && std::is_trivially_destructible_v<T> && !std::is_pointer_v<T>;

/// Both archives have the same members, so that one function can say what a struct consists of and serve for writing
/// and for reading. Plain values go as their bytes, in the byte order of this machine: a blob never leaves it.

/// Appends to a string of bytes.
class BlobWriter {
  public:
    static constexpr bool kReads = false;

    template <class T>
    requires PlainValue<T>
    void value(const T& item) { bytes_.append(reinterpret_cast<const char*>(&item), sizeof item); }
    template <class Enum>
    void choice(const Enum& item, Enum /*last*/) {
        value(static_cast<std::uint8_t>(item));
    }
    void text(const std::string& item) {
        count(item.size());
        bytes_ += item;
    }
    /// A vector of plain values.
    template <PlainValue T>
    void array(const std::vector<T>& items) {
        count(items.size());
        bytes_.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T));
    }
    /// A vector of anything, with what each item consists of.
    template <class T, class Each>
    void list(const std::vector<T>& items, Each each) {
        count(items.size());
        for (const T& item : items)
            each(*this, item);
    }
    template <class T>
    void maybe(const std::optional<T>& item) {
        value(static_cast<std::uint8_t>(item.has_value()));
        if (item) value(*item);
    }
    template <class Enum>
    void maybeChoice(const std::optional<Enum>& item, Enum last) {
        value(static_cast<std::uint8_t>(item.has_value()));
        if (item) choice(*item, last);
    }
    void names(const std::map<std::string, int>& items) {
        count(items.size());
        for (const auto& [name, number] : items) {
            text(name);
            value(number);
        }
    }

    [[nodiscard]] std::string take() { return std::move(bytes_); }

  private:
    void count(std::size_t size) { value(static_cast<std::uint64_t>(size)); }

    std::string bytes_;
};

/// Takes from bytes that are not trusted: whatever is not there or not a number reads as zero or nothing, and ok() is
/// false from then on. No more is allocated than a small multiple of the bytes that are there.
class BlobReader {
  public:
    static constexpr bool kReads = true;

    explicit BlobReader(std::string_view bytes) : bytes_(bytes) {}

    [[nodiscard]] bool ok() const { return ok_; }
    [[nodiscard]] bool atEnd() const { return bytes_.empty(); }

    template <class T>
    requires PlainValue<T>
    void value(T& item) {
        if (!take(&item, sizeof item) || !isNumber(item)) item = fail<T>();
    }
    template <class Enum>
    void choice(Enum& item, Enum last) {
        std::uint8_t number = 0;
        value(number);
        if (number > static_cast<std::uint8_t>(last)) number = fail<std::uint8_t>();
        item = static_cast<Enum>(number);
    }
    void text(std::string& item) {
        item.resize(count(1));
        take(item.data(), item.size());
    }
    template <PlainValue T>
    void array(std::vector<T>& items) {
        items.resize(count(sizeof(T)));
        take(items.data(), items.size() * sizeof(T));
        for (const T& item : items) {
            if (!isNumber(item)) ok_ = false;
        }
    }
    template <class T, class Each>
    void list(std::vector<T>& items, Each each) {
        // No item takes fewer bytes than this, so that a count can't ask for more than the blob's length holds.
        constexpr std::size_t leastBytes = 8;
        const std::size_t size = count(leastBytes);
        for (std::size_t i = 0; ok_ && i < size; ++i)
            each(*this, items.emplace_back());
    }
    template <class T>
    void maybe(std::optional<T>& item) {
        if (flag()) value(item.emplace());
    }
    template <class Enum>
    void maybeChoice(std::optional<Enum>& item, Enum last) {
        if (flag()) choice(item.emplace(), last);
    }
    void names(std::map<std::string, int>& items) {
        const std::size_t size = count(sizeof(std::uint64_t) + sizeof(int));
        for (std::size_t i = 0; ok_ && i < size; ++i) {
            std::string name;
            text(name);
            value(items[name]);
        }
    }

  private:
    template <class T>
    T fail() {
        ok_ = false;
        return T{};
    }
    bool flag() {
        std::uint8_t number = 0;
        value(number);
        if (number > 1) ok_ = false;
        return number == 1 && ok_;
    }
    bool take(void* to, std::size_t size) {
        if (size > bytes_.size()) ok_ = false;
        if (!ok_) return false;
        if (size > 0) std::memcpy(to, bytes_.data(), size);
        bytes_.remove_prefix(size);
        return true;
    }
    // A number of items of at least so many bytes each.
    std::size_t count(std::size_t bytesEach) {
        std::uint64_t size = 0;
        value(size);
        if (size > bytes_.size() / bytesEach) return fail<std::size_t>();
        return ok_ ? static_cast<std::size_t>(size) : 0;
    }

    template <class T>
    static bool isNumber(const T& item) {
        if constexpr (std::is_floating_point_v<T>) {
            return std::isfinite(item);
        } else if constexpr (requires { item[0][0]; }) {
            for (glm::length_t i = 0; i < T::length(); ++i) {
                if (!isNumber(item[i])) return false;
            }
        } else if constexpr (requires { T::length(); }) {
            for (glm::length_t i = 0; i < T::length(); ++i) {
                if (!isNumber(item[i])) return false;
            }
        }
        return true;
    }

    std::string_view bytes_;
    bool ok_ = true;
};

}  // namespace lutka::animation::rig_import
