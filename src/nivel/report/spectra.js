// Spectra of curves whose frames are evenly spaced: amplitudes over the frequency, and how they change in time.
const Spectra = (() => {
  "use strict";
  const WINDOWS = 8; // a window of a waterfall is such a part of the run, and half of it comes again in the next one
  const LEAST = 32; // frames from which on there is a spectrum
  const EVEN = 1e-6; // of the interval

  /** The interval of the frames [s] and how many of them lie evenly; a last one beside them is left out. */
  function evenly(time) {
    const dt = time[1] - time[0];
    let count = 1;
    while (count < time.length && Math.abs(time[count] - time[0] - count * dt) < EVEN * dt * count) count++;
    return count >= LEAST && count >= time.length - 1 ? { dt, count } : null;
  }

  /** Amplitudes at the frequencies k/(n dt), with the window of Hann; the mean is taken away. An amplitude is that of a sine. */
  function amplitudes(values, dt) {
    const n = values.length;
    const mean = values.reduce((sum, v) => sum + v, 0) / n;
    const cosine = Float64Array.from({ length: n }, (_, k) => Math.cos((2 * Math.PI * k) / n));
    const sine = Float64Array.from({ length: n }, (_, k) => Math.sin((2 * Math.PI * k) / n));
    const weighed = Float64Array.from(values, (v, k) => (v - mean) * 0.5 * (1 - cosine[k]));
    const frequency = [];
    const amplitude = [];
    for (let m = 1; m <= n >> 1; m++) {
      let a = 0;
      let b = 0;
      for (let k = 0, at = 0; k < n; k++, at = (at + m) % n) {
        a += weighed[k] * cosine[at];
        b += weighed[k] * sine[at];
      }
      frequency.push(m / (n * dt));
      amplitude.push((4 * Math.hypot(a, b)) / n);
    }
    return { frequency, amplitude };
  }

  /** Spectra of windows that follow each other: middles [s] of the windows, frequencies, and amplitudes of each. */
  function waterfall(time, values, dt) {
    const wide = Math.max(LEAST, Math.floor(values.length / WINDOWS));
    const middles = [];
    const rows = [];
    let frequency = [];
    for (let first = 0; first + wide <= values.length; first += wide >> 1) {
      const found = amplitudes(values.slice(first, first + wide), dt);
      frequency = found.frequency;
      middles.push(time[0] + (first + 0.5 * wide) * dt);
      rows.push(found.amplitude);
    }
    return { middles, frequency, rows, half: 0.25 * wide * dt };
  }

  return { evenly, amplitudes, waterfall };
})();
