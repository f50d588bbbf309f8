// Accessors: numbers in buffers, of every type, layout and sparseness that glTF has.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/gltf/document.h"

namespace antipode::gltf {

/// Elements of `components` numbers each, one after the other.
struct Values {
    size_t count = 0;
    int components = 0;
    std::vector<float> numbers;
};

/// What integers stand for that no `normalized` accompanies.
enum class Integers { Themselves, Fractions };

/// Throws Error(Input) unless every accessor lies within its view. One without a view holds zeros.
void checkAccessors(const Document& document);

/// The elements as floats: normalised integers become fractions of the greatest value, those of signed types not below
/// −1 (glTF 2.0, 3.11).
Values readFloats(const Document& document, size_t accessor, Integers integers = Integers::Themselves);

/// The same with a fixed number of components. Throws Error(Input) where the accessor has another.
Values readFloats(const Document& document, size_t accessor, int components);

/// What normalised integers of a component type are divided by. Throws Error(Input) where the type is none of integers.
float greatestOf(uint64_t componentType);

/// Integers, of all components one after the other. Throws Error(Input) where the accessor holds floats or signed ones.
std::vector<uint32_t> readIntegers(const Document& document, size_t accessor);

}  // namespace antipode::gltf
