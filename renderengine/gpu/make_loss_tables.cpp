// Prints loss_values.h, the numbers of loss_tables.cpp and layer_tables.cpp. Run by the build.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <vector>

#include "gpu/loss_axes.h"
#include "gpu/microfacet_loss.h"
#include "gpu/sheen_albedo.h"
#include "kernels/shared/layout.h"

namespace antipode {
namespace {

constexpr int columns = int(shared::LOSS_COSINES);
/// Row after row of roughness.
using Table = std::vector<std::vector<double>>;

Table tabulate(uint32_t rows, const std::function<double(double cosine, double alpha)>& loss) {
    Table table;
    for (uint32_t i = 0; i < rows; ++i) {
        // In the columns the first row, of smooth facets, has a limit.
        const double roughness = std::max(double(i) / (rows - 1), 0.01), alpha = roughness * roughness;
        std::vector<double>& row = table.emplace_back();
        for (int j = 0; j < columns; ++j) {
            const double cosine = std::max(cosineOfLossColumn(double(j) / (columns - 1), alpha), 1e-7);
            row.push_back(loss(cosine, alpha));
        }
    }
    return table;
}

/// 2∫L μ dμ of what is interpolated, so that the diffuse lobe gives back what the table says is lost. Even steps in √μ.
double meanLoss(const Table& table, double roughness) {
    constexpr int steps = 4000;
    const double alpha = roughness * roughness, row = roughness * double(table.size() - 1);
    const auto i = std::min(size_t(row), table.size() - 2);
    const auto value = [&](size_t j) { return std::lerp(table[i][j], table[i + 1][j], row - double(i)); };
    double sum = 0;
    for (int k = 0; k < steps; ++k) {
        const double root = (k + 0.5) / steps, cosine = root * root, column = lossColumn(cosine, alpha) * (columns - 1);
        const auto j = size_t(std::min(int(column), columns - 2));
        sum += 4 * root * cosine * std::lerp(value(j), value(j + 1), column - double(j));
    }
    return sum / steps;
}

void print(const std::vector<double>& values) {
    std::printf("{");
    for (const double value : values) std::printf("%.6ef, ", value);
    std::printf("}");
}

void print(const Table& table) {
    std::printf("{");
    for (const auto& row : table) {
        print(row);
        std::printf(",\n");
    }
    std::printf("}");
}

/// The means over α, which changes slowly; of smooth surfaces at closer steps.
std::vector<double> relativeMeans(const Table& table, uint32_t means) {
    std::vector<double> relative;
    for (uint32_t k = 0; k < means; ++k) {
        const double roughness = std::pow(std::max(k, 1u) / double(means - 1), 2);
        relative.push_back(meanLoss(table, roughness) / (roughness * roughness));
    }
    return relative;
}

void printMetal() {
    const Table table = tabulate(shared::LOSS_ROUGHNESSES, metalLoss);
    std::printf("constexpr float kMetalLosses[LOSS_ROUGHNESSES][LOSS_COSINES] = ");
    print(table);
    std::printf(";\nconstexpr float kMetalMeanLosses[LOSS_MEANS] = ");
    print(relativeMeans(table, shared::LOSS_MEANS));
    std::printf(";\n");
}

/// From outside, then from inside, for each index.
void printGlass() {
    constexpr double greatestIndex = 0.98;  // nothing refracts more
    Table means;
    std::printf("constexpr float kGlassLosses[2][GLASS_LOSS_INDICES][GLASS_LOSS_ROUGHNESSES][LOSS_COSINES] = {\n");
    for (const bool inside : {false, true}) {
        std::printf("{");
        for (uint32_t k = 0; k < shared::GLASS_LOSS_INDICES; ++k) {
            const double eta = etaOfLossIndex(std::min(k / (shared::GLASS_LOSS_INDICES - 1.0), greatestIndex));
            const Table table = tabulate(shared::GLASS_LOSS_ROUGHNESSES, [&](double cosine, double alpha) {
                return glassLoss(cosine, alpha, inside ? 1 / eta : eta);
            });
            print(table);
            std::printf(",\n");
            means.push_back(relativeMeans(table, shared::GLASS_LOSS_MEANS));
        }
        std::printf("},\n");
    }
    std::printf("};\nconstexpr float kGlassMeanLosses[2 * GLASS_LOSS_INDICES][GLASS_LOSS_MEANS] = ");
    print(means);
    std::printf(";\n");
}

/// Over even steps of roughness from `least` to 1, and of the cosine's root.
Table tabulateAlbedos(double least, const std::function<double(double cosine, double alpha)>& albedo) {
    Table table;
    for (uint32_t i = 0; i < shared::ALBEDO_ROUGHNESSES; ++i) {
        const double roughness = std::lerp(least, 1.0, i / (shared::ALBEDO_ROUGHNESSES - 1.0));
        std::vector<double>& row = table.emplace_back();
        for (uint32_t j = 0; j < shared::ALBEDO_COSINES; ++j) {
            const double root = j / (shared::ALBEDO_COSINES - 1.0);
            row.push_back(albedo(std::max(root * root, 1e-7), roughness * roughness));
        }
    }
    return table;
}

/// 2∫E(μ) (1 − μ)^power μ dμ of each row as it is interpolated.
std::vector<double> meanAlbedos(const Table& table, int power) {
    constexpr int steps = 6300;
    std::vector<double> means;
    for (const std::vector<double>& row : table) {
        double sum = 0;
        for (int k = 0; k < steps; ++k) {
            const double root = (k + 0.5) / steps, cosine = root * root, column = root * double(row.size() - 1);
            const auto j = std::min(size_t(column), row.size() - 2);
            sum += 4 * root * cosine * std::pow(1 - cosine, power) * std::lerp(row[j], row[j + 1], column - double(j));
        }
        means.push_back(sum / steps);
    }
    return means;
}

void printLayers() {
    const Table coat = tabulateAlbedos(0, [](double cosine, double alpha) {
        return coatAlbedo(cosine, std::max(alpha, 2.5e-4));  // as smooth as the kernels' coats
    });
    std::printf("constexpr float kCoatAlbedos[ALBEDO_ROUGHNESSES][ALBEDO_COSINES] = ");
    print(coat);
    std::printf(";\nconstexpr float kCoatMeanAlbedos[ALBEDO_ROUGHNESSES] = ");
    print(meanAlbedos(coat, 0));
    std::printf(";\nconstexpr float kCoatSchlickMeans[ALBEDO_ROUGHNESSES] = ");
    print(meanAlbedos(coat, 5));
    std::printf(";\nconstexpr float kSheenAlbedos[ALBEDO_ROUGHNESSES][ALBEDO_COSINES] = ");
    print(tabulateAlbedos(shared::SHEEN_LEAST_PERCENT / 100.0, sheenAlbedo));
    std::printf(";\n");
}

}  // namespace
}  // namespace antipode

int main() {
    using namespace antipode;
    std::printf("#pragma once\n#include \"kernels/shared/layout.h\"\nnamespace antipode {\nusing namespace shared;\n");
    printMetal();
    printGlass();
    printLayers();
    std::printf("}\n");
}
