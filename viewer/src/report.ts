// The block diagram in a report.
import { diagram } from "./ui/diagram";

const data = document.getElementById("blocks");
if (data) data.replaceWith(diagram(JSON.parse(data.textContent)));
