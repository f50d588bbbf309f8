// Photometric lamps: candela and lux as W/sr and W/m².
#pragma once

#include <string>

#include "renderengine/import_options.h"

namespace antipode {

/// What the lamps of a glTF file are to be multiplied by: 1, or 1/683 where they are photometric. The format says that
/// they are, and most programs write what their user typed.
///
/// Blender's exporter ("Khronos glTF Blender I/O") multiplies watts by 683 unless its user chose another unit, of which
/// the file says nothing. So its lamps count as photometric where a sun exceeds 60 or another lamp 200, which in
/// radiant units would be suns of 60 W/m² and lamps of 2.5 kW, and in photometric ones are suns of 0.09 W/m² and lamps
/// of 4 W.
float wattsPerLumen(LampUnits units, const std::string& generator, const Scene& lamps);

}  // namespace antipode
