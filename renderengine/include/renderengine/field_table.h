// Tables of fields: what the members of a struct are called and mean, said once. Hashes, messages, checks and moves
// walk the table, so that none of them can forget a member.
#pragma once

#include <cstddef>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace antipode {

/// Chooses a table: that of S is what fieldsOf(Of<S>{}) returns, a std::tuple of Field in the order of declaration.
template <class S>
struct Of {};

template <class S>
concept HasFields = requires {
    fieldsOf(Of<S>{});
};

/// A row. The role is part of the type, so that a walk compiles only what it does with that role.
template <auto fieldRole, class S, class V, class Range>
struct Field {
    static constexpr auto role = fieldRole;
    const char* name;  ///< in the schema or the message
    V S::*member;
    Range range;
};

/// Stands for a member of any type where nothing is evaluated.
struct AnyMember {
    template <class T>
    operator T() const;
};

template <class S, class... Members>
constexpr size_t memberCount() {
    if constexpr (requires { S{Members{}..., AnyMember{}}; })
        return memberCount<S, Members..., AnyMember>();
    else
        return sizeof...(Members);
}

/// Calls visit(field, value) for every member. A struct with a member that has no row does not compile.
template <class S, class Visit>
void forEachField(S& object, const Visit& visit) {
    using Struct = std::remove_const_t<S>;
    constexpr auto fields = fieldsOf(Of<Struct>{});
    static_assert(std::tuple_size_v<decltype(fields)> == memberCount<Struct>(),
                  "a member has no row in its struct's table");
    std::apply([&](auto... field) { (visit(field, object.*(field.member)), ...); }, fields);
}

template <class V>
struct EntryOf {
    using Type = V;
};
template <class V>
struct EntryOf<std::vector<V>> {
    using Type = V;
};
template <class V>
struct EntryOf<std::optional<V>> {
    using Type = V;
};
/// What a list or an optional holds; of another type the type itself.
template <class V>
using Entry = typename EntryOf<std::remove_cvref_t<V>>::Type;

template <class V>
constexpr bool isList = false;
template <class V>
constexpr bool isList<std::vector<V>> = true;
template <class V>
constexpr bool isOptional = false;
template <class V>
constexpr bool isOptional<std::optional<V>> = true;

/// Calls visit for each entry of a list, for what an optional holds, or for the value itself.
template <class V, class Visit>
void forEachEntry(V& value, const Visit& visit) {
    if constexpr (isList<std::remove_const_t<V>>) {
        for (auto& entry : value) visit(entry);
    } else if constexpr (isOptional<std::remove_const_t<V>>) {
        if (value) visit(*value);
    } else {
        visit(value);
    }
}

/// Calls visit for every entry of that role in the object and in its parts, the structs that have tables themselves.
template <auto role, class S, class Visit>
void forEach(S& object, const Visit& visit) {
    forEachField(object, [&](auto field, auto& value) {
        if constexpr (field.role == role)
            forEachEntry(value, visit);
        else if constexpr (HasFields<Entry<decltype(value)>>)
            forEachEntry(value, [&](auto& part) { forEach<role>(part, visit); });
    });
}

}  // namespace antipode
