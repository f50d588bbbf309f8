#include "proto/field_path.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "renderengine/error.h"
#include "renderengine/io/suggest.h"

namespace antipode {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

std::vector<std::string> fieldNames(const Descriptor& type) {
    std::vector<std::string> names;
    names.reserve(size_t(type.field_count()));
    for (int i = 0; i < type.field_count(); ++i) names.push_back(type.field(i)->name());
    return names;
}

std::vector<std::string> enumeratorNames(const FieldDescriptor& field) {
    std::vector<std::string> names;
    names.reserve(size_t(field.enum_type()->value_count()));
    for (int i = 0; i < field.enum_type()->value_count(); ++i) names.push_back(field.enum_type()->value(i)->name());
    return names;
}

/// What the field takes, in words.
std::string takes(const FieldDescriptor& field) {
    switch (field.cpp_type()) {
        case FieldDescriptor::CPPTYPE_FLOAT:
        case FieldDescriptor::CPPTYPE_DOUBLE: return field.is_repeated() ? "numbers, parted by commas" : "a number";
        case FieldDescriptor::CPPTYPE_BOOL: return "true or false";
        case FieldDescriptor::CPPTYPE_ENUM: return "one of " + joined(enumeratorNames(field));
        case FieldDescriptor::CPPTYPE_STRING: return "text";
        case FieldDescriptor::CPPTYPE_MESSAGE: return "one of its fields: " + joined(fieldNames(*field.message_type()));
        default: return field.is_repeated() ? "whole numbers, parted by commas" : "a whole number";
    }
}

template <class T>
std::optional<T> parsed(std::string_view text) {
    T number{};
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (text.empty() || error != std::errc() || end != text.data() + text.size()) return {};
    return number;
}

/// Of a list each value between commas, of a single field the whole text.
std::vector<std::string_view> valuesOf(const FieldDescriptor& field, std::string_view text) {
    if (!field.is_repeated()) return {text};
    std::vector<std::string_view> values;
    for (size_t begin = 0; begin <= text.size();) {
        const size_t end = std::min(text.find(',', begin), text.size());
        values.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return values;
}

/// Which field of the same message says the same in another way; null for most.
const char* excludedBy(std::string_view name, const Descriptor& type) {
    constexpr std::pair<const char*, const char*> pairs[] = {{"look_at", "forward"},
                                                             {"focal_length", "vertical_fov"},
                                                             {"f_stop", "lens_radius"},
                                                             {"file", "map"},
                                                             {"file", "texels"}};
    for (const auto& [a, b] : pairs) {
        if (name == a && type.FindFieldByName(b)) return b;
        if (name == b && type.FindFieldByName(a)) return a;
    }
    return nullptr;
}

class FieldSetter {
public:
    FieldSetter(const std::string& path, const std::string& value, Missing missing)
        : path_(path), value_(value), missing_(missing) {}

    bool set(Message& root) { return descend(root, path_, true); }

private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorCode::Usage, "--set " + path_ + " " + what);
    }

