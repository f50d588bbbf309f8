// SHA-256: the name of everything that is known by its content.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace antipode {

/// A digest that is fed piece by piece.
class Sha256 {
public:
    Sha256();
    ~Sha256();
    Sha256(Sha256&&) noexcept;
    Sha256& operator=(Sha256&&) noexcept;

    void add(std::string_view bytes);
    /// The values as they lie in memory, least significant byte first.
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void addValues(std::span<const T> values) {
        add({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
    }
    template <class T>
    requires std::is_arithmetic_v<T>
    void addValue(T value) { addValues(std::span<const T>(&value, 1)); }

    /// The digest of all that was added: 32 bytes. Once.
    std::string finish();

private:
    struct Context;
    std::unique_ptr<Context> context_;
};

/// 32 bytes.
std::string sha256Of(std::string_view bytes);

}  // namespace antipode
