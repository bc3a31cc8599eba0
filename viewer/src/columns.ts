// Columns of numbers to plot: from the package where it has them, else from the server.
import type { Column } from "./generated/records";
import type { Connection } from "./connection";
import type { Opened } from "./package";

export class Columns {
  private readonly known = new Map<string, Promise<Float32Array | string>>();
  private readonly records: Map<string, Column>[];

  constructor(
    private readonly opened: Opened,
    private readonly connection: Connection | null,
  ) {
    this.records = opened.content.stages.map((stage) => new Map(stage.columns.map((column) => [column.name, column])));
  }

  /** Names that can be had. */
  list(stage = 0): Column[] {
    const all = this.opened.content.stages[stage]?.columns ?? [];
    return this.connection ? all : all.filter((column) => column.values);
  }

  unit(name: string): string {
    return this.records[0]?.get(name)?.unit ?? "";
  }

  /** Numbers of a column, one a frame of the stage, or in words why there are none. */
  get(stage: number, name: string): Promise<Float32Array | string> {
    const key = `${stage} ${name}`;
    let found = this.known.get(key);
    if (!found) {
      const packed = this.records[stage]?.get(name)?.values;
      if (packed) found = Promise.resolve(this.opened.arrays.floats(packed));
      else if (this.connection) found = this.connection.column(stage, name);
      else found = Promise.resolve("this page does not carry it");
      this.known.set(key, found);
      void found.then((answer) => typeof answer === "string" && this.known.delete(key));
    }
    return found;
  }
}
