# snap.g: what Gappa proves of setup.inl's conversions to 24.8: no small triangle's corner leaves what setup.c takes.
#
# A corner that is used has near <= w < 2^20 and -wide <= x <= wide (setup_transform's tests: the sign of a rounded sum
# is the sum's own), and no view is nearer than 1e-30 m (lmb_view_is_valid). setup_floor then adds a half and takes one
# away at most: |corner| < 4194052, and 2^22 is 4194304. The two cases are quotients that round as numbers do, and those
# so small that they may round as denormals do.
@f = float<ieee_32, ne>;
guard = f(32766 / frame);    # draw.c: GUARD_PX * 2 / frame
wide = f(guard * w);
inverse = f(1 / w);
q = f(x * inverse);
s = f(q * (128 * frame));    # job->snap_x, a whole number under 2^24
s_tiny = f(f(tiny) * (128 * frame));

{ frame in [1, 16384] /\ w in [1e-30, 1048576] /\ x / wide in [-1, 1] /\ |x * inverse| in [1b-100, 1b100] /\
  |tiny| in [0, 1b-100] -> s in [-4194050, 4194050] /\ s_tiny in [-1, 1] }

# Step by step back to x / wide: each step's relative error, and what the steps are worth together.
s -> 4194048 * (x / wide) *
     ((1 + (s - q * (128 * frame)) / (q * (128 * frame))) *
      (1 + (q - x * inverse) / (x * inverse)) *
      (1 + (inverse - 1 / w) / (1 / w)) *
      (1 + (wide - guard * w) / (guard * w)) *
      (1 + (guard - 32766 / frame) / (32766 / frame)))
     { frame <> 0, w <> 0, inverse <> 0, wide <> 0, guard <> 0, q <> 0, q * (128 * frame) <> 0, x * inverse <> 0,
       1 / w <> 0, guard * w <> 0, 32766 / frame <> 0 };
