// The scene's structs to and from the schema's messages, field by field along the tables in scene/scene_fields.h.
#pragma once

#include <google/protobuf/message.h>
#include <google/protobuf/reflection.h>

#include <functional>
#include <optional>
#include <string>

#include "proto/scene_translation.h"
#include "scene/scene_fields.h"

namespace antipode {

/// Finds the index of a texture or material by its reference in the schema; throws Error(Input) where there is none.
using Lookup = std::function<uint32_t(const std::string& reference, const std::string& where)>;

/// What reading takes beside the message.
struct ReadContext {
    Lookup textures{}, materials{};  ///< references without a lookup are left to the caller
    bool anyLength = false;          ///< directions may have any length, and get unit length
};

/// A field of a message by its name in the schema; "map.width" is a field of the message "map" within.
template <class Message>
struct SchemaField {
    Message* message;  ///< that holds it; null where the message within is not there
    const google::protobuf::FieldDescriptor* field;

    const google::protobuf::Reflection* operator->() const { return message->GetReflection(); }
};

/// Writes a value by its type and role.
class FieldWriter {
public:
    FieldWriter(google::protobuf::Message& message, const char* name) : message_(message), name_(name) {}

    void write(float value, Role role) const;
    void write(const Vec3f& value, Role role) const;
    void write(uint32_t value, Role role) const;
    void write(bool value, Role role) const;
    /// Adds it where the field is a list.
    void write(const std::string& value, Role role) const;
    template <class E>
    requires std::is_enum_v<E>
    void write(E value, Role) const { writeEnumerator(int(value)); }
    void writeArray(const std::vector<uint8_t>& bytes) const;
    /// Of vectors, pairs or triples.
    template <class T>
    void writeArray(const std::vector<T>& values) const;
    /// The message that is the field's value, or a new entry of its list.
    google::protobuf::Message& part() const;

private:
    SchemaField<google::protobuf::Message> target() const;
    void writeEnumerator(int value) const;

    google::protobuf::Message& message_;
    const char* name_;
};

/// Reads what the message says, and leaves alone what it does not. Throws Error(Input): "`where`: name what".
class FieldReader {
public:
    FieldReader(const google::protobuf::Message& message, const char* name, const std::string& where,
                const ReadContext& context);

    /// Throws unless the message says something, whatever it is.
    void needs() const;
    void read(float& value, Role role) const;
    void read(Vec3f& value, Role role) const;
    void read(uint32_t& value, Role role) const;
    void read(bool& value, Role role) const;
    void read(std::string& value, Role role) const;
    template <class E>
    requires std::is_enum_v<E>
    void read(E& value, Role) const {
        if (isSet()) value = E(enumerator());
    }
    template <class T>
    void read(std::optional<T>& value, Role role) const {
        if (isGiven(role)) read(value.emplace(), role);
    }
    void readArray(std::vector<uint8_t>& bytes) const;
    void readArray(std::vector<std::string>& texts) const;
    template <class T>
    void readArray(std::vector<T>& values) const;

private:
    /// The message says something: always, where the schema has no way to say nothing.
    bool isSet() const;
    /// Likewise, but for an empty reference, which says nothing.
    bool isGiven(Role role) const;
    int enumerator() const;

    SchemaField<const google::protobuf::Message> source_;
    std::string where_;
    const ReadContext& context_;
};

/// Every field of the object and of its parts, so that reading it gives the same bit for bit.
template <class S>
void writeFields(const S& object, Arrays arrays, google::protobuf::Message& out) {
    forEachField(object, [&](auto field, const auto& value) {
        constexpr Role role = field.role;
        using Value = std::remove_cvref_t<decltype(value)>;
        const FieldWriter writer(out, field.name);
        if constexpr (HasFields<Entry<Value>>) {
            forEachEntry(value, [&](const auto& part) { writeFields(part, arrays, writer.part()); });
        } else if constexpr (isList<Value> && role != Role::Name) {
            if (arrays == Arrays::Included) writer.writeArray(value);
        } else {
            forEachEntry(value, [&](const auto& entry) { writer.write(entry, role); });
        }
    });
}

/// The object's own fields; its parts are left to the caller.
template <class S>
void readFields(const google::protobuf::Message& from, const std::string& where, const ReadContext& context,
                S& object) {
    forEachField(object, [&](auto field, auto& value) {
        constexpr Role role = field.role;
        using Value = std::remove_cvref_t<decltype(value)>;
        if constexpr (!HasFields<Entry<Value>>) {
            const FieldReader reader(from, field.name, where, context);
            if (field.range.needed) reader.needs();
            if constexpr (isList<Value>)
                reader.readArray(value);
            else
                reader.read(value, role);
        }
    });
}

/// Appends an object for each message of the list `name`; the fourth sphere is at "sphere #3".
template <class S>
void readList(const google::protobuf::Message& from, const char* name, const ReadContext& context,
              std::vector<S>& objects) {
    const google::protobuf::FieldDescriptor* list = from.GetDescriptor()->FindFieldByName(name);
    for (int i = 0; i < from.GetReflection()->FieldSize(from, list); ++i)
        readFields(from.GetReflection()->GetRepeatedMessage(from, list, i),
                   std::string(name) + " #" + std::to_string(i), context, objects.emplace_back());
}

}  // namespace antipode
