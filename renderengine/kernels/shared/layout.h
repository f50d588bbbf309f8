// Structures, binding numbers and constants that host and kernels share. Compiles as C++20 and as GLSL 4.60, where
// lib/real.glsl says what `real` is; on the host the structures that hold reals are templates.
#ifndef ANTIPODE_SHARED_LAYOUT_H
#define ANTIPODE_SHARED_LAYOUT_H

#ifdef __cplusplus
#include <cstdint>
namespace antipode::shared {
using uint = uint32_t;
template <class Real>
struct alignas(4 * sizeof(Real)) Real4 {
    Real x = 0, y = 0, z = 0, w = 0;
};
using vec4 = Real4<float>;
struct alignas(16) uvec4 {
    uint x = 0, y = 0, z = 0, w = 0;
};
#define ANTIPODE_CONST constexpr uint
#define ANTIPODE_OF_REAL template <class Real>
#define ANTIPODE_REAL Real
#define ANTIPODE_REAL4 Real4<Real>
#else
#define ANTIPODE_CONST const uint
#define ANTIPODE_OF_REAL
#define ANTIPODE_REAL real
#define ANTIPODE_REAL4 real4
#endif

// ---- Bindings (set 0) ------------------------------------------------------------------------------------------
ANTIPODE_CONST BIND_JOB = 0;                // storage: JobParameters
ANTIPODE_CONST BIND_NODES = 1;              // texel rgba32ui: BVH4 nodes, 7 texels each
ANTIPODE_CONST BIND_PRIMITIVES = 2;         // texel rgba32ui: 3 texels each, BVH leaf order
ANTIPODE_CONST BIND_ATTRIBUTES = 3;         // texel rgba32ui: 4 texels a primitive: normals and uvs
ANTIPODE_CONST BIND_MATERIALS = 4;          // texel rgba32ui: MATERIAL_TEXELS each
ANTIPODE_CONST BIND_LIGHTS = 5;             // texel rgba32ui: LIGHT_TEXELS each
ANTIPODE_CONST BIND_TEXTURE_INFO = 6;       // texel rgba32ui: offset, width, height, TEXTURE_*
ANTIPODE_CONST BIND_TEXELS = 7;             // texel rgba16f: all textures, linear
ANTIPODE_CONST BIND_ENVIRONMENT_MAP = 8;    // texel rgba32f: radiance, w = solid-angle pdf of the texel
ANTIPODE_CONST BIND_ENVIRONMENT_ALIAS = 9;  // texel rgba32ui: threshold bits, alias, 0, 0
ANTIPODE_CONST BIND_PATHS = 10;             // records: PATH_RECORDS each, see lib/state.glsl
ANTIPODE_CONST BIND_PATHS_OUT = 11;         // storage Record[]: the same memory; reads go through texels, the fast way
ANTIPODE_CONST BIND_HITS = 12;              // records: t, b1, b2, primitive
ANTIPODE_CONST BIND_HITS_OUT = 13;
ANTIPODE_CONST BIND_RADIANCE = 14;  // storage real4[]: radiance of the camera path so far
ANTIPODE_CONST BIND_SHADOW = 15;    // records: SHADOW_RECORDS a path: the segment and what it carries
ANTIPODE_CONST BIND_SHADOW_OUT = 16;
ANTIPODE_CONST BIND_QUEUES = 17;  // texel r32ui: path queues (2) and the shadow queue
ANTIPODE_CONST BIND_QUEUES_OUT = 33;
ANTIPODE_CONST BIND_COUNTERS = 18;       // storage uint[]: COUNTER_*
ANTIPODE_CONST BIND_SCAN = 19;           // storage uint[]: counts that become exclusive prefix sums
ANTIPODE_CONST BIND_SLOT_FLAGS = 20;     // storage uint[]: SLOT_* of every queue slot
ANTIPODE_CONST BIND_WAVE_VERTICES = 21;  // storage Record[VERTEX_RECORDS per slot]: light vertices of the current wave
ANTIPODE_CONST BIND_VERTEX_POSITIONS_OUT = 22;  // storage Record[]: light vertices in path order
ANTIPODE_CONST BIND_VERTEX_DATA_OUT = 23;       // storage Record[2 each]
ANTIPODE_CONST BIND_VERTEX_POSITIONS = 24;      // records: light vertices as connections and merges read them
ANTIPODE_CONST BIND_VERTEX_DATA = 25;           // records
ANTIPODE_CONST BIND_SORTED_POSITIONS_OUT = 26;  // storage Record[]: light vertices in cell order
ANTIPODE_CONST BIND_SORTED_DATA_OUT = 27;       // storage Record[2 each]
ANTIPODE_CONST BIND_SORT_KEYS = 28;             // storage uvec2[]: (cell bucket, vertex), two halves
ANTIPODE_CONST BIND_CELLS_OUT = 29;             // storage uvec2[]: first and end vertex of every bucket
ANTIPODE_CONST BIND_CELLS = 30;                 // texel rg32ui: the same
ANTIPODE_CONST BIND_FILM_LOW = 31;    // storage uint[3 per pixel]: low words of the image's int64 sums, of the residue
                                      // class in hand
ANTIPODE_CONST BIND_FILM_HIGH = 34;   // storage uint[3 per pixel]: high words; apart, so that 4K can be bound
ANTIPODE_CONST BIND_LAYERS_LOW = 35;  // the same of the layers behind the image
ANTIPODE_CONST BIND_LAYERS_HIGH = 36;
ANTIPODE_CONST BIND_TECHNIQUE_RADIANCE = 37;  // storage real4[]: CAMERA_TECHNIQUES batches, as BIND_RADIANCE
ANTIPODE_CONST BIND_MEDIA = 38;               // storage uvec4[MEDIA_TEXELS a path]: with FEATURE_INTERFACES
ANTIPODE_CONST BIND_BODIES = 39;              // texel rgba32ui: one for each rank of a transparent body
ANTIPODE_CONST BIND_MORE_ATTRIBUTES = 40;  // texel rgba32ui: of a primitive: three of tangents with FEATURE_TANGENTS,
                                           // three of colours with FEATURE_VERTEX_COLORS, two for each further uv set
ANTIPODE_CONST BIND_LOSSES = 41;           // texel rgba32f: losses, and albedos of layers, of lobes that have them
ANTIPODE_CONST BIND_WAVELENGTH = 42;       // storage real4: with FEATURE_DISPERSION, see lib/wavelength.glsl
ANTIPODE_CONST BIND_COUNT = 43;

// ---- Specialisation constants ----------------------------------------------------------------------------------
ANTIPODE_CONST SPEC_FEATURES = 0;
ANTIPODE_CONST SPEC_TECHNIQUE = 1;
ANTIPODE_CONST SPEC_STACK_DEPTH = 2;
ANTIPODE_CONST SPEC_VARIANT = 3;  // meaning is the stage's own
ANTIPODE_CONST SPEC_GROUP_SIZE = 4;
ANTIPODE_CONST SPEC_LAYERS = 5;
ANTIPODE_CONST SPEC_LOBES = 6;

// Layers behind the image: the bits of renderengine/layers.h. Those of the camera path's techniques come first.
ANTIPODE_CONST LAYER_EMITTER_HIT = 1u << 0;
ANTIPODE_CONST LAYER_NEXT_EVENT = 1u << 1;
ANTIPODE_CONST LAYER_CONNECTION = 1u << 2;
ANTIPODE_CONST LAYER_MERGE = 1u << 3;
ANTIPODE_CONST LAYER_SPLAT = 1u << 4;
ANTIPODE_CONST LAYER_ALBEDO = 1u << 5;
ANTIPODE_CONST LAYER_NORMAL = 1u << 6;
ANTIPODE_CONST LAYER_DEPTH = 1u << 7;
ANTIPODE_CONST LAYER_POSITION = 1u << 8;
ANTIPODE_CONST LAYER_COVERAGE = 1u << 9;
ANTIPODE_CONST LAYER_BLUR = 1u << 10;
ANTIPODE_CONST CAMERA_TECHNIQUES = 4;
ANTIPODE_CONST LAYERS_OF_CAMERA_TECHNIQUES = LAYER_EMITTER_HIT | LAYER_NEXT_EVENT | LAYER_CONNECTION | LAYER_MERGE;
ANTIPODE_CONST LAYERS_GUIDES = LAYER_ALBEDO | LAYER_NORMAL | LAYER_DEPTH | LAYER_POSITION | LAYER_COVERAGE;
ANTIPODE_CONST LAYERS_OF_ONE_CHANNEL = LAYER_DEPTH | LAYER_COVERAGE | LAYER_BLUR;
ANTIPODE_CONST GUIDES_FIRST_HIT = 1u << 31;  // guides tell of the first surface, specular or not
// Guides without a unit of length count 2^-32.
ANTIPODE_CONST GUIDE_SCALE_EXPONENT = 32;
// The blur counts 2^-12 or, where the image does, more. That is little beside the 0.1 that relative errors are told
// against in the dark (√ε of relMSE), and its noise beyond would only make results longer.
ANTIPODE_CONST BLUR_SCALE_EXPONENT = 12;

// What the scene holds: code for what is absent is compiled away.
ANTIPODE_CONST FEATURE_TRIANGLES = 1u << 0;
ANTIPODE_CONST FEATURE_SPHERES = 1u << 1;
ANTIPODE_CONST FEATURE_ATTRIBUTES = 1u << 2;  // vertex normals or uvs
ANTIPODE_CONST FEATURE_TEXTURES = 1u << 3;
ANTIPODE_CONST FEATURE_NORMAL_MAPS = 1u << 4;
ANTIPODE_CONST FEATURE_ALPHA = 1u << 5;
ANTIPODE_CONST FEATURE_BLENDING = 1u << 6;  // with FEATURE_ALPHA
ANTIPODE_CONST FEATURE_NEAREST = 1u << 7;   // textures of which the nearest texel counts
ANTIPODE_CONST FEATURE_MORE_UVS = 1u << 8;  // textures that are looked up with further sets of texture coordinates
ANTIPODE_CONST FEATURE_VERTEX_COLORS = 1u << 9;
ANTIPODE_CONST FEATURE_TANGENTS = 1u << 10;
ANTIPODE_CONST FEATURE_INTERFACES = 1u << 11;  // transparent bodies touch: paths know what they are in
ANTIPODE_CONST FEATURE_ABSORPTION = 1u << 12;  // with FEATURE_INTERFACES
ANTIPODE_CONST FEATURE_LIGHT_TRIANGLES = 1u << 13;
ANTIPODE_CONST FEATURE_LIGHT_SPHERES = 1u << 14;
ANTIPODE_CONST FEATURE_LIGHT_POINTS = 1u << 15;
ANTIPODE_CONST FEATURE_LIGHT_SPOTS = 1u << 16;
ANTIPODE_CONST FEATURE_LIGHT_DIRECTIONALS = 1u << 17;
ANTIPODE_CONST FEATURE_ENVIRONMENT = 1u << 18;
ANTIPODE_CONST FEATURE_ENVIRONMENT_MAP = 1u << 19;
ANTIPODE_CONST FEATURE_LENS = 1u << 20;
ANTIPODE_CONST FEATURE_ORTHOGRAPHIC = 1u << 21;
ANTIPODE_CONST FEATURE_DISPERSION = 1u << 22;  // glass whose index depends on the wavelength
ANTIPODE_CONST FEATURE_CROP = 1u << 23;        // the film is a part of the frame
ANTIPODE_CONST FEATURE_SCATTERING = 1u << 24;  // with FEATURE_INTERFACES: media scatter light

// And what its materials are made of.
ANTIPODE_CONST LOBE_LAMBERT = 1u << 0;
ANTIPODE_CONST LOBE_PHONG = 1u << 1;
ANTIPODE_CONST LOBE_DIELECTRIC = 1u << 2;
ANTIPODE_CONST LOBE_CONDUCTOR = 1u << 3;  // rough or smooth, complex index
ANTIPODE_CONST LOBE_ROUGH_DIELECTRIC = 1u << 4;
ANTIPODE_CONST LOBE_METALLIC_ROUGHNESS = 1u << 5;
ANTIPODE_CONST LOBE_TRANSMISSION = 1u << 6;         // glass that is a pane, tinted, or a share of a surface
ANTIPODE_CONST LOBE_MULTIPLE_SCATTERING = 1u << 7;  // rough metal: what one facet sends to another
ANTIPODE_CONST LOBE_CLEARCOAT = 1u << 8;
ANTIPODE_CONST LOBE_SHEEN = 1u << 9;

// Which terms of the weighted sum are taken.
ANTIPODE_CONST TERM_HIT = 1u << 0;            // camera path meets an emitter
ANTIPODE_CONST TERM_NEXT_EVENT = 1u << 1;     // camera vertex to a sampled light point
ANTIPODE_CONST TERM_CONNECT = 1u << 2;        // camera vertex to a stored light vertex
ANTIPODE_CONST TERM_SPLAT = 1u << 3;          // light vertex to the camera
ANTIPODE_CONST TERM_MERGE = 1u << 4;          // camera vertex with the light vertices around it
ANTIPODE_CONST TERM_FIRST_DIFFUSE = 1u << 5;  // camera paths end at the first non-specular vertex, merges weigh 1
ANTIPODE_CONST TERM_SINGLE = 1u << 6;         // one (s,t) or merge alone, unweighted
ANTIPODE_CONST TERM_ROULETTE = 1u << 7;       // paths end by chance where little is left of them
ANTIPODE_CONST TERM_SOBOL = 1u << 8;          // vertices draw from scrambled nets, see lib/random.glsl

// ---- Material records ------------------------------------------------------------------------------------------
ANTIPODE_CONST MATERIAL_TEXELS = 7;
// 0: base colour, kind | flags    1: specular or mean reflectance of metal, exponent or GGX alpha    2: emission, ior
// 3: metallic, specular factor, alpha cut-off or coverage, n_F − n_C    4: textures: base, emission,
// metallic-roughness, normal    5: eta, or transmission, its texture, layers or 0; normal scale    6: k, diffuse
// selection probability

// Layers over KIND_METALLIC_ROUGHNESS lie behind the records of all materials, at the texel that the material names.
ANTIPODE_CONST LAYERS_TEXELS = 3;
// 0: clearcoat, its roughness, their textures    1: sheen's colour and roughness    2: their textures

ANTIPODE_CONST KIND_LAMBERT = 0;
ANTIPODE_CONST KIND_PHONG = 1;
ANTIPODE_CONST KIND_MIRROR = 2;
ANTIPODE_CONST KIND_DIELECTRIC = 3;
ANTIPODE_CONST KIND_CONDUCTOR = 4;  // smooth
ANTIPODE_CONST KIND_ROUGH_CONDUCTOR = 5;
ANTIPODE_CONST KIND_ROUGH_DIELECTRIC = 6;
ANTIPODE_CONST KIND_METALLIC_ROUGHNESS = 7;
ANTIPODE_CONST KIND_MASK = 0xFF;
ANTIPODE_CONST MATERIAL_TWO_SIDED = 1u << 8;
ANTIPODE_CONST MATERIAL_SPECULAR = 1u << 9;  // delta lobes only
ANTIPODE_CONST MATERIAL_BLACK = 1u << 10;    // reflects nothing
ANTIPODE_CONST MATERIAL_ALPHA = 1u << 11;
ANTIPODE_CONST MATERIAL_EMITS_BOTH_SIDES = 1u << 12;
ANTIPODE_CONST MATERIAL_TINTED = 1u << 13;  // the base colour is that of glass, too
ANTIPODE_CONST MATERIAL_THIN = 1u << 14;
ANTIPODE_CONST MATERIAL_BLENDS = 1u << 15;  // with MATERIAL_ALPHA
ANTIPODE_CONST NO_INDEX = 0xFFFFFFFFu;

// ---- Losses of single scattering, see gpu/loss_tables.h: nodes along the cosine and the roughness -----------------
ANTIPODE_CONST LOSS_COSINES = 32;
ANTIPODE_CONST LOSS_ROUGHNESSES = 32;
ANTIPODE_CONST LOSS_MEANS = 256;         // nodes of their means along the root of the roughness
ANTIPODE_CONST GLASS_LOSS_INDICES = 16;  // nodes along (n − 1)/(n + 1); that of 1.5 is one
ANTIPODE_CONST GLASS_LOSS_ROUGHNESSES = 16;
ANTIPODE_CONST GLASS_LOSS_MEANS = 128;

// ---- Albedos of layers, behind the losses, see gpu/layer_tables.h: nodes along √cosine and the roughness ----------
ANTIPODE_CONST ALBEDO_COSINES = 64;
ANTIPODE_CONST ALBEDO_ROUGHNESSES = 32;
ANTIPODE_CONST SHEEN_LEAST_PERCENT = 26;  // roughness below which sheen would give more than it gets

// ---- Texture records: the last word ---------------------------------------------------------------------------
ANTIPODE_CONST TEXTURE_WRAP_MASK = 0xFF;
ANTIPODE_CONST TEXTURE_WRAP_V_SHIFT = 8;
ANTIPODE_CONST TEXTURE_NEAREST = 1u << 16;
ANTIPODE_CONST TEXTURE_UV_SET_SHIFT = 24;

// ---- Primitive records: p0|material, p1|light, p2|PRIMITIVE_*; a sphere has centre, (radius,0,0) -----------------
ANTIPODE_CONST PRIMITIVE_TRIANGLE = 0;
ANTIPODE_CONST PRIMITIVE_SPHERE = 1;
// With FEATURE_INTERFACES the kind has the rank of the primitive's transparent body above it, 0 where it is opaque.
ANTIPODE_CONST PRIMITIVE_KIND_MASK = 0xFF;
ANTIPODE_CONST PRIMITIVE_RANK_SHIFT = 8;

// ---- Transparent bodies, by rank: where they overlap, the greatest is the medium (Schmidt and Budge 2002) ---------
// Index of refraction; index of the medium that bodies of that index share; index of refraction of the medium whose
// index is this rank; 1 where the body is closed. Rank 0 is what surrounds all, with the room that rays leave a surface
// by at the end of its record. With FEATURE_ABSORPTION, FEATURE_DISPERSION or FEATURE_SCATTERING as many texels follow:
// what a unit of length absorbs and scatters, and n_F − n_C of the medium whose index is this rank. With
// FEATURE_SCATTERING as many again: what a unit of length scatters, and the phase function's mean cosine.
ANTIPODE_CONST GREATEST_RANK = 0x7FFF;
ANTIPODE_CONST GREATEST_MEDIUM = 0xFF;
// Of a path: the ranks of all bodies that hold its ray's start, in halves of 16 bits; those beyond the interface that
// it met; the medium of its shadow ray.
ANTIPODE_CONST MEDIA_TEXELS = 3;
ANTIPODE_CONST RANK_OWED = 0x8000;  // of a body that was left before it was entered
// With FEATURE_SCATTERING: in place of a primitive, a point in the medium of the rank in the lower bits.
ANTIPODE_CONST MEDIUM_POINT = 0x80000000u;

// ---- Light records ---------------------------------------------------------------------------------------------
ANTIPODE_CONST LIGHT_TEXELS = 4;
// 0: kind; primitive (emitters) or inner versine (spots); material; pick probability q    1: position or direction,
// threshold 2: intensity, irradiance or radiance, alias    3: spot axis, outer versine Versine: 1 − cosine of a
// half-angle; the cosine of a narrow cone would round to 1. Threshold and alias are the light's entry in the alias
// table of the pick (Walker 1977, Vose 1991).
ANTIPODE_CONST LIGHT_TRIANGLE = 0;
ANTIPODE_CONST LIGHT_SPHERE = 1;
ANTIPODE_CONST LIGHT_POINT = 2;
ANTIPODE_CONST LIGHT_SPOT = 3;
ANTIPODE_CONST LIGHT_DIRECTIONAL = 4;
ANTIPODE_CONST LIGHT_ENVIRONMENT = 5;

// ---- Counters --------------------------------------------------------------------------------------------------
ANTIPODE_CONST COUNTER_QUEUE = 0;          // 2: live paths of the even and the odd queue
ANTIPODE_CONST COUNTER_GROUPS = 4;         // 4: indirect arguments for one invocation a live path
ANTIPODE_CONST COUNTER_CHUNK_GROUPS = 8;   // 4: indirect arguments for one invocation a chunk of slots
ANTIPODE_CONST COUNTER_VERTICES = 12;      // 2: light vertices before the current wave, and after it
ANTIPODE_CONST COUNTER_MAX_CELL = 14;      // most vertices in one bucket
ANTIPODE_CONST COUNTER_SHADOW_QUEUE = 16;  // MAX_SHADOW_QUEUES: live shadow rays of each
ANTIPODE_CONST MAX_CONNECTIONS = 16;
ANTIPODE_CONST MAX_SHADOW_QUEUES = MAX_CONNECTIONS + 1;
ANTIPODE_CONST COUNTER_RAYS = 36;             // since the host's last look, as all below
ANTIPODE_CONST COUNTER_SHADOW_RAYS = 37;      // of shadow queue 0: splats on light paths, next event on camera paths
ANTIPODE_CONST COUNTER_CONNECTION_RAYS = 38;  // of the other shadow queues
ANTIPODE_CONST COUNTER_EVENTS = 40;           // EVENT_KINDS for each source
// The enumerations of renderengine/events.h.
ANTIPODE_CONST EVENT_NON_FINITE = 0;
ANTIPODE_CONST EVENT_NEGATIVE = 1;
ANTIPODE_CONST EVENT_ZERO_PDF = 2;
ANTIPODE_CONST EVENT_SATURATED = 3;
ANTIPODE_CONST EVENT_LOOP_LIMIT = 4;
ANTIPODE_CONST EVENT_STACK_OVERFLOW = 5;
ANTIPODE_CONST EVENT_OVERFLOW = 6;
ANTIPODE_CONST EVENT_KINDS = 7;
ANTIPODE_CONST SOURCE_EMITTER_HIT = 0;
ANTIPODE_CONST SOURCE_NEXT_EVENT = 1;
ANTIPODE_CONST SOURCE_CONNECTION = 2;
ANTIPODE_CONST SOURCE_SPLAT = 3;
ANTIPODE_CONST SOURCE_MERGE = 4;
ANTIPODE_CONST SOURCE_CAMERA_RAYS = 5;
ANTIPODE_CONST SOURCE_LIGHT_EMISSION = 6;
ANTIPODE_CONST SOURCE_CAMERA_TRACE = 7;
ANTIPODE_CONST SOURCE_LIGHT_TRACE = 8;
ANTIPODE_CONST SOURCE_CAMERA_SCATTER = 9;
ANTIPODE_CONST SOURCE_LIGHT_SCATTER = 10;
ANTIPODE_CONST SOURCE_FILM = 11;
ANTIPODE_CONST EVENT_SOURCES = 12;
ANTIPODE_CONST COUNTER_COUNT = COUNTER_EVENTS + EVENT_SOURCES * EVENT_KINDS;

// Records (lib/record.glsl) take one texel of 16 bytes in float, two in double.
ANTIPODE_CONST PATH_RECORDS = 4;
ANTIPODE_CONST SHADOW_RECORDS = 3;
ANTIPODE_CONST VERTEX_RECORDS = 3;
// What queue_advance comes after: nothing (a batch starts with all its slots queued), an order-preserving compaction,
// or paths that appended themselves to the next queue.
ANTIPODE_CONST QUEUE_START = 0;
ANTIPODE_CONST QUEUE_COMPACTED = 1;
ANTIPODE_CONST QUEUE_APPENDED = 2;
ANTIPODE_CONST SLOT_ALIVE = 1;
ANTIPODE_CONST SLOT_STORED = 2;
ANTIPODE_CONST COMPACT_CHUNK = 64;  // queue slots that one invocation counts and compacts
ANTIPODE_CONST SORT_CHUNK = 256;    // keys that one invocation ranks in a radix pass
ANTIPODE_CONST SORT_DIGIT_BITS = 5;
ANTIPODE_CONST SORT_DIGITS = 1u << SORT_DIGIT_BITS;
ANTIPODE_CONST MERGE_WINDOW = 4096;  // light vertices that one merge dispatch visits per camera vertex

// Path flags, in the direction's w: the length in edges of the sub-path including the current ray, and
ANTIPODE_CONST PATH_LENGTH_MASK = 0xFFFF;
ANTIPODE_CONST PATH_SPECULAR = 1u << 16;  // every surface so far is specular
ANTIPODE_CONST PATH_FROM_INFINITY =
    1u << 17;  // the ray starts at an infinite light or an orthographic camera: its length means nothing
ANTIPODE_CONST PATH_DISPERSED = 1u << 18;  // with FEATURE_DISPERSION: a vertex depends on the wavelength
ANTIPODE_CONST PATH_IN_MEDIUM = 1u << 19;  // with FEATURE_SCATTERING: the vertex reached is a point in a medium
// With FEATURE_DISPERSION: the same of a stored light vertex, beside its path length.
ANTIPODE_CONST VERTEX_DISPERSED = 1u << 15;
ANTIPODE_CONST GREATEST_DISPERSED_LENGTH = VERTEX_DISPERSED - 1;

// ---- The job: constant over all iterations ---------------------------------------------------------------------
ANTIPODE_OF_REAL struct JobParameters {
    ANTIPODE_REAL4 cameraPosition;  // w: image-plane distance in pixels; FEATURE_ORTHOGRAPHIC: pixels a unit
    ANTIPODE_REAL4 cameraForward;   // w: lens radius
    ANTIPODE_REAL4 cameraRight;     // w: focus distance
    ANTIPODE_REAL4 cameraUp;        // w: film scale 2^S as a float
    ANTIPODE_REAL4 sceneCenter;     // w: radius of the bounding sphere
    ANTIPODE_REAL4 gridOrigin;      // least corner of the scene's bounds; w: environment rotation in turns
    ANTIPODE_REAL4 environment;     // radiance factor; w: pick probability q of the environment
    ANTIPODE_REAL4 worldOrigin;     // where the user's positions have theirs; w: 2^S of the guides' lengths
    uvec4 image;                    // width, height, light count, light of the environment
    uvec4 environmentSize;          // width, height, z up, texels of BIND_MORE_ATTRIBUTES a primitive
    uvec4 crop;                     // FEATURE_CROP: the film's first pixel in the frame; the frame's width and height
    uvec4 lengths;                  // least and greatest path length, single technique's s and t
};

// ---- Push constants --------------------------------------------------------------------------------------------
ANTIPODE_OF_REAL struct DispatchParameters {
    uint randomKey0, randomKey1;  // of the iteration's set of samples, see techniques/sample_sets.h
    uint sampleIndex;             // of the iteration in that set
    uint pathBase;                // first path of the batch
    uint batchSize;
    uint queueParity;  // which queue holds the live paths
    uint stageIndex;   // source of events, shadow queue, connection, merge window, pass: as the stage defines
    uint vertexCount;  // light vertices to connect to or sort
    uint vertexCapacity;
    uint bucketCount;  // of the hash grid, a power of two
    uint splatEnabled;
    uint elementCount;             // of a scan
    ANTIPODE_REAL lightPathCount;  // N
    ANTIPODE_REAL radius;
    ANTIPODE_REAL cellSize;
    ANTIPODE_REAL mergeCount;                            // eta = pi r^2 N, 0 without merging
    ANTIPODE_REAL inverseMergeCount;                     // 1/eta, 0 without merging: what a merged light vertex counts
    ANTIPODE_REAL connectCount;                          // kappa = K N / expected light vertices, 0 without connections
    ANTIPODE_REAL connectScale;                          // M / (K N) for this iteration's M
    ANTIPODE_REAL hitCount, nextEventCount, splatCount;  // 1 or 0; 1 or 0; N or 0
};

#ifdef __cplusplus
static_assert(sizeof(JobParameters<float>) == 192 && sizeof(JobParameters<double>) == 320);
// 128 bytes of push constants are all that every device has.
static_assert(sizeof(DispatchParameters<float>) == 88 && sizeof(DispatchParameters<double>) == 128);
}  // namespace antipode::shared
#endif
#endif
