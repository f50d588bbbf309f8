#include "proto/schema_fields.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "proto/schema_values.h"
#include "renderengine/error.h"

namespace antipode {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// "map.width" is said of a message within.
std::string_view within(std::string_view name) { return name.substr(0, std::min(name.find('.'), name.size())); }
bool isWithin(std::string_view name) { return within(name) != name; }

const FieldDescriptor* fieldOf(const Message& message, std::string_view name) {
    const FieldDescriptor* field = message.GetDescriptor()->FindFieldByName(std::string(name));
    if (!field) throw Error(ErrorCode::Input, "the schema has no field '" + std::string(name) + "'");
    return field;
}

template <class T>
constexpr int components = 3;
template <class T, size_t n>
constexpr int components<std::array<T, n>> = int(n);

template <class T>
struct ComponentOf {
    using Type = float;
};
template <class T, size_t n>
struct ComponentOf<std::array<T, n>> {
    using Type = T;
};

std::string reference(uint32_t index) { return std::string("#").append(std::to_string(index)); }

}  // namespace

// ---- Writing

SchemaField<Message> FieldWriter::target() const {
    const std::string_view name = name_, outer = within(name);
    if (!isWithin(name)) return {&message_, fieldOf(message_, name)};
    Message* inner = message_.GetReflection()->MutableMessage(&message_, fieldOf(message_, outer));
    return {inner, fieldOf(*inner, name.substr(outer.size() + 1))};
}

void FieldWriter::write(float value, Role role) const {
    const auto to = target();
    if (role == Role::Angle)
        to->SetDouble(to.message, to.field, toDegrees(value));
    else
        to->SetFloat(to.message, to.field, value);
}

void FieldWriter::write(const Vec3f& value, Role) const {
    const auto to = target();
    for (int axis = 0; axis < 3; ++axis) to->AddFloat(to.message, to.field, value[axis]);
}

void FieldWriter::write(uint32_t value, Role role) const {
    if (role == Role::Texture || role == Role::Material) return write(reference(value), role);
    if (value == 0 && isWithin(name_)) return;  // an empty message within need not be there
    const auto to = target();
    to->SetUInt32(to.message, to.field, value);
}

void FieldWriter::write(bool value, Role role) const {
    const auto to = target();
    to->SetBool(to.message, to.field, value != (role == Role::Opposite));
}

void FieldWriter::write(const std::string& value, Role) const {
    const auto to = target();
    if (to.field->is_repeated())
        to->AddString(to.message, to.field, value);
    else
        to->SetString(to.message, to.field, value);
}

void FieldWriter::writeEnumerator(int value) const {
    const auto to = target();
    to->SetEnumValue(to.message, to.field, value);
}

void FieldWriter::writeArray(const std::vector<uint8_t>& bytes) const {
    if (bytes.empty()) return;
    const auto to = target();
    to->SetString(to.message, to.field, std::string(bytes.begin(), bytes.end()));
}

template <class T>
void FieldWriter::writeArray(const std::vector<T>& values) const {
    if (values.empty()) return;
    const auto to = target();
    const auto list = to->GetMutableRepeatedFieldRef<typename ComponentOf<T>::Type>(to.message, to.field);
    for (const T& value : values)
        for (int i = 0; i < components<T>; ++i) list.Add(value[i]);
}

Message& FieldWriter::part() const {
    const auto to = target();
    return to.field->is_repeated() ? *to->AddMessage(to.message, to.field) : *to->MutableMessage(to.message, to.field);
}

// ---- Reading

FieldReader::FieldReader(const Message& message, const char* fullName, const std::string& where,
                         const ReadContext& context)
    : source_{&message, nullptr}, where_(where + ": " + fullName), context_(context) {
    const std::string_view name = fullName, outer = within(name);
    source_.field = fieldOf(message, outer);
    if (!isWithin(name)) return;
    const Message& inner = message.GetReflection()->GetMessage(message, source_.field);
    source_.message = message.GetReflection()->HasField(message, source_.field) ? &inner : nullptr;
    source_.field = fieldOf(inner, name.substr(outer.size() + 1));
}

