// What GLSL has for floats alone: sin, cos, exp, log and atan of doubles, within 2 ulp; and two functions that keep
// their accuracy near 0 in either arithmetic. Reductions after Cody and Waite, "Software Manual for the Elementary
// Functions", 1980; series of Taylor, long enough for their remainders to stay below 2^-56 of the value.
#ifndef ANTIPODE_TRANSCENDENTAL
#define ANTIPODE_TRANSCENDENTAL
#include "lib/real.glsl"

#ifdef ANTIPODE_DOUBLE
/// x²·(1/3! − x²/5! + …): sin x = x − x·this, |x| ≤ π/4.
double sineSeries(double x2) {
    double s = 1.0;
    for (int n = 16; n >= 4; n -= 2) s = 1.0 - s * x2 / double(n * (n + 1));
    return s * x2 / 6.0;
}
/// cos x − 1 + x²/2, |x| ≤ π/4.
double cosineSeries(double x2) {
    double s = 1.0;
    for (int n = 17; n >= 5; n -= 2) s = 1.0 - s * x2 / double(n * (n + 1));
    return s * x2 * x2 / 24.0;
}
/// sin(x + quarter·π/2). |x| below 2^20: beyond, the reduction loses bits.
double sineOfQuarter(double x, int quarter) {
    double k = roundEven(x * 0.6366197723675814lf);
    precise double r = x - k * 1.5707963267341256lf;  // 33 bits of π/2: the product is exact
    r = r - k * 6.077100506303966e-11lf;
    r = r - k * 2.0222662487959506e-21lf;
    double r2 = r * r;
    int q = (int(k) + quarter) & 3;
    double cosine = 1.0 - (0.5 * r2 - cosineSeries(r2));
    double value = (q & 1) != 0 ? cosine : r - r * sineSeries(r2);
    return q >= 2 ? -value : value;
}
double sin(double x) { return sineOfQuarter(x, 0); }
double cos(double x) { return sineOfQuarter(x, 1); }

/// e^x: infinite above the range of doubles, 0 below it.
double exp(double x) {
    double k = roundEven(clamp(x, double(-800.0), double(800.0)) * 1.4426950408889634lf);
    precise double high = x - k * 0.6931471804855391lf;
    double low = k * 7.440617110012397e-11lf;
    double r = high - low;
    double s = 1.0;
    for (int n = 13; n >= 2; --n) s = 1.0 + s * r / double(n);
    // 2^k as two factors: it may lie outside the range of the exponent where the result does not.
    int half_ = int(k) / 2, rest = int(k) - half_;
    double result = (1.0 + s * r) * packDouble2x32(uvec2(0u, uint(half_ + 1023) << 20)) *
                    packDouble2x32(uvec2(0u, uint(rest + 1023) << 20));
    return x > 800.0 ? packDouble2x32(uvec2(0u, 0x7FF00000u)) : x < -800.0 ? double(0.0) : result;
}

/// 2·atanh(s) − 2s over 2s, |s| ≤ 0.1716.
double hyperbolicSeries(double s2) {
    double sum = 0.0;
    for (int n = 23; n >= 3; n -= 2) sum = sum * s2 + 1.0 / double(n);
    return sum * s2;
}
/// The natural logarithm; −∞ at 0, NaN below it. Not for denormals.
double log(double x) {
    uvec2 bits = unpackDouble2x32(x);
    int exponent = int(bits.y >> 20) - 1023;
    double m = packDouble2x32(uvec2(bits.x, (bits.y & 0x000FFFFFu) | 0x3FF00000u));
    if (m > 1.4142135623730951lf) {
        m *= 0.5;
        exponent += 1;
    }
    double f = m - 1.0, s = f / (m + 1.0), k = double(exponent);
    // log m = f − s·(f − 2·series): the exact f keeps the last bits that s has lost.
    double result =
        k * 0.6931471804855391lf - (s * (f - 2.0 * hyperbolicSeries(s * s)) - k * 7.440617110012397e-11lf - f);
    if (x > 0.0 && !isinf(x)) return result;
    return x == 0.0 ? packDouble2x32(uvec2(0u, 0xFFF00000u)) : x > 0.0 ? x : packDouble2x32(uvec2(0u, 0x7FF80000u));
}

/// The angle of (x, y) in [−π, π]; 0 for (0, 0).
double atan(double y, double x) {
    double ax = abs(x), ay = abs(y), n = min(ax, ay), d = max(ax, ay);
    // The arc tangent of the nearest half, and of what is left: c·d is exact.
    double c = n <= 0.25 * d ? 0.0 : n < 0.75 * d ? 0.5 : 1.0;
    double known = c == 0.0 ? double(0.0) : c == 0.5 ? 0.4636476090008061lf : 0.7853981633974483lf;
    double rest = c == 0.0 ? double(0.0) : c == 0.5 ? 2.2698777452961687e-17lf : 3.061616997868383e-17lf;  // of `known`
    double z = d > 0.0 ? (n - c * d) / (d + c * n) : double(0.0), z2 = z * z, sum = 0.0;
    for (int k = 27; k >= 3; k -= 2) sum = 1.0 / double(k) - sum * z2;
    double angle = known + (z - (z * (sum * z2) - rest));
    if (ay > ax)
        angle = x < 0.0 ? 0.5 * PI + angle : 0.5 * PI - angle;
    else if (x < 0.0)
        angle = PI - angle;
    return isnan(x) || isnan(y) ? x + y : y < 0.0 ? -angle : angle;
}
#endif

/// log(1 − v) for v in [0, 1].
real logOneMinus(real v) {
#ifdef ANTIPODE_DOUBLE
    double s = v / (v - 2.0);
    precise double w = 1.0 - v, lost = (1.0 - w) - v;
    return v < 0.25 ? -v + s * (v + 2.0 * hyperbolicSeries(s * s)) : log(w) + (v < 1.0 ? lost / w : double(0.0));
#else
    return v < 0.0625 ? -v * (1.0 + v * (1.0 / 2.0 + v * (1.0 / 3.0 + v * (1.0 / 4.0 + v * (1.0 / 5.0)))))
                      : log(1.0 - v);
#endif
}

/// 1 − e^−x for x ≥ 0.
real oneMinusExp(real x) {
#ifdef ANTIPODE_DOUBLE
    if (x >= 0.7) return 1.0 - exp(-x);
    double s = 1.0;
    for (int n = 18; n >= 3; --n) s = 1.0 - s * x / double(n);
    return x - 0.5 * x * x * s;
#else
    return x < 0.0625 ? x * (1.0 - x * (1.0 / 2.0 - x * (1.0 / 6.0 - x * (1.0 / 24.0)))) : 1.0 - exp(-x);
#endif
}
#endif
