// Records carry numbers from kernel to kernel: four reals, or three and an integer (the tag). A texel in float, two in
// double.
#ifndef ANTIPODE_RECORD
#define ANTIPODE_RECORD
#include "lib/real.glsl"

#ifdef ANTIPODE_DOUBLE
struct Record {
    uvec4 low, high;
};

Record packRecord(real3 v, uint tag) {
    return Record(uvec4(unpackDouble2x32(v.x), unpackDouble2x32(v.y)), uvec4(unpackDouble2x32(v.z), tag, 0u));
}
Record packRecord(real4 v) {
    return Record(uvec4(unpackDouble2x32(v.x), unpackDouble2x32(v.y)),
                  uvec4(unpackDouble2x32(v.z), unpackDouble2x32(v.w)));
}
real3 recordVector(Record r) {
    return real3(packDouble2x32(r.low.xy), packDouble2x32(r.low.zw), packDouble2x32(r.high.xy));
}
real recordFourth(Record r) { return packDouble2x32(r.high.zw); }
uint recordTag(Record r) { return r.high.z; }

Record fetchRecord(usamplerBuffer records, uint index) {
    return Record(texelFetch(records, int(2u * index)), texelFetch(records, int(2u * index + 1u)));
}
#else
struct Record {
    uvec4 bits;
};

Record packRecord(real3 v, uint tag) { return Record(uvec4(floatBitsToUint(v), tag)); }
Record packRecord(real4 v) { return Record(floatBitsToUint(v)); }
real3 recordVector(Record r) { return uintBitsToFloat(r.bits.xyz); }
real recordFourth(Record r) { return uintBitsToFloat(r.bits.w); }
uint recordTag(Record r) { return r.bits.w; }

Record fetchRecord(usamplerBuffer records, uint index) { return Record(texelFetch(records, int(index))); }
#endif
#endif