    bool descend(Message& message, std::string_view rest, bool atTop) {
        const Descriptor& type = *message.GetDescriptor();
        const std::string name(rest.substr(0, rest.find_first_of(".[")));
        const FieldDescriptor* field = type.FindFieldByName(name);
        if (!field) failUnknown(type, name);
        rest.remove_prefix(name.size());
        if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) {
            if (!rest.empty()) fail("goes on after '" + name + "', which takes " + takes(*field) + ".");
            assign(message, *field);
            return true;
        }
        if (rest.empty() || rest == ".") fail("is not one value: name " + takes(*field) + ".");
        return field->is_repeated() ? descendList(message, *field, rest, atTop)
                                    : descendPart(message, *field, rest, atTop);
    }

    bool descendPart(Message& message, const FieldDescriptor& field, std::string_view rest, bool atTop) {
        const Reflection& reflection = *message.GetReflection();
        if (rest.front() == '[') fail("takes no number after '" + field.name() + "', of which there is one.");
        if (atTop && missing_ == Missing::Skipped && !reflection.HasField(message, &field)) return false;
        return descend(*reflection.MutableMessage(&message, &field), rest.substr(1), false);
    }

    bool descendList(Message& message, const FieldDescriptor& field, std::string_view rest, bool atTop) {
        const Reflection& reflection = *message.GetReflection();
        const int size = reflection.FieldSize(message, &field);
        const bool skips = atTop && missing_ == Missing::Skipped;
        const auto entry = [&](int i) -> Message& { return *reflection.MutableRepeatedMessage(&message, &field, i); };
        if (rest.front() == '[') {
            const size_t close = rest.find(']');
            const auto index = parsed<uint32_t>(rest.substr(1, close == rest.npos ? close : close - 1));
            if (!index || close == rest.npos || close + 1 >= rest.size() || rest[close + 1] != '.')
                fail("needs a number from 0 in brackets and a field after it, as in " + field.name() + "[0].name.");
            rest.remove_prefix(close + 2);
            // The entry after the last is a new one.
            if (int64_t(*index) == size && !(skips && size == 0))
                return descend(*reflection.AddMessage(&message, &field), rest, false);
            if (int64_t(*index) > size || size == 0) {
                if (skips) return false;
                fail("is of " + field.name() + " #" + std::to_string(*index) + ", but there are " +
                     std::to_string(size) + ", counted from 0.");
            }
            return descend(entry(int(*index)), rest, false);
        }
        rest.remove_prefix(1);
        if (rest.starts_with("*.")) {
            for (int i = 0; i < size; ++i) descend(entry(i), rest.substr(2), false);
            if (size == 0 && !skips) fail("is of every " + field.name() + ", but there is none.");
            return size > 0;
        }
        const std::vector<std::string> names = entryNames(message, field);
        int named = -1;  // the longest name that the path goes on with, since names may have points
        for (int i = 0; i < size; ++i) {
            const std::string& name = names[size_t(i)];
            const bool matches = !name.empty() && rest.starts_with(name + ".");
            if (matches && (named < 0 || name.size() > names[size_t(named)].size())) named = i;
        }
        if (named >= 0) return descend(entry(named), rest.substr(names[size_t(named)].size() + 1), false);
        const std::string head(rest.substr(0, rest.find_first_of(".[")));
        if (size == 1 && field.message_type()->FindFieldByName(head)) return descend(entry(0), rest, false);
        if (skips) return false;
        failUnknownEntry(field, std::string(rest.substr(0, std::min(rest.rfind('.'), rest.size()))), names);
    }

    static std::vector<std::string> entryNames(const Message& message, const FieldDescriptor& field) {
        const FieldDescriptor* name = field.message_type()->FindFieldByName("name");
        const Reflection& reflection = *message.GetReflection();
        std::vector<std::string> names;
        for (int i = 0; i < reflection.FieldSize(message, &field); ++i) {
            const Message& entry = reflection.GetRepeatedMessage(message, &field, i);
            names.push_back(name ? entry.GetReflection()->GetString(entry, name) : "");
        }
        return names;
    }

    [[noreturn]] void failUnknown(const Descriptor& type, const std::string& name) const {
        const std::vector<std::string> names = fieldNames(type);
        const std::string nearest = nearestName(name, names);
        fail("names no field: a " + type.name() + " has no '" + name + "'." +
             (nearest.empty()
                  ? " It has " + joined(names) + "."
                  : " Did you mean '" + nearest + "', which takes " + takes(*type.FindFieldByName(nearest)) + "?"));
    }

    [[noreturn]] void failUnknownEntry(const FieldDescriptor& field, const std::string& name,
                                       std::vector<std::string> names) const {
        constexpr size_t mostNames = 24;
        const std::string nearest = nearestName(name, names);
        std::string known = " There is none.";
        if (!names.empty()) {
            std::erase(names, "");
            const bool cut = names.size() > mostNames;
            names.resize(std::min(names.size(), mostNames));
            known = names.empty() ? " They have no names: say " + field.name() + "[0] for the first."
                                  : " There are " + joined(names) + (cut ? " …" : "") + ".";
        }
        fail("finds no " + field.name() + " '" + name + "'." +
             (nearest.empty() ? known : " Did you mean '" + nearest + "'?"));
    }

    void assign(Message& message, const FieldDescriptor& field) {
        const Reflection& reflection = *message.GetReflection();
        if (const char* other = excludedBy(field.name(), *message.GetDescriptor()))
            reflection.ClearField(&message, message.GetDescriptor()->FindFieldByName(other));
        reflection.ClearField(&message, &field);
        for (std::string_view value : valuesOf(field, value_))
            if (!assignOne(message, field, value)) fail("takes " + takes(field) + ", not '" + value_ + "'.");
    }

    /// False where the value is not of the field's type.
    static bool assignOne(Message& message, const FieldDescriptor& field, std::string_view value) {
        const Reflection& reflection = *message.GetReflection();
        const auto put = [&](const auto& v, auto set, auto add) {
            if (!v) return false;
            if (field.is_repeated())
                (reflection.*add)(&message, &field, *v);
            else
                (reflection.*set)(&message, &field, *v);
            return true;
        };
        switch (field.cpp_type()) {
            case FieldDescriptor::CPPTYPE_FLOAT:
                return put(parsed<float>(value), &Reflection::SetFloat, &Reflection::AddFloat);
            case FieldDescriptor::CPPTYPE_DOUBLE:
                return put(parsed<double>(value), &Reflection::SetDouble, &Reflection::AddDouble);
            case FieldDescriptor::CPPTYPE_UINT32:
                return put(parsed<uint32_t>(value), &Reflection::SetUInt32, &Reflection::AddUInt32);
            case FieldDescriptor::CPPTYPE_BOOL:
                if (value != "true" && value != "false") return false;
                return put(std::optional(value == "true"), &Reflection::SetBool, &Reflection::AddBool);
            case FieldDescriptor::CPPTYPE_ENUM: {
                const auto* enumerator = field.enum_type()->FindValueByName(std::string(value));
                return put(enumerator ? std::optional(enumerator->number()) : std::nullopt, &Reflection::SetEnumValue,
                           &Reflection::AddEnumValue);
            }
            case FieldDescriptor::CPPTYPE_STRING: {
                if (field.type() == FieldDescriptor::TYPE_BYTES) return false;
                const bool isFile = field.name() == "file" && !value.empty();
                const std::string text = isFile ? std::filesystem::absolute(value).string() : std::string(value);
                return put(std::optional(text), &Reflection::SetString, &Reflection::AddString);
            }
            default: return false;
        }
    }

    const std::string& path_;
    const std::string& value_;
    Missing missing_;
};

}  // namespace

bool setField(Message& root, const std::string& path, const std::string& value, Missing missing) {
    return FieldSetter(path, value, missing).set(root);
}

}  // namespace antipode
