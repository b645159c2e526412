#include <algorithm>

#include "animation/import/fbx/tangents.hpp"

namespace lutka::animation::rig_import::fbx {
namespace {

// Walks over the values of an FBX 6 `Key:` row, whose keys differ in length.
class KeyRow {
  public:
    explicit KeyRow(const Record& record) : record_(record) {
        if (record.values.size() == 1) row_ = record.numbers();  // numbers only: kept as an array
    }
    [[nodiscard]] bool has(std::size_t count) const { return at_ + count <= size(); }
    double number() {
        const std::size_t place = at_++;
        if (place >= size()) return 0.0;
        return row_.size() > 1 ? row_[place] : record_.number(place);
    }
    // Letters are words in ASCII and in binary documents numbers or texts of one character.
    char letter() {
        const std::size_t place = at_++;
        const std::string_view text = record_.text(place);
        if (!text.empty()) return text[0];
        const std::int64_t code = record_.integer(place);
        return code > 0 && code < 127 ? static_cast<char>(code) : '\0';
    }

  private:
    [[nodiscard]] std::size_t size() const { return row_.size() > 1 ? row_.size() : record_.values.size(); }
    const Record& record_;
    std::vector<double> row_;
    std::size_t at_ = 0;
};

// One statement of weights after a key's slopes; `right` and `left` keep theirs where it makes none.
void readWeights(KeyRow& row, KeyData& data, double& right, double& left) {
    const char kind = row.letter();
    if (kind == 'a' || kind == 'r') {
        data.flags |= kWeightedRight;
        right = row.number();
    }
    if (kind == 'a' || kind == 'l') {
        data.flags |= kWeightedNextLeft;
        left = row.number();
    }
}

// What follows a key's `U`: how its slopes and weights are written. Only 's' and 'b' state slopes; the others are taken
// for automatic ones.
void readSlopes(KeyRow& row, int version, KeyData& data) {
    const char mode = row.letter();
    int weights = 1;
    if (mode == 's' || mode == 'b') {
        data.flags |= kUser;
        data.numbers[0] = static_cast<float>(row.number());
        data.numbers[1] = static_cast<float>(row.number());
        weights = version == 4003 ? 0 : 1;
    } else {
        data.flags |= kClampProgressive | kTimeIndependent;
        const int unknown = mode == 'p' || mode == 'q' ? 2 : (mode == 't' ? 3 : (mode == 'd' ? 1 : 0));
        for (int i = 0; i < unknown; ++i)
            (void)row.number();
        if (mode == 'p' || mode == 'q') weights = version <= 4004 ? 1 : 2;
        if (mode == 't' || (mode == 'a' && version <= 4004)) weights = 0;
    }
    double right = 1.0 / 3.0;
    double left = 1.0 / 3.0;
    for (int i = 0; i < weights; ++i)
        readWeights(row, data, right, left);
    if ((data.flags & (kWeightedRight | kWeightedNextLeft)) != 0U) data.numbers[2] = packedWeights(right, left);
}

}  // namespace

std::optional<Curve> readChannel(const Record& record, double ticksPerSecond) {
    const Record* written = record.child("Key");
    const Record* version = record.child("KeyVer");
    if (written == nullptr) return std::nullopt;
    const int number = version != nullptr ? static_cast<int>(version->integer(0)) : 4005;
    KeyRow row(*written);
    std::vector<Curve::Key> keys;
    std::vector<KeyData> data;
    while (row.has(2)) {
        Curve::Key& key = keys.emplace_back();
        KeyData& datum = data.emplace_back();
        key.seconds = row.number() / ticksPerSecond;
        key.value = row.number();
        const char kind = row.has(1) ? row.letter() : 'L';
        if (kind == 'C') {
            datum.flags = kConstant;
            if (number >= 4004 && row.letter() == 'n') datum.flags |= kConstantNext;
        } else if (kind == 'U') {
            datum.flags = kCubic;
            readSlopes(row, number, datum);
        }
    }
    if (keys.empty()) return std::nullopt;
    sortKeys(keys, data);
    setTangents(keys, data);
    return Curve(keys, readBeyond(record, "Pre-Extrapolation"), readBeyond(record, "Post-Extrapolation"));
}

}  // namespace lutka::animation::rig_import::fbx
