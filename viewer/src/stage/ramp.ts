// Colours of a field from low to high: even steps of lightness, told apart by those who see no red or green as well.
const STOPS: readonly (readonly [number, number, number])[] = [
  [0.16, 0.2, 0.46],
  [0.15, 0.41, 0.61],
  [0.14, 0.6, 0.58],
  [0.52, 0.77, 0.38],
  [0.98, 0.86, 0.32],
];

const linear = (c: number) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
const LINEAR = STOPS.map((stop) => stop.map(linear) as unknown as readonly [number, number, number]);

/** The colour at `share` (0 to 1) into `out` from `first` on, as the renderer counts light. */
export function ramp(share: number, out: Float32Array, first: number): void {
  const at = Math.min(Math.max(Number.isFinite(share) ? share : 0, 0), 1) * (LINEAR.length - 1);
  const k = Math.min(Math.floor(at), LINEAR.length - 2);
  const f = at - k;
  for (let i = 0; i < 3; i++) out[first + i] = LINEAR[k]![i]! * (1 - f) + LINEAR[k + 1]![i]! * f;
}

/** The colours from low to high as a style. */
export function rampGradient(): string {
  const stops = STOPS.map((stop) => `rgb(${stop.map((c) => Math.round(255 * c)).join(" ")})`);
  return `linear-gradient(90deg, ${stops.join(", ")})`;
}
