//! Five co-moments of 16 channels in AVX-512.

super::comoments::comoments!(
    Avx512, BareAvx512, "avx512f", 16,
    __m512: _mm512_setzero_ps _mm512_loadu_ps _mm512_storeu_ps _mm512_add_ps _mm512_sub_ps _mm512_mul_ps,
    __m512d: _mm512_setzero_pd _mm512_set1_pd _mm512_loadu_pd _mm512_storeu_pd _mm512_add_pd _mm512_sub_pd _mm512_mul_pd,
    _mm512_cvtps_pd _mm256_loadu_ps
);
