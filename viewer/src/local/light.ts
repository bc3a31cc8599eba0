// The light of a machine that lives in a page: what `nivel live` finds from its frames, as far as single numbers can tell.
import type { LocalMachine, Watched } from "../generated/records";

type Verdict = "green" | "amber" | "red";
const LATE = [1e-2, 1e-1] as const; // shares of the time that was lost, below which it is green, and amber
const ORDER: Verdict[] = ["green", "amber", "red"];

export class Light {
  private first: Float64Array | null = null;
  private speed = 0;
  private readonly errors: number[];
  private readonly scales: number[];

  constructor(private readonly machine: LocalMachine) {
    this.errors = machine.watched.map(() => 0);
    this.scales = machine.watched.map((each) => each.floor);
  }

  /** A motion begins; what was found before does not belong to it. */
  begin(frame: Float64Array): void {
    this.first ??= frame.slice();
    this.speed = 0;
    this.machine.watched.forEach((each, k) => {
      this.errors[k] = 0;
      this.scales[k] = each.floor;
    });
  }

  take(frame: Float64Array): void {
    const first = (this.first ??= frame.slice());
    this.speed = Math.max(this.speed, this.speedOf(frame), this.machine.speeds.slow / Math.max(frame[0]! - first[0]!, 1));
    this.machine.watched.forEach((watched, k) => {
      const error = errorOf(watched, frame, first);
      if (!(error <= this.errors[k]!)) this.errors[k] = error;
      for (const column of watched.against) this.scales[k] = Math.max(this.scales[k]!, Math.abs(frame[column]!));
      for (const column of watched.changes) this.scales[k] = Math.max(this.scales[k]!, Math.abs(frame[column]! - first[column]!));
    });
  }

  /** Verdict and reasons; lost : share of the time that was not caught up. problem : why the run failed, or empty. */
  verdict(lost: number, problem: string): [Verdict, string[]] {
    const items: [Verdict, string][] = problem ? [["red", `Outcome: ${problem}`]] : [];
    this.machine.watched.forEach((each, k) => {
      const scale = Math.max(this.scales[k]!, each.speed * this.speed), error = this.errors[k]!;
      const share = error === 0 ? 0 : error / scale;
      items.push([share < each.green ? "green" : share < each.amber ? "amber" : "red", each.text.replace("{}", share.toPrecision(2))]);
    });
    const text = `Real time: ${(100 * lost).toPrecision(2)} % of the time was lost, as the machine takes longer to compute than it lasts, or the page was not served (green below 0.01, amber below 0.1)`;
    items.push([lost < LATE[0] ? "green" : lost < LATE[1] ? "amber" : "red", text]);
    const bad = items.filter(([verdict]) => verdict !== "green").sort(([a], [b]) => ORDER.indexOf(b) - ORDER.indexOf(a));
    return [bad[0]?.[0] ?? "green", bad.map(([, each]) => each)];
  }

  private speedOf(frame: Float64Array): number {
    const { velocity, angular, reach } = this.machine.speeds;
    const length = (at: number) => Math.hypot(frame[at]!, frame[at + 1]!, frame[at + 2]!);
    return reach.reduce((most, each, k) => Math.max(most, length(velocity + 3 * k) + each * length(angular + 3 * k)), 0);
  }
}

function errorOf({ columns, factors, summed }: Watched, frame: Float64Array, first: Float64Array): number {
  if (summed) return Math.abs(columns.reduce((sum, column, k) => sum + factors[k]! * (frame[column]! - first[column]!), 0));
  return columns.reduce((most, column, k) => {
    const error = Math.abs((factors[k] ?? 1) * frame[column]!);
    return error <= most ? most : error;
  }, 0);
}
