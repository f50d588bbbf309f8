// Linear interpolation between the nodes of a table, as lib/losses.glsl does it, and how tables are packed for it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "kernels/shared/layout.h"

namespace antipode {

/// Two nodes of an axis, and where between them a position in [0,1] lies.
struct Between {
    Between(double position, uint32_t nodes) {
        const double at = position * (nodes - 1);
        first = std::min(uint32_t(at), nodes - 2);
        rest = at - first;
    }
    uint32_t first;
    double rest;
};

inline double mix(double a, double b, double t) { return a + (b - a) * t; }

/// Of each cell of the table its four corners.
template <size_t Rows, size_t Columns>
void packCells(const float (&table)[Rows][Columns], std::vector<shared::vec4>& texels) {
    for (size_t i = 0; i + 1 < Rows; ++i)
        for (size_t j = 0; j + 1 < Columns; ++j)
            texels.push_back({table[i][j], table[i][j + 1], table[i + 1][j], table[i + 1][j + 1]});
}

/// At positions in [0,1] along the columns and the rows.
template <size_t Rows, size_t Columns>
double lookUpCells(const float (&table)[Rows][Columns], double column, double row) {
    const Between y(row, Rows), x(column, Columns);
    const auto inRow = [&](uint32_t i) {
        const float* values = table[y.first + i];
        return mix(double(values[x.first]), double(values[x.first + 1]), x.rest);
    };
    return mix(inRow(0), inRow(1), y.rest);
}

template <size_t Nodes>
double lookUpNodes(const float (&values)[Nodes], double position) {
    const Between node(position, Nodes);
    return mix(double(values[node.first]), double(values[node.first + 1]), node.rest);
}

}  // namespace antipode