bool FieldReader::isSet() const {
    if (!source_.message) return false;
    if (source_.field->is_repeated()) return source_->FieldSize(*source_.message, source_.field) > 0;
    return !source_.field->has_presence() || source_->HasField(*source_.message, source_.field);
}

bool FieldReader::isGiven(Role role) const {
    return isSet() && (role != Role::Texture || !source_->GetString(*source_.message, source_.field).empty());
}

void FieldReader::needs() const {
    if (!isSet()) failAt(where_, "is missing");
}

void FieldReader::read(float& value, Role role) const {
    if (!isSet()) return;
    value = role == Role::Angle ? toRadians(source_->GetDouble(*source_.message, source_.field))
                                : source_->GetFloat(*source_.message, source_.field);
}

void FieldReader::read(Vec3f& value, Role role) const {
    if (!isSet()) return;
    const int size = source_->FieldSize(*source_.message, source_.field);
    if (size != 3) failAt(where_, "needs three numbers, not " + std::to_string(size));
    for (int axis = 0; axis < 3; ++axis) value[axis] = source_->GetRepeatedFloat(*source_.message, source_.field, axis);
    if (role == Role::Direction && context_.anyLength) value = unitVector(value, where_);
}

void FieldReader::read(uint32_t& value, Role role) const {
    if (!isSet()) return;
    if (role != Role::Texture && role != Role::Material) {
        value = source_->GetUInt32(*source_.message, source_.field);
        return;
    }
    const Lookup& lookup = role == Role::Texture ? context_.textures : context_.materials;
    if (lookup) value = lookup(source_->GetString(*source_.message, source_.field), where_);
}

void FieldReader::read(bool& value, Role role) const {
    if (isSet()) value = source_->GetBool(*source_.message, source_.field) != (role == Role::Opposite);
}

void FieldReader::read(std::string& value, Role) const {
    if (isSet()) value = source_->GetString(*source_.message, source_.field);
}

int FieldReader::enumerator() const {
    const int number = source_->GetEnumValue(*source_.message, source_.field);
    if (!source_.field->enum_type()->FindValueByNumber(number)) failAt(where_, "is unknown");
    return number;
}

void FieldReader::readArray(std::vector<uint8_t>& bytes) const {
    if (!isSet()) return;
    std::string copy;
    const std::string& text = source_->GetStringReference(*source_.message, source_.field, &copy);
    bytes.assign(text.begin(), text.end());
}

void FieldReader::readArray(std::vector<std::string>& texts) const {
    for (int i = 0; isSet() && i < source_->FieldSize(*source_.message, source_.field); ++i)
        texts.push_back(source_->GetRepeatedString(*source_.message, source_.field, i));
}

template <class T>
void FieldReader::readArray(std::vector<T>& values) const {
    if (!isSet()) return;
    const auto list = source_->GetRepeatedFieldRef<typename ComponentOf<T>::Type>(*source_.message, source_.field);
    if (list.size() % components<T> != 0)
        failAt(where_, components<T> == 2   ? "must come in pairs"
                       : components<T> == 3 ? "must come in threes"
                                            : "must come in fours");
    values.clear();
    values.reserve(size_t(list.size() / components<T>));
    for (auto next = list.begin(); next != list.end();) {
        T& value = values.emplace_back();
        for (int i = 0; i < components<T>; ++i, ++next) value[i] = *next;
    }
}

template void FieldWriter::writeArray(const std::vector<Vec3f>&) const;
template void FieldWriter::writeArray(const std::vector<std::array<float, 2>>&) const;
template void FieldWriter::writeArray(const std::vector<std::array<float, 4>>&) const;
template void FieldWriter::writeArray(const std::vector<std::array<uint32_t, 3>>&) const;
template void FieldReader::readArray(std::vector<Vec3f>&) const;
template void FieldReader::readArray(std::vector<std::array<float, 2>>&) const;
template void FieldReader::readArray(std::vector<std::array<float, 4>>&) const;
template void FieldReader::readArray(std::vector<std::array<uint32_t, 3>>&) const;

}  // namespace antipode
