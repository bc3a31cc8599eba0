// A page whose machine is inside: a worker takes the place of the server, and this that of the websocket to it.
import type { Link } from "../connection";
import type { LocalMachine } from "../generated/records";
import { inflate } from "../package";

const PARTS = ["program", "machine", "memory", "kernels", "package"] as const;

/** Whether the page has a machine inside. */
export function hasMachine(): boolean {
  return !!document.getElementById("machine");
}

/** The worker with the machine of this page. complain : says what is wrong. */
export async function startMachine(complain: (text: string) => void): Promise<Link> {
  const texts = PARTS.map((name) => document.getElementById(name)!);
  const [program, machine, memory, kernels, content] = await Promise.all(texts.map((each) => inflate(each.textContent!)));
  for (const each of texts) each.remove();
  const worker = new Worker(URL.createObjectURL(new Blob([program as BlobPart], { type: "text/javascript" })));
  const record = JSON.parse(new TextDecoder().decode(machine)) as LocalMachine;
  const link: Link = {
    readyState: WebSocket.OPEN,
    onopen: null,
    onmessage: null,
    onclose: null,
    send: (text) => worker.postMessage(text),
  };
  worker.onerror = (event) => complain(`The machine cannot run here: ${event.message}.`);
  worker.onmessage = (event: MessageEvent) => {
    const problem = (event.data as { problem?: string }).problem;
    if (problem) complain(`The machine cannot run here: ${problem}.`);
    else link.onmessage?.(event);
  };
  setTimeout(() => {
    link.onopen?.();
    worker.postMessage({ machine: record, memory, kernels, package: content });
  });
  return link;
}
