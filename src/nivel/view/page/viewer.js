/* three.js, uPlot and dagre: MIT licence, see NOTICE */
"use strict";(()=>{var rc=class{constructor(e,t){this.opened=e;this.connection=t;this.records=e.content.stages.map(n=>new Map(n.columns.map(s=>[s.name,s])))}opened;connection;known=new Map;records;list(e=0){let t=this.opened.content.stages[e]?.columns??[];return this.connection?t:t.filter(n=>n.values)}unit(e){return this.records[0]?.get(e)?.unit??""}get(e,t){let n=`${e} ${t}`,s=this.known.get(n);if(!s){let r=this.records[e]?.get(t)?.values;r?s=Promise.resolve(this.opened.arrays.floats(r)):this.connection?s=this.connection.column(e,t):s=Promise.resolve("this page does not carry it"),this.known.set(n,s),s.then(o=>typeof o=="string"&&this.known.delete(n))}return s}};var va=class{time;count;layout;load;frames;constructor(e,t){if(!e.motion)throw new Error("there is no motion");this.layout=e.layout,this.time=t.times(e.motion.time),this.count=this.time.length,this.frames=t.floats(e.motion.frames),this.load=e.motion.load?t.times(e.motion.load):null}says(e,t){if(!this.load)return`${t(e)} s`;let n=this.at(e),s=Math.min(n+1,this.count-1),r=this.time[s]-this.time[n],o=r>0?Math.min(Math.max((e-this.time[n])/r,0),1):0;return`load factor ${t(this.load[n]+o*(this.load[s]-this.load[n]))}`}get start(){return this.time[0]??0}get end(){return this.time[this.count-1]??0}at(e){let t=0,n=this.count-1;for(;t<n;){let s=t+n+1>>1;this.time[s]<=e?t=s:n=s-1}return t}value(e,t){return this.frames[e*this.count+t]}sample(e,t){let n=this.at(e),s=Math.min(n+1,this.count-1),r=this.time[s]-this.time[n],o=r>0?Math.min(Math.max((e-this.time[n])/r,0),1):0,{frames:a,count:l}=this;for(let c=0;c<this.layout.width;c++){let h=a[c*l+n];t[c]=o===0?h:h+o*(a[c*l+s]-h)}if(o!==0)for(let c=0;c<this.layout.bodies;c++){let h=7*c+3,u=0;for(let f=h;f<h+4;f++)u+=a[f*l+n]*a[f*l+s];let d=u<0?-1:1;for(let f=h;f<h+4;f++)t[f]=(1-o)*a[f*l+n]+d*o*a[f*l+s]}}};var xa=[.01,.02,.05,.1,.2,.5,1,2,5,10],oc=class{constructor(e){this.motion=e;this.time=e.start}motion;time;playing=!1;speed=1;loop=!0;last=0;onChange=()=>{};onTime=()=>{};get frame(){return this.motion.at(this.time)}toggle(e=!this.playing){e&&!this.loop&&this.time>=this.motion.end&&(this.time=this.motion.start),this.playing=e&&this.motion.count>1&&this.motion.end>this.motion.start,this.last=0,this.onChange(),this.onTime()}seek(e){Number.isFinite(e)&&(this.time=Math.min(Math.max(e,this.motion.start),this.motion.end),this.onTime())}step(e){this.toggle(!1);let t=Math.min(Math.max(this.frame+e,0),this.motion.count-1);this.seek(this.motion.time[t])}faster(e){let t=xa.findIndex(n=>n>=this.speed*.999);this.speed=xa[Math.min(Math.max(t+e,0),xa.length-1)],this.onChange()}advance(e){if(!this.playing)return;let t=this.last?Math.min(e-this.last,250)/1e3:0;this.last=e;let{start:n,end:s}=this.motion,r=this.time+t*this.speed;r>s&&(this.loop?r=n+(r-n)%(s-n):(r=s,this.playing=!1,this.onChange())),this.time=r,this.onTime()}};var mr={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},gr={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},f0=0,zf=1,p0=2;var Vf=0,yr=1,m0=2,zo=3,vr=0,li=1,wn=2,Or=0,Vo=1,Gf=2,Wf=3,Xf=4,g0=5;var Ur=100,y0=101,v0=102,x0=103,_0=104,b0=200,E0=201,w0=202,M0=203,qf=204,Yf=205,S0=206,T0=207,A0=208,R0=209,C0=210,P0=211,I0=212,L0=213,N0=214,Hc=0,zc=1,Vc=2,Ro=3,Gc=4,Wc=5,Xc=6,qc=7,vl=0,D0=1,F0=2,Hi=0,$f=1,jf=2,Zf=3,Jf=4,Kf=5,Qf=6,ep=7;var tp=300,kr=301,Go=302,Eh=303,wh=304,Yc=1e3,fs=1001,$c=1002,Bn=1003,O0=1004;var xl=1005;var oi=1006,Mh=1007;var Xs=1008;var yi=1009,np=1010,ip=1011,Wo=1012,Sh=1013,zi=1014,pi=1015,Qi=1016,Th=1017,Ah=1018,Br=1020,sp=35902,rp=35899,op=1021,ap=1022,Ti=1023,ks=1026,qs=1027,Rh=1028,_l=1029,xr=1030,Ch=1031;var Ph=1033,bl=33776,El=33777,wl=33778,Ml=33779,Ih=35840,Lh=35841,Nh=35842,Dh=35843,Fh=36196,Oh=37492,Uh=37496,kh=37488,Bh=37489,Sl=37490,Hh=37491,zh=37808,Vh=37809,Gh=37810,Wh=37811,Xh=37812,qh=37813,Yh=37814,$h=37815,jh=37816,Zh=37817,Jh=37818,Kh=37819,Qh=37820,eu=37821,tu=36492,nu=36494,iu=36495,su=36283,ru=36284,Tl=36285,ou=36286;var La=2300,jc=2301,kc=2302,Cf=2303,Pf=2400,If=2401,Lf=2402;var U0=3200;var Al=0,k0=1,Ys="",Si="srgb",Na="srgb-linear",Da="linear",Vt="srgb";var Bc=7680;var B0=519,H0=512,z0=513,V0=514,lp=515,G0=516,W0=517,cp=518,hp=519,up=35044;var dp="300 es",Ui=2e3,Co=2001;function Bb(i){for(let e=i.length-1;e>=0;--e)if(i[e]>=65535)return!0;return!1}function Hb(i){return ArrayBuffer.isView(i)&&!(i instanceof DataView)}function Fa(i){return document.createElementNS("http://www.w3.org/1999/xhtml",i)}function X0(){let i=Fa("canvas");return i.style.display="block",i}var Mg={},Po=null;function Oa(...i){let e="THREE."+i.shift();Po?Po("log",e,...i):console.log(e,...i)}function q0(i){let e=i[0];if(typeof e=="string"&&e.startsWith("TSL:")){let t=i[1];t&&t.isStackTrace?i[0]+=" "+t.getLocation():i[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return i}function it(...i){i=q0(i);let e="THREE."+i.shift();if(Po)Po("warn",e,...i);else{let t=i[0];t&&t.isStackTrace?console.warn(t.getError(e)):console.warn(e,...i)}}function ht(...i){i=q0(i);let e="THREE."+i.shift();if(Po)Po("error",e,...i);else{let t=i[0];t&&t.isStackTrace?console.error(t.getError(e)):console.error(e,...i)}}function Ra(...i){let e=i.join(" ");e in Mg||(Mg[e]=!0,it(...i))}function Y0(i,e,t){return new Promise(function(n,s){function r(){switch(i.clientWaitSync(e,i.SYNC_FLUSH_COMMANDS_BIT,0)){case i.WAIT_FAILED:s();break;case i.TIMEOUT_EXPIRED:setTimeout(r,t);break;default:n()}}setTimeout(r,t)})}var $0={[Hc]:Hc,[Vc]:Xc,[Gc]:Gc,[Ro]:Wc,[zc]:zc,[Xc]:Vc,[qc]:qc,[Wc]:Ro},Ji=class{addEventListener(e,t){this._listeners===void 0&&(this._listeners={});let n=this._listeners;n[e]===void 0&&(n[e]=[]),n[e].indexOf(t)===-1&&n[e].push(t)}hasEventListener(e,t){let n=this._listeners;return n===void 0?!1:n[e]!==void 0&&n[e].indexOf(t)!==-1}removeEventListener(e,t){let n=this._listeners;if(n===void 0)return;let s=n[e];if(s!==void 0){let r=s.indexOf(t);r!==-1&&s.splice(r,1)}}dispatchEvent(e){let t=this._listeners;if(t===void 0)return;let n=t[e.type];if(n!==void 0){e.target=this;let s=n.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,e);e.target=null}}},Yn=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],Sg=1234567,To=Math.PI/180,Io=180/Math.PI;function $s(){let i=Math.random()*4294967295|0,e=Math.random()*4294967295|0,t=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(Yn[i&255]+Yn[i>>8&255]+Yn[i>>16&255]+Yn[i>>24&255]+"-"+Yn[e&255]+Yn[e>>8&255]+"-"+Yn[e>>16&15|64]+Yn[e>>24&255]+"-"+Yn[t&63|128]+Yn[t>>8&255]+"-"+Yn[t>>16&255]+Yn[t>>24&255]+Yn[n&255]+Yn[n>>8&255]+Yn[n>>16&255]+Yn[n>>24&255]).toLowerCase()}function mt(i,e,t){return Math.max(e,Math.min(t,i))}function fp(i,e){return(i%e+e)%e}function zb(i,e,t,n,s){return n+(i-e)*(s-n)/(t-e)}function Vb(i,e,t){return i!==e?(t-i)/(e-i):0}function Ca(i,e,t){return(1-t)*i+t*e}function Gb(i,e,t,n){return Ca(i,e,1-Math.exp(-t*n))}function Wb(i,e=1){return e-Math.abs(fp(i,e*2)-e)}function Xb(i,e,t){return i<=e?0:i>=t?1:(i=(i-e)/(t-e),i*i*(3-2*i))}function qb(i,e,t){return i<=e?0:i>=t?1:(i=(i-e)/(t-e),i*i*i*(i*(i*6-15)+10))}function Yb(i,e){return i+Math.floor(Math.random()*(e-i+1))}function $b(i,e){return i+Math.random()*(e-i)}function jb(i){return i*(.5-Math.random())}function Zb(i){i!==void 0&&(Sg=i);let e=Sg+=1831565813;return e=Math.imul(e^e>>>15,e|1),e^=e+Math.imul(e^e>>>7,e|61),((e^e>>>14)>>>0)/4294967296}function Jb(i){return i*To}function Kb(i){return i*Io}function Qb(i){return i>0&&Number.isInteger(i)&&2**Math.round(Math.log2(i))===i}function eE(i){return Math.pow(2,Math.ceil(Math.log(i)/Math.LN2))}function pp(i){return Math.pow(2,Math.floor(Math.log(i)/Math.LN2))}function tE(i,e,t,n,s){let r=Math.cos,o=Math.sin,a=r(t/2),l=o(t/2),c=r((e+n)/2),h=o((e+n)/2),u=r((e-n)/2),d=o((e-n)/2),f=r((n-e)/2),p=o((n-e)/2);switch(s){case"XYX":i.set(a*h,l*u,l*d,a*c);break;case"YZY":i.set(l*d,a*h,l*u,a*c);break;case"ZXZ":i.set(l*u,l*d,a*h,a*c);break;case"XZX":i.set(a*h,l*p,l*f,a*c);break;case"YXY":i.set(l*f,a*h,l*p,a*c);break;case"ZYZ":i.set(l*p,l*f,a*h,a*c);break;default:it("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function au(i){switch(i.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function mp(i,e){if(e.constructor===Float32Array)return i;let t=au(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(i/t,-1)}function gp(i,e){if(e.constructor===Float32Array)return i;let t=au(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(i*t)}var ci={DEG2RAD:To,RAD2DEG:Io,generateUUID:$s,clamp:mt,euclideanModulo:fp,mapLinear:zb,inverseLerp:Vb,lerp:Ca,damp:Gb,pingpong:Wb,smoothstep:Xb,smootherstep:qb,randInt:Yb,randFloat:$b,randFloatSpread:jb,seededRandom:Zb,degToRad:Jb,radToDeg:Kb,isPowerOfTwo:Qb,ceilPowerOfTwo:eE,floorPowerOfTwo:pp,setQuaternionFromProperEuler:tE,normalize:gp,denormalize:mp},ue=class{static{this.prototype.isVector2=!0}constructor(e=0,t=0){this.x=e,this.y=t}get width(){return this.x}set width(e){this.x=e}get height(){return this.y}set height(e){this.y=e}set(e,t){return this.x=e,this.y=t,this}setScalar(e){return this.x=e,this.y=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;default:throw new Error("THREE.Vector2: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y)}copy(e){return this.x=e.x,this.y=e.y,this}add(e){return this.x+=e.x,this.y+=e.y,this}addScalar(e){return this.x+=e,this.y+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this}subScalar(e){return this.x-=e,this.y-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this}multiply(e){return this.x*=e.x,this.y*=e.y,this}multiplyScalar(e){return this.x*=e,this.y*=e,this}divide(e){return this.x/=e.x,this.y/=e.y,this}divideScalar(e){return this.multiplyScalar(1/e)}applyMatrix3(e){let t=this.x,n=this.y,s=e.elements;return this.x=s[0]*t+s[3]*n+s[6],this.y=s[1]*t+s[4]*n+s[7],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this}clamp(e,t){return this.x=mt(this.x,e.x,t.x),this.y=mt(this.y,e.y,t.y),this}clampScalar(e,t){return this.x=mt(this.x,e,t),this.y=mt(this.y,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(mt(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(e){return this.x*e.x+this.y*e.y}cross(e){return this.x*e.y-this.y*e.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let n=this.dot(e)/t;return Math.acos(mt(n,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,n=this.y-e.y;return t*t+n*n}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this}equals(e){return e.x===this.x&&e.y===this.y}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this}rotateAround(e,t){let n=Math.cos(t),s=Math.sin(t),r=this.x-e.x,o=this.y-e.y;return this.x=r*n-o*s+e.x,this.y=r*s+o*n+e.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},nt=class{constructor(e=0,t=0,n=0,s=1){this.isQuaternion=!0,this._x=e,this._y=t,this._z=n,this._w=s}static slerpFlat(e,t,n,s,r,o,a){let l=n[s+0],c=n[s+1],h=n[s+2],u=n[s+3],d=r[o+0],f=r[o+1],p=r[o+2],v=r[o+3];if(u!==v||l!==d||c!==f||h!==p){let g=l*d+c*f+h*p+u*v;g<0&&(d=-d,f=-f,p=-p,v=-v,g=-g);let m=1-a;if(g<.9995){let y=Math.acos(g),b=Math.sin(y);m=Math.sin(m*y)/b,a=Math.sin(a*y)/b,l=l*m+d*a,c=c*m+f*a,h=h*m+p*a,u=u*m+v*a}else{l=l*m+d*a,c=c*m+f*a,h=h*m+p*a,u=u*m+v*a;let y=1/Math.sqrt(l*l+c*c+h*h+u*u);l*=y,c*=y,h*=y,u*=y}}e[t]=l,e[t+1]=c,e[t+2]=h,e[t+3]=u}static multiplyQuaternionsFlat(e,t,n,s,r,o){let a=n[s],l=n[s+1],c=n[s+2],h=n[s+3],u=r[o],d=r[o+1],f=r[o+2],p=r[o+3];return e[t]=a*p+h*u+l*f-c*d,e[t+1]=l*p+h*d+c*u-a*f,e[t+2]=c*p+h*f+a*d-l*u,e[t+3]=h*p-a*u-l*d-c*f,e}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get w(){return this._w}set w(e){this._w=e,this._onChangeCallback()}set(e,t,n,s){return this._x=e,this._y=t,this._z=n,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(e){return this._x=e.x,this._y=e.y,this._z=e.z,this._w=e.w,this._onChangeCallback(),this}setFromEuler(e,t=!0){let n=e._x,s=e._y,r=e._z,o=e._order,a=Math.cos,l=Math.sin,c=a(n/2),h=a(s/2),u=a(r/2),d=l(n/2),f=l(s/2),p=l(r/2);switch(o){case"XYZ":this._x=d*h*u+c*f*p,this._y=c*f*u-d*h*p,this._z=c*h*p+d*f*u,this._w=c*h*u-d*f*p;break;case"YXZ":this._x=d*h*u+c*f*p,this._y=c*f*u-d*h*p,this._z=c*h*p-d*f*u,this._w=c*h*u+d*f*p;break;case"ZXY":this._x=d*h*u-c*f*p,this._y=c*f*u+d*h*p,this._z=c*h*p+d*f*u,this._w=c*h*u-d*f*p;break;case"ZYX":this._x=d*h*u-c*f*p,this._y=c*f*u+d*h*p,this._z=c*h*p-d*f*u,this._w=c*h*u+d*f*p;break;case"YZX":this._x=d*h*u+c*f*p,this._y=c*f*u+d*h*p,this._z=c*h*p-d*f*u,this._w=c*h*u-d*f*p;break;case"XZY":this._x=d*h*u-c*f*p,this._y=c*f*u-d*h*p,this._z=c*h*p+d*f*u,this._w=c*h*u+d*f*p;break;default:it("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return t===!0&&this._onChangeCallback(),this}setFromAxisAngle(e,t){let n=t/2,s=Math.sin(n);return this._x=e.x*s,this._y=e.y*s,this._z=e.z*s,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(e){let t=e.elements,n=t[0],s=t[4],r=t[8],o=t[1],a=t[5],l=t[9],c=t[2],h=t[6],u=t[10],d=n+a+u;if(d>0){let f=.5/Math.sqrt(d+1);this._w=.25/f,this._x=(h-l)*f,this._y=(r-c)*f,this._z=(o-s)*f}else if(n>a&&n>u){let f=2*Math.sqrt(1+n-a-u);this._w=(h-l)/f,this._x=.25*f,this._y=(s+o)/f,this._z=(r+c)/f}else if(a>u){let f=2*Math.sqrt(1+a-n-u);this._w=(r-c)/f,this._x=(s+o)/f,this._y=.25*f,this._z=(l+h)/f}else{let f=2*Math.sqrt(1+u-n-a);this._w=(o-s)/f,this._x=(r+c)/f,this._y=(l+h)/f,this._z=.25*f}return this._onChangeCallback(),this}setFromUnitVectors(e,t){let n=e.dot(t)+1;return n<1e-8?(n=0,Math.abs(e.x)>Math.abs(e.z)?(this._x=-e.y,this._y=e.x,this._z=0,this._w=n):(this._x=0,this._y=-e.z,this._z=e.y,this._w=n)):(this._x=e.y*t.z-e.z*t.y,this._y=e.z*t.x-e.x*t.z,this._z=e.x*t.y-e.y*t.x,this._w=n),this.normalize()}angleTo(e){return 2*Math.acos(Math.abs(mt(this.dot(e),-1,1)))}rotateTowards(e,t){let n=this.angleTo(e);if(n===0)return this;let s=Math.min(1,t/n);return this.slerp(e,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(e){return this._x*e._x+this._y*e._y+this._z*e._z+this._w*e._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let e=this.length();return e===0?(this._x=0,this._y=0,this._z=0,this._w=1):(e=1/e,this._x=this._x*e,this._y=this._y*e,this._z=this._z*e,this._w=this._w*e),this._onChangeCallback(),this}multiply(e){return this.multiplyQuaternions(this,e)}premultiply(e){return this.multiplyQuaternions(e,this)}multiplyQuaternions(e,t){let n=e._x,s=e._y,r=e._z,o=e._w,a=t._x,l=t._y,c=t._z,h=t._w;return this._x=n*h+o*a+s*c-r*l,this._y=s*h+o*l+r*a-n*c,this._z=r*h+o*c+n*l-s*a,this._w=o*h-n*a-s*l-r*c,this._onChangeCallback(),this}slerp(e,t){let n=e._x,s=e._y,r=e._z,o=e._w,a=this.dot(e);a<0&&(n=-n,s=-s,r=-r,o=-o,a=-a);let l=1-t;if(a<.9995){let c=Math.acos(a),h=Math.sin(c);l=Math.sin(l*c)/h,t=Math.sin(t*c)/h,this._x=this._x*l+n*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this._onChangeCallback()}else this._x=this._x*l+n*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this.normalize();return this}slerpQuaternions(e,t,n){return this.copy(e).slerp(t,n)}random(){let e=2*Math.PI*Math.random(),t=2*Math.PI*Math.random(),n=Math.random(),s=Math.sqrt(1-n),r=Math.sqrt(n);return this.set(s*Math.sin(e),s*Math.cos(e),r*Math.sin(t),r*Math.cos(t))}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._w===this._w}fromArray(e,t=0){return this._x=e[t],this._y=e[t+1],this._z=e[t+2],this._w=e[t+3],this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._w,e}fromBufferAttribute(e,t){return this._x=e.getX(t),this._y=e.getY(t),this._z=e.getZ(t),this._w=e.getW(t),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},S=class{static{this.prototype.isVector3=!0}constructor(e=0,t=0,n=0){this.x=e,this.y=t,this.z=n}set(e,t,n){return n===void 0&&(n=this.z),this.x=e,this.y=t,this.z=n,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;default:throw new Error("THREE.Vector3: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this}multiplyVectors(e,t){return this.x=e.x*t.x,this.y=e.y*t.y,this.z=e.z*t.z,this}applyEuler(e){return this.applyQuaternion(Tg.setFromEuler(e))}applyAxisAngle(e,t){return this.applyQuaternion(Tg.setFromAxisAngle(e,t))}applyMatrix3(e){let t=this.x,n=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[3]*n+r[6]*s,this.y=r[1]*t+r[4]*n+r[7]*s,this.z=r[2]*t+r[5]*n+r[8]*s,this}applyNormalMatrix(e){return this.applyMatrix3(e).normalize()}applyMatrix4(e){let t=this.x,n=this.y,s=this.z,r=e.elements,o=1/(r[3]*t+r[7]*n+r[11]*s+r[15]);return this.x=(r[0]*t+r[4]*n+r[8]*s+r[12])*o,this.y=(r[1]*t+r[5]*n+r[9]*s+r[13])*o,this.z=(r[2]*t+r[6]*n+r[10]*s+r[14])*o,this}applyQuaternion(e){let t=this.x,n=this.y,s=this.z,r=e.x,o=e.y,a=e.z,l=e.w,c=2*(o*s-a*n),h=2*(a*t-r*s),u=2*(r*n-o*t);return this.x=t+l*c+o*u-a*h,this.y=n+l*h+a*c-r*u,this.z=s+l*u+r*h-o*c,this}project(e){return this.applyMatrix4(e.matrixWorldInverse).applyMatrix4(e.projectionMatrix)}unproject(e){return this.applyMatrix4(e.projectionMatrixInverse).applyMatrix4(e.matrixWorld)}transformDirection(e){let t=this.x,n=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[4]*n+r[8]*s,this.y=r[1]*t+r[5]*n+r[9]*s,this.z=r[2]*t+r[6]*n+r[10]*s,this.normalize()}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this}divideScalar(e){return this.multiplyScalar(1/e)}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this}clamp(e,t){return this.x=mt(this.x,e.x,t.x),this.y=mt(this.y,e.y,t.y),this.z=mt(this.z,e.z,t.z),this}clampScalar(e,t){return this.x=mt(this.x,e,t),this.y=mt(this.y,e,t),this.z=mt(this.z,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(mt(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this.z=e.z+(t.z-e.z)*n,this}cross(e){return this.crossVectors(this,e)}crossVectors(e,t){let n=e.x,s=e.y,r=e.z,o=t.x,a=t.y,l=t.z;return this.x=s*l-r*a,this.y=r*o-n*l,this.z=n*a-s*o,this}projectOnVector(e){let t=e.lengthSq();if(t===0)return this.set(0,0,0);let n=e.dot(this)/t;return this.copy(e).multiplyScalar(n)}projectOnPlane(e){return Qd.copy(this).projectOnVector(e),this.sub(Qd)}reflect(e){return this.sub(Qd.copy(e).multiplyScalar(2*this.dot(e)))}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let n=this.dot(e)/t;return Math.acos(mt(n,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,n=this.y-e.y,s=this.z-e.z;return t*t+n*n+s*s}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)+Math.abs(this.z-e.z)}setFromSpherical(e){return this.setFromSphericalCoords(e.radius,e.phi,e.theta)}setFromSphericalCoords(e,t,n){let s=Math.sin(t)*e;return this.x=s*Math.sin(n),this.y=Math.cos(t)*e,this.z=s*Math.cos(n),this}setFromCylindrical(e){return this.setFromCylindricalCoords(e.radius,e.theta,e.y)}setFromCylindricalCoords(e,t,n){return this.x=e*Math.sin(t),this.y=n,this.z=e*Math.cos(t),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this}setFromMatrixScale(e){let t=this.setFromMatrixColumn(e,0).length(),n=this.setFromMatrixColumn(e,1).length(),s=this.setFromMatrixColumn(e,2).length();return this.x=t,this.y=n,this.z=s,this}setFromMatrixColumn(e,t){return this.fromArray(e.elements,t*4)}setFromMatrix3Column(e,t){return this.fromArray(e.elements,t*3)}setFromEuler(e){return this.x=e._x,this.y=e._y,this.z=e._z,this}setFromColor(e){return this.x=e.r,this.y=e.g,this.z=e.b,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let e=Math.random()*Math.PI*2,t=Math.random()*2-1,n=Math.sqrt(1-t*t);return this.x=n*Math.cos(e),this.y=t,this.z=n*Math.sin(e),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},Qd=new S,Tg=new nt,yt=class{static{this.prototype.isMatrix3=!0}constructor(e,t,n,s,r,o,a,l,c){this.elements=[1,0,0,0,1,0,0,0,1],e!==void 0&&this.set(e,t,n,s,r,o,a,l,c)}set(e,t,n,s,r,o,a,l,c){let h=this.elements;return h[0]=e,h[1]=s,h[2]=a,h[3]=t,h[4]=r,h[5]=l,h[6]=n,h[7]=o,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(e){let t=this.elements,n=e.elements;return t[0]=n[0],t[1]=n[1],t[2]=n[2],t[3]=n[3],t[4]=n[4],t[5]=n[5],t[6]=n[6],t[7]=n[7],t[8]=n[8],this}extractBasis(e,t,n){return e.setFromMatrix3Column(this,0),t.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(e){let t=e.elements;return this.set(t[0],t[4],t[8],t[1],t[5],t[9],t[2],t[6],t[10]),this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let n=e.elements,s=t.elements,r=this.elements,o=n[0],a=n[3],l=n[6],c=n[1],h=n[4],u=n[7],d=n[2],f=n[5],p=n[8],v=s[0],g=s[3],m=s[6],y=s[1],b=s[4],x=s[7],T=s[2],M=s[5],_=s[8];return r[0]=o*v+a*y+l*T,r[3]=o*g+a*b+l*M,r[6]=o*m+a*x+l*_,r[1]=c*v+h*y+u*T,r[4]=c*g+h*b+u*M,r[7]=c*m+h*x+u*_,r[2]=d*v+f*y+p*T,r[5]=d*g+f*b+p*M,r[8]=d*m+f*x+p*_,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[3]*=e,t[6]*=e,t[1]*=e,t[4]*=e,t[7]*=e,t[2]*=e,t[5]*=e,t[8]*=e,this}determinant(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8];return t*o*h-t*a*c-n*r*h+n*a*l+s*r*c-s*o*l}invert(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8],u=h*o-a*c,d=a*l-h*r,f=c*r-o*l,p=t*u+n*d+s*f;if(p===0)return this.set(0,0,0,0,0,0,0,0,0);let v=1/p;return e[0]=u*v,e[1]=(s*c-h*n)*v,e[2]=(a*n-s*o)*v,e[3]=d*v,e[4]=(h*t-s*l)*v,e[5]=(s*r-a*t)*v,e[6]=f*v,e[7]=(n*l-c*t)*v,e[8]=(o*t-n*r)*v,this}transpose(){let e,t=this.elements;return e=t[1],t[1]=t[3],t[3]=e,e=t[2],t[2]=t[6],t[6]=e,e=t[5],t[5]=t[7],t[7]=e,this}getNormalMatrix(e){return this.setFromMatrix4(e).invert().transpose()}transposeIntoArray(e){let t=this.elements;return e[0]=t[0],e[1]=t[3],e[2]=t[6],e[3]=t[1],e[4]=t[4],e[5]=t[7],e[6]=t[2],e[7]=t[5],e[8]=t[8],this}setUvTransform(e,t,n,s,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(n*l,n*c,-n*(l*o+c*a)+o+e,-s*c,s*l,-s*(-c*o+l*a)+a+t,0,0,1),this}scale(e,t){return Ra("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(ef.makeScale(e,t)),this}rotate(e){return Ra("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(ef.makeRotation(-e)),this}translate(e,t){return Ra("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(ef.makeTranslation(e,t)),this}makeTranslation(e,t){return e.isVector2?this.set(1,0,e.x,0,1,e.y,0,0,1):this.set(1,0,e,0,1,t,0,0,1),this}makeRotation(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,-n,0,n,t,0,0,0,1),this}makeScale(e,t){return this.set(e,0,0,0,t,0,0,0,1),this}equals(e){let t=this.elements,n=e.elements;for(let s=0;s<9;s++)if(t[s]!==n[s])return!1;return!0}fromArray(e,t=0){for(let n=0;n<9;n++)this.elements[n]=e[n+t];return this}toArray(e=[],t=0){let n=this.elements;return e[t]=n[0],e[t+1]=n[1],e[t+2]=n[2],e[t+3]=n[3],e[t+4]=n[4],e[t+5]=n[5],e[t+6]=n[6],e[t+7]=n[7],e[t+8]=n[8],e}clone(){return new this.constructor().fromArray(this.elements)}},ef=new yt,Ag=new yt().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),Rg=new yt().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function nE(){let i={enabled:!0,workingColorSpace:Na,spaces:{},convert:function(s,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===Vt&&(s.r=Us(s.r),s.g=Us(s.g),s.b=Us(s.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===Vt&&(s.r=Ao(s.r),s.g=Ao(s.g),s.b=Ao(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===Ys?Da:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,o){return s.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},e=[.64,.33,.3,.6,.15,.06],t=[.2126,.7152,.0722],n=[.3127,.329];return i.define({[Na]:{primaries:e,whitePoint:n,transfer:Da,toXYZ:Ag,fromXYZ:Rg,luminanceCoefficients:t,workingColorSpaceConfig:{unpackColorSpace:Si},outputColorSpaceConfig:{drawingBufferColorSpace:Si}},[Si]:{primaries:e,whitePoint:n,transfer:Vt,toXYZ:Ag,fromXYZ:Rg,luminanceCoefficients:t,outputColorSpaceConfig:{drawingBufferColorSpace:Si}}}),i}var Ct=nE();function Us(i){return i<.04045?i*.0773993808:Math.pow(i*.9478672986+.0521327014,2.4)}function Ao(i){return i<.0031308?i*12.92:1.055*Math.pow(i,.41666)-.055}var co,Zc=class{static getDataURL(e,t="image/png"){if(/^data:/i.test(e.src)||typeof HTMLCanvasElement>"u")return e.src;let n;if(e instanceof HTMLCanvasElement)n=e;else{co===void 0&&(co=Fa("canvas")),co.width=e.width,co.height=e.height;let s=co.getContext("2d");e instanceof ImageData?s.putImageData(e,0,0):s.drawImage(e,0,0,e.width,e.height),n=co}return n.toDataURL(t)}static sRGBToLinear(e){if(typeof HTMLImageElement<"u"&&e instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&e instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&e instanceof ImageBitmap){let t=Fa("canvas");t.width=e.width,t.height=e.height;let n=t.getContext("2d");n.drawImage(e,0,0,e.width,e.height);let s=n.getImageData(0,0,e.width,e.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=Us(r[o]/255)*255;return n.putImageData(s,0,0),t}else if(e.data){let t=e.data.slice(0);for(let n=0;n<t.length;n++)t instanceof Uint8Array||t instanceof Uint8ClampedArray?t[n]=Math.floor(Us(t[n]/255)*255):t[n]=Us(t[n]);return{data:t,width:e.width,height:e.height}}else return it("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),e}},iE=0,Lo=class{constructor(e=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:iE++}),this.uuid=$s(),this.data=e,this.dataReady=!0,this.version=0}getSize(e){let t=this.data;return typeof HTMLVideoElement<"u"&&t instanceof HTMLVideoElement?e.set(t.videoWidth,t.videoHeight,0):typeof VideoFrame<"u"&&t instanceof VideoFrame?e.set(t.displayWidth,t.displayHeight,0):t!==null?e.set(t.width||0,t.height||0,t.depth||0):e.set(0,0,0),e}set needsUpdate(e){e===!0&&this.version++}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.images[this.uuid]!==void 0)return e.images[this.uuid];let n={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(tf(s[o].image)):r.push(tf(s[o]))}else r=tf(s);n.url=r}return t||(e.images[this.uuid]=n),n}};function tf(i){return typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&i instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&i instanceof ImageBitmap?Zc.getDataURL(i):i.data?{data:Array.from(i.data),width:i.width,height:i.height,type:i.data.constructor.name}:(it("Texture: Unable to serialize Texture."),{})}var sE=0,nf=new S,mi=class i extends Ji{constructor(e=i.DEFAULT_IMAGE,t=i.DEFAULT_MAPPING,n=fs,s=fs,r=oi,o=Xs,a=Ti,l=yi,c=i.DEFAULT_ANISOTROPY,h=Ys){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:sE++}),this.uuid=$s(),this.name="",this.source=new Lo(e),this.mipmaps=[],this.mapping=t,this.channel=0,this.wrapS=n,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new ue(0,0),this.repeat=new ue(1,1),this.center=new ue(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new yt,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(e&&e.depth&&e.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(nf).x}get height(){return this.source.getSize(nf).y}get depth(){return this.source.getSize(nf).z}get image(){return this.source.data}set image(e){this.source.data=e}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(e){return this.name=e.name,this.source=e.source,this.mipmaps=e.mipmaps.slice(0),this.mapping=e.mapping,this.channel=e.channel,this.wrapS=e.wrapS,this.wrapT=e.wrapT,this.magFilter=e.magFilter,this.minFilter=e.minFilter,this.anisotropy=e.anisotropy,this.format=e.format,this.internalFormat=e.internalFormat,this.type=e.type,this.normalized=e.normalized,this.offset.copy(e.offset),this.repeat.copy(e.repeat),this.center.copy(e.center),this.rotation=e.rotation,this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrix.copy(e.matrix),this.generateMipmaps=e.generateMipmaps,this.mipmapsAutoUpdate=e.mipmapsAutoUpdate,this.premultiplyAlpha=e.premultiplyAlpha,this.flipY=e.flipY,this.unpackAlignment=e.unpackAlignment,this.colorSpace=e.colorSpace,this.renderTarget=e.renderTarget,this.isRenderTargetTexture=e.isRenderTargetTexture,this.isPMREMTexture=e.isPMREMTexture,this.isArrayTexture=e.isArrayTexture,this.userData=JSON.parse(JSON.stringify(e.userData)),this.needsUpdate=!0,this}setValues(e){for(let t in e){let n=e[t];if(n===void 0){it(`Texture.setValues(): parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){it(`Texture.setValues(): property '${t}' does not exist.`);continue}s&&n&&s.isVector2&&n.isVector2||s&&n&&s.isVector3&&n.isVector3||s&&n&&s.isMatrix3&&n.isMatrix3?s.copy(n):this[t]=n}}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.textures[this.uuid]!==void 0)return e.textures[this.uuid];let n={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(e).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),t||(e.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(e){if(this.mapping!==tp)return e;if(e.applyMatrix3(this.matrix),e.x<0||e.x>1)switch(this.wrapS){case Yc:e.x=e.x-Math.floor(e.x);break;case fs:e.x=e.x<0?0:1;break;case $c:Math.abs(Math.floor(e.x)%2)===1?e.x=Math.ceil(e.x)-e.x:e.x=e.x-Math.floor(e.x);break}if(e.y<0||e.y>1)switch(this.wrapT){case Yc:e.y=e.y-Math.floor(e.y);break;case fs:e.y=e.y<0?0:1;break;case $c:Math.abs(Math.floor(e.y)%2)===1?e.y=Math.ceil(e.y)-e.y:e.y=e.y-Math.floor(e.y);break}return this.flipY&&(e.y=1-e.y),e}set needsUpdate(e){e===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(e){e===!0&&this.pmremVersion++}};mi.DEFAULT_IMAGE=null;mi.DEFAULT_MAPPING=tp;mi.DEFAULT_ANISOTROPY=1;var Gt=class{static{this.prototype.isVector4=!0}constructor(e=0,t=0,n=0,s=1){this.x=e,this.y=t,this.z=n,this.w=s}get width(){return this.z}set width(e){this.z=e}get height(){return this.w}set height(e){this.w=e}set(e,t,n,s){return this.x=e,this.y=t,this.z=n,this.w=s,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this.w=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setW(e){return this.w=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;case 3:this.w=t;break;default:throw new Error("THREE.Vector4: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this.w=e.w!==void 0?e.w:1,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this.w+=e.w,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this.w+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this.w=e.w+t.w,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this.w+=e.w*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this.w-=e.w,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this.w-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this.w=e.w-t.w,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this.w*=e.w,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this.w*=e,this}applyMatrix4(e){let t=this.x,n=this.y,s=this.z,r=this.w,o=e.elements;return this.x=o[0]*t+o[4]*n+o[8]*s+o[12]*r,this.y=o[1]*t+o[5]*n+o[9]*s+o[13]*r,this.z=o[2]*t+o[6]*n+o[10]*s+o[14]*r,this.w=o[3]*t+o[7]*n+o[11]*s+o[15]*r,this}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this.w/=e.w,this}divideScalar(e){return this.multiplyScalar(1/e)}setAxisAngleFromQuaternion(e){this.w=2*Math.acos(e.w);let t=Math.sqrt(1-e.w*e.w);return t<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=e.x/t,this.y=e.y/t,this.z=e.z/t),this}setAxisAngleFromRotationMatrix(e){let t,n,s,r,l=e.elements,c=l[0],h=l[4],u=l[8],d=l[1],f=l[5],p=l[9],v=l[2],g=l[6],m=l[10];if(Math.abs(h-d)<.01&&Math.abs(u-v)<.01&&Math.abs(p-g)<.01){if(Math.abs(h+d)<.1&&Math.abs(u+v)<.1&&Math.abs(p+g)<.1&&Math.abs(c+f+m-3)<.1)return this.set(1,0,0,0),this;t=Math.PI;let b=(c+1)/2,x=(f+1)/2,T=(m+1)/2,M=(h+d)/4,_=(u+v)/4,w=(p+g)/4;return b>x&&b>T?b<.01?(n=0,s=.707106781,r=.707106781):(n=Math.sqrt(b),s=M/n,r=_/n):x>T?x<.01?(n=.707106781,s=0,r=.707106781):(s=Math.sqrt(x),n=M/s,r=w/s):T<.01?(n=.707106781,s=.707106781,r=0):(r=Math.sqrt(T),n=_/r,s=w/r),this.set(n,s,r,t),this}let y=Math.sqrt((g-p)*(g-p)+(u-v)*(u-v)+(d-h)*(d-h));return Math.abs(y)<.001&&(y=1),this.x=(g-p)/y,this.y=(u-v)/y,this.z=(d-h)/y,this.w=Math.acos((c+f+m-1)/2),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this.w=t[15],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this.w=Math.min(this.w,e.w),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this.w=Math.max(this.w,e.w),this}clamp(e,t){return this.x=mt(this.x,e.x,t.x),this.y=mt(this.y,e.y,t.y),this.z=mt(this.z,e.z,t.z),this.w=mt(this.w,e.w,t.w),this}clampScalar(e,t){return this.x=mt(this.x,e,t),this.y=mt(this.y,e,t),this.z=mt(this.z,e,t),this.w=mt(this.w,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(mt(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z+this.w*e.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this.w+=(e.w-this.w)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this.z=e.z+(t.z-e.z)*n,this.w=e.w+(t.w-e.w)*n,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z&&e.w===this.w}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this.w=e[t+3],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e[t+3]=this.w,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this.w=e.getW(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},Jc=class extends Ji{constructor(e=1,t=1,n={}){super(),n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:oi,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},n),this.isRenderTarget=!0,this.width=e,this.height=t,this.depth=n.depth,this.scissor=new Gt(0,0,e,t),this.scissorTest=!1,this.viewport=new Gt(0,0,e,t),this.textures=[];let s=n.count;for(let r=0;r<s;r++)this.textures[r]=new mi({width:e,height:t,depth:n.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(n),this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveColorBuffer=n.resolveColorBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.storeMultisampledColorBuffer=n.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=n.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=n.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=n.depthTexture,this.samples=n.samples,this.multiview=n.multiview,this.useArrayDepthTexture=n.useArrayDepthTexture}_setTextureOptions(e={}){let t={minFilter:oi,generateMipmaps:!1,flipY:!1,internalFormat:null};e.mapping!==void 0&&(t.mapping=e.mapping),e.wrapS!==void 0&&(t.wrapS=e.wrapS),e.wrapT!==void 0&&(t.wrapT=e.wrapT),e.wrapR!==void 0&&(t.wrapR=e.wrapR),e.magFilter!==void 0&&(t.magFilter=e.magFilter),e.minFilter!==void 0&&(t.minFilter=e.minFilter),e.format!==void 0&&(t.format=e.format),e.type!==void 0&&(t.type=e.type),e.anisotropy!==void 0&&(t.anisotropy=e.anisotropy),e.colorSpace!==void 0&&(t.colorSpace=e.colorSpace),e.flipY!==void 0&&(t.flipY=e.flipY),e.generateMipmaps!==void 0&&(t.generateMipmaps=e.generateMipmaps),e.mipmapsAutoUpdate!==void 0&&(t.mipmapsAutoUpdate=e.mipmapsAutoUpdate),e.internalFormat!==void 0&&(t.internalFormat=e.internalFormat);for(let n=0;n<this.textures.length;n++)this.textures[n].setValues(t)}get texture(){return this.textures[0]}set texture(e){this.textures[0]=e}set depthTexture(e){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),e!==null&&e.renderTarget===null&&(e.renderTarget=this),this._depthTexture=e}get depthTexture(){return this._depthTexture}setSize(e,t,n=1){if(this.width!==e||this.height!==t||this.depth!==n){this.width=e,this.height=t,this.depth=n;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=e,this.textures[s].image.height=t,this.textures[s].image.depth=n,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,e,t),this.scissor.set(0,0,e,t)}clone(){return new this.constructor().copy(this)}copy(e){this.width=e.width,this.height=e.height,this.depth=e.depth,this.scissor.copy(e.scissor),this.scissorTest=e.scissorTest,this.viewport.copy(e.viewport),this.textures.length=0;for(let t=0,n=e.textures.length;t<n;t++){this.textures[t]=e.textures[t].clone(),this.textures[t].isRenderTargetTexture=!0,this.textures[t].renderTarget=this;let s=Object.assign({},e.textures[t].image);this.textures[t].source=new Lo(s)}if(this.depthBuffer=e.depthBuffer,this.stencilBuffer=e.stencilBuffer,this.resolveColorBuffer=e.resolveColorBuffer,this.resolveDepthBuffer=e.resolveDepthBuffer,this.resolveStencilBuffer=e.resolveStencilBuffer,this.storeMultisampledColorBuffer=e.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=e.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=e.storeMultisampledStencilBuffer,e.depthTexture!==null)if(e.depthTexture.renderTarget===e){let t=e.depthTexture.clone();t.renderTarget=null,this.depthTexture=t}else this.depthTexture=e.depthTexture;else this.depthTexture=null;return this.samples=e.samples,this.multiview=e.multiview,this.useArrayDepthTexture=e.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},Ai=class extends Jc{constructor(e=1,t=1,n={}){super(e,t,n),this.isWebGLRenderTarget=!0}},Ua=class extends mi{constructor(e=null,t=1,n=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:e,width:t,height:n,depth:s},this.magFilter=Bn,this.minFilter=Bn,this.wrapR=fs,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}addLayerUpdate(e){this.layerUpdates.add(e)}clearLayerUpdates(){this.layerUpdates.clear()}};var Kc=class extends mi{constructor(e=null,t=1,n=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:e,width:t,height:n,depth:s},this.magFilter=Bn,this.minFilter=Bn,this.wrapR=fs,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}};var Qe=class i{static{this.prototype.isMatrix4=!0}constructor(e,t,n,s,r,o,a,l,c,h,u,d,f,p,v,g){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],e!==void 0&&this.set(e,t,n,s,r,o,a,l,c,h,u,d,f,p,v,g)}set(e,t,n,s,r,o,a,l,c,h,u,d,f,p,v,g){let m=this.elements;return m[0]=e,m[4]=t,m[8]=n,m[12]=s,m[1]=r,m[5]=o,m[9]=a,m[13]=l,m[2]=c,m[6]=h,m[10]=u,m[14]=d,m[3]=f,m[7]=p,m[11]=v,m[15]=g,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new i().fromArray(this.elements)}copy(e){let t=this.elements,n=e.elements;return t[0]=n[0],t[1]=n[1],t[2]=n[2],t[3]=n[3],t[4]=n[4],t[5]=n[5],t[6]=n[6],t[7]=n[7],t[8]=n[8],t[9]=n[9],t[10]=n[10],t[11]=n[11],t[12]=n[12],t[13]=n[13],t[14]=n[14],t[15]=n[15],this}copyPosition(e){let t=this.elements,n=e.elements;return t[12]=n[12],t[13]=n[13],t[14]=n[14],this}setFromMatrix3(e){let t=e.elements;return this.set(t[0],t[3],t[6],0,t[1],t[4],t[7],0,t[2],t[5],t[8],0,0,0,0,1),this}extractBasis(e,t,n){return this.determinantAffine()===0?(e.set(1,0,0),t.set(0,1,0),n.set(0,0,1),this):(e.setFromMatrixColumn(this,0),t.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this)}makeBasis(e,t,n){return this.set(e.x,t.x,n.x,0,e.y,t.y,n.y,0,e.z,t.z,n.z,0,0,0,0,1),this}extractRotation(e){if(e.determinantAffine()===0)return this.identity();let t=this.elements,n=e.elements,s=1/ho.setFromMatrixColumn(e,0).length(),r=1/ho.setFromMatrixColumn(e,1).length(),o=1/ho.setFromMatrixColumn(e,2).length();return t[0]=n[0]*s,t[1]=n[1]*s,t[2]=n[2]*s,t[3]=0,t[4]=n[4]*r,t[5]=n[5]*r,t[6]=n[6]*r,t[7]=0,t[8]=n[8]*o,t[9]=n[9]*o,t[10]=n[10]*o,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromEuler(e){let t=this.elements,n=e.x,s=e.y,r=e.z,o=Math.cos(n),a=Math.sin(n),l=Math.cos(s),c=Math.sin(s),h=Math.cos(r),u=Math.sin(r);if(e.order==="XYZ"){let d=o*h,f=o*u,p=a*h,v=a*u;t[0]=l*h,t[4]=-l*u,t[8]=c,t[1]=f+p*c,t[5]=d-v*c,t[9]=-a*l,t[2]=v-d*c,t[6]=p+f*c,t[10]=o*l}else if(e.order==="YXZ"){let d=l*h,f=l*u,p=c*h,v=c*u;t[0]=d+v*a,t[4]=p*a-f,t[8]=o*c,t[1]=o*u,t[5]=o*h,t[9]=-a,t[2]=f*a-p,t[6]=v+d*a,t[10]=o*l}else if(e.order==="ZXY"){let d=l*h,f=l*u,p=c*h,v=c*u;t[0]=d-v*a,t[4]=-o*u,t[8]=p+f*a,t[1]=f+p*a,t[5]=o*h,t[9]=v-d*a,t[2]=-o*c,t[6]=a,t[10]=o*l}else if(e.order==="ZYX"){let d=o*h,f=o*u,p=a*h,v=a*u;t[0]=l*h,t[4]=p*c-f,t[8]=d*c+v,t[1]=l*u,t[5]=v*c+d,t[9]=f*c-p,t[2]=-c,t[6]=a*l,t[10]=o*l}else if(e.order==="YZX"){let d=o*l,f=o*c,p=a*l,v=a*c;t[0]=l*h,t[4]=v-d*u,t[8]=p*u+f,t[1]=u,t[5]=o*h,t[9]=-a*h,t[2]=-c*h,t[6]=f*u+p,t[10]=d-v*u}else if(e.order==="XZY"){let d=o*l,f=o*c,p=a*l,v=a*c;t[0]=l*h,t[4]=-u,t[8]=c*h,t[1]=d*u+v,t[5]=o*h,t[9]=f*u-p,t[2]=p*u-f,t[6]=a*h,t[10]=v*u+d}return t[3]=0,t[7]=0,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromQuaternion(e){return this.compose(rE,e,oE)}lookAt(e,t,n){let s=this.elements;return wi.subVectors(e,t),wi.lengthSq()===0&&(wi.z=1),wi.normalize(),ir.crossVectors(n,wi),ir.lengthSq()===0&&(Math.abs(n.z)===1?wi.x+=1e-4:wi.z+=1e-4,wi.normalize(),ir.crossVectors(n,wi)),ir.normalize(),ac.crossVectors(wi,ir),s[0]=ir.x,s[4]=ac.x,s[8]=wi.x,s[1]=ir.y,s[5]=ac.y,s[9]=wi.y,s[2]=ir.z,s[6]=ac.z,s[10]=wi.z,this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let n=e.elements,s=t.elements,r=this.elements,o=n[0],a=n[4],l=n[8],c=n[12],h=n[1],u=n[5],d=n[9],f=n[13],p=n[2],v=n[6],g=n[10],m=n[14],y=n[3],b=n[7],x=n[11],T=n[15],M=s[0],_=s[4],w=s[8],N=s[12],P=s[1],I=s[5],U=s[9],H=s[13],L=s[2],k=s[6],q=s[10],V=s[14],ce=s[3],Z=s[7],Q=s[11],te=s[15];return r[0]=o*M+a*P+l*L+c*ce,r[4]=o*_+a*I+l*k+c*Z,r[8]=o*w+a*U+l*q+c*Q,r[12]=o*N+a*H+l*V+c*te,r[1]=h*M+u*P+d*L+f*ce,r[5]=h*_+u*I+d*k+f*Z,r[9]=h*w+u*U+d*q+f*Q,r[13]=h*N+u*H+d*V+f*te,r[2]=p*M+v*P+g*L+m*ce,r[6]=p*_+v*I+g*k+m*Z,r[10]=p*w+v*U+g*q+m*Q,r[14]=p*N+v*H+g*V+m*te,r[3]=y*M+b*P+x*L+T*ce,r[7]=y*_+b*I+x*k+T*Z,r[11]=y*w+b*U+x*q+T*Q,r[15]=y*N+b*H+x*V+T*te,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[4]*=e,t[8]*=e,t[12]*=e,t[1]*=e,t[5]*=e,t[9]*=e,t[13]*=e,t[2]*=e,t[6]*=e,t[10]*=e,t[14]*=e,t[3]*=e,t[7]*=e,t[11]*=e,t[15]*=e,this}determinant(){let e=this.elements,t=e[0],n=e[4],s=e[8],r=e[12],o=e[1],a=e[5],l=e[9],c=e[13],h=e[2],u=e[6],d=e[10],f=e[14],p=e[3],v=e[7],g=e[11],m=e[15],y=l*f-c*d,b=a*f-c*u,x=a*d-l*u,T=o*f-c*h,M=o*d-l*h,_=o*u-a*h;return t*(v*y-g*b+m*x)-n*(p*y-g*T+m*M)+s*(p*b-v*T+m*_)-r*(p*x-v*M+g*_)}determinantAffine(){let e=this.elements,t=e[0],n=e[4],s=e[8],r=e[1],o=e[5],a=e[9],l=e[2],c=e[6],h=e[10];return t*(o*h-a*c)-n*(r*h-a*l)+s*(r*c-o*l)}transpose(){let e=this.elements,t;return t=e[1],e[1]=e[4],e[4]=t,t=e[2],e[2]=e[8],e[8]=t,t=e[6],e[6]=e[9],e[9]=t,t=e[3],e[3]=e[12],e[12]=t,t=e[7],e[7]=e[13],e[13]=t,t=e[11],e[11]=e[14],e[14]=t,this}setPosition(e,t,n){let s=this.elements;return e.isVector3?(s[12]=e.x,s[13]=e.y,s[14]=e.z):(s[12]=e,s[13]=t,s[14]=n),this}invert(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8],u=e[9],d=e[10],f=e[11],p=e[12],v=e[13],g=e[14],m=e[15],y=t*a-n*o,b=t*l-s*o,x=t*c-r*o,T=n*l-s*a,M=n*c-r*a,_=s*c-r*l,w=h*v-u*p,N=h*g-d*p,P=h*m-f*p,I=u*g-d*v,U=u*m-f*v,H=d*m-f*g,L=y*H-b*U+x*I+T*P-M*N+_*w;if(L===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let k=1/L;return e[0]=(a*H-l*U+c*I)*k,e[1]=(s*U-n*H-r*I)*k,e[2]=(v*_-g*M+m*T)*k,e[3]=(d*M-u*_-f*T)*k,e[4]=(l*P-o*H-c*N)*k,e[5]=(t*H-s*P+r*N)*k,e[6]=(g*x-p*_-m*b)*k,e[7]=(h*_-d*x+f*b)*k,e[8]=(o*U-a*P+c*w)*k,e[9]=(n*P-t*U-r*w)*k,e[10]=(p*M-v*x+m*y)*k,e[11]=(u*x-h*M-f*y)*k,e[12]=(a*N-o*I-l*w)*k,e[13]=(t*I-n*N+s*w)*k,e[14]=(v*b-p*T-g*y)*k,e[15]=(h*T-u*b+d*y)*k,this}scale(e){let t=this.elements,n=e.x,s=e.y,r=e.z;return t[0]*=n,t[4]*=s,t[8]*=r,t[1]*=n,t[5]*=s,t[9]*=r,t[2]*=n,t[6]*=s,t[10]*=r,t[3]*=n,t[7]*=s,t[11]*=r,this}getMaxScaleOnAxis(){let e=this.elements,t=e[0]*e[0]+e[1]*e[1]+e[2]*e[2],n=e[4]*e[4]+e[5]*e[5]+e[6]*e[6],s=e[8]*e[8]+e[9]*e[9]+e[10]*e[10];return Math.sqrt(Math.max(t,n,s))}makeTranslation(e,t,n){return e.isVector3?this.set(1,0,0,e.x,0,1,0,e.y,0,0,1,e.z,0,0,0,1):this.set(1,0,0,e,0,1,0,t,0,0,1,n,0,0,0,1),this}makeRotationX(e){let t=Math.cos(e),n=Math.sin(e);return this.set(1,0,0,0,0,t,-n,0,0,n,t,0,0,0,0,1),this}makeRotationY(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,0,n,0,0,1,0,0,-n,0,t,0,0,0,0,1),this}makeRotationZ(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,-n,0,0,n,t,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(e,t){let n=Math.cos(t),s=Math.sin(t),r=1-n,o=e.x,a=e.y,l=e.z,c=r*o,h=r*a;return this.set(c*o+n,c*a-s*l,c*l+s*a,0,c*a+s*l,h*a+n,h*l-s*o,0,c*l-s*a,h*l+s*o,r*l*l+n,0,0,0,0,1),this}makeScale(e,t,n){return this.set(e,0,0,0,0,t,0,0,0,0,n,0,0,0,0,1),this}makeShear(e,t,n,s,r,o){return this.set(1,n,r,0,e,1,o,0,t,s,1,0,0,0,0,1),this}compose(e,t,n){let s=this.elements,r=t._x,o=t._y,a=t._z,l=t._w,c=r+r,h=o+o,u=a+a,d=r*c,f=r*h,p=r*u,v=o*h,g=o*u,m=a*u,y=l*c,b=l*h,x=l*u,T=n.x,M=n.y,_=n.z;return s[0]=(1-(v+m))*T,s[1]=(f+x)*T,s[2]=(p-b)*T,s[3]=0,s[4]=(f-x)*M,s[5]=(1-(d+m))*M,s[6]=(g+y)*M,s[7]=0,s[8]=(p+b)*_,s[9]=(g-y)*_,s[10]=(1-(d+v))*_,s[11]=0,s[12]=e.x,s[13]=e.y,s[14]=e.z,s[15]=1,this}decompose(e,t,n){let s=this.elements;e.x=s[12],e.y=s[13],e.z=s[14];let r=this.determinantAffine();if(r===0)return n.set(1,1,1),t.identity(),this;let o=ho.set(s[0],s[1],s[2]).length(),a=ho.set(s[4],s[5],s[6]).length(),l=ho.set(s[8],s[9],s[10]).length();r<0&&(o=-o),$i.copy(this);let c=1/o,h=1/a,u=1/l;return $i.elements[0]*=c,$i.elements[1]*=c,$i.elements[2]*=c,$i.elements[4]*=h,$i.elements[5]*=h,$i.elements[6]*=h,$i.elements[8]*=u,$i.elements[9]*=u,$i.elements[10]*=u,t.setFromRotationMatrix($i),n.x=o,n.y=a,n.z=l,this}makePerspective(e,t,n,s,r,o,a=Ui,l=!1){let c=this.elements,h=2*r/(t-e),u=2*r/(n-s),d=(t+e)/(t-e),f=(n+s)/(n-s),p,v;if(l)p=r/(o-r),v=o*r/(o-r);else if(a===Ui)p=-(o+r)/(o-r),v=-2*o*r/(o-r);else if(a===Co)p=-o/(o-r),v=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=d,c[12]=0,c[1]=0,c[5]=u,c[9]=f,c[13]=0,c[2]=0,c[6]=0,c[10]=p,c[14]=v,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(e,t,n,s,r,o,a=Ui,l=!1){let c=this.elements,h=2/(t-e),u=2/(n-s),d=-(t+e)/(t-e),f=-(n+s)/(n-s),p,v;if(l)p=1/(o-r),v=o/(o-r);else if(a===Ui)p=-2/(o-r),v=-(o+r)/(o-r);else if(a===Co)p=-1/(o-r),v=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=0,c[12]=d,c[1]=0,c[5]=u,c[9]=0,c[13]=f,c[2]=0,c[6]=0,c[10]=p,c[14]=v,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(e){let t=this.elements,n=e.elements;for(let s=0;s<16;s++)if(t[s]!==n[s])return!1;return!0}fromArray(e,t=0){for(let n=0;n<16;n++)this.elements[n]=e[n+t];return this}toArray(e=[],t=0){let n=this.elements;return e[t]=n[0],e[t+1]=n[1],e[t+2]=n[2],e[t+3]=n[3],e[t+4]=n[4],e[t+5]=n[5],e[t+6]=n[6],e[t+7]=n[7],e[t+8]=n[8],e[t+9]=n[9],e[t+10]=n[10],e[t+11]=n[11],e[t+12]=n[12],e[t+13]=n[13],e[t+14]=n[14],e[t+15]=n[15],e}},ho=new S,$i=new Qe,rE=new S(0,0,0),oE=new S(1,1,1),ir=new S,ac=new S,wi=new S,Cg=new Qe,Pg=new nt,ps=class i{constructor(e=0,t=0,n=0,s=i.DEFAULT_ORDER){this.isEuler=!0,this._x=e,this._y=t,this._z=n,this._order=s}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get order(){return this._order}set order(e){this._order=e,this._onChangeCallback()}set(e,t,n,s=this._order){return this._x=e,this._y=t,this._z=n,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(e){return this._x=e._x,this._y=e._y,this._z=e._z,this._order=e._order,this._onChangeCallback(),this}setFromRotationMatrix(e,t=this._order,n=!0){let s=e.elements,r=s[0],o=s[4],a=s[8],l=s[1],c=s[5],h=s[9],u=s[2],d=s[6],f=s[10];switch(t){case"XYZ":this._y=Math.asin(mt(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,f),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(d,c),this._z=0);break;case"YXZ":this._x=Math.asin(-mt(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,f),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(mt(d,-1,1)),Math.abs(d)<.9999999?(this._y=Math.atan2(-u,f),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-mt(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(d,f),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(mt(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,f));break;case"XZY":this._z=Math.asin(-mt(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(d,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,f),this._y=0);break;default:it("Euler: .setFromRotationMatrix() encountered an unknown order: "+t)}return this._order=t,n===!0&&this._onChangeCallback(),this}setFromQuaternion(e,t,n){return Cg.makeRotationFromQuaternion(e),this.setFromRotationMatrix(Cg,t,n)}setFromVector3(e,t=this._order){return this.set(e.x,e.y,e.z,t)}reorder(e){return Pg.setFromEuler(this),this.setFromQuaternion(Pg,e)}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._order===this._order}fromArray(e){return this._x=e[0],this._y=e[1],this._z=e[2],e[3]!==void 0&&(this._order=e[3]),this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._order,e}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};ps.DEFAULT_ORDER="XYZ";var No=class{constructor(){this.mask=1}set(e){this.mask=(1<<e|0)>>>0}enable(e){this.mask|=1<<e|0}enableAll(){this.mask=-1}toggle(e){this.mask^=1<<e|0}disable(e){this.mask&=~(1<<e|0)}disableAll(){this.mask=0}test(e){return(this.mask&e.mask)!==0}isEnabled(e){return(this.mask&(1<<e|0))!==0}},aE=0,Ig=new S,uo=new nt,Ps=new Qe,lc=new S,_a=new S,lE=new S,cE=new nt,Lg=new S(1,0,0),Ng=new S(0,1,0),Dg=new S(0,0,1),Fg={type:"added"},hE={type:"removed"},fo={type:"childadded",child:null},sf={type:"childremoved",child:null},cn=class i extends Ji{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:aE++}),this.uuid=$s(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=i.DEFAULT_UP.clone();let e=new S,t=new ps,n=new nt,s=new S(1,1,1);function r(){n.setFromEuler(t,!1)}function o(){t.setFromQuaternion(n,void 0,!1)}t._onChange(r),n._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:e},rotation:{configurable:!0,enumerable:!0,value:t},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new Qe},normalMatrix:{value:new yt}}),this.matrix=new Qe,this.matrixWorld=new Qe,this.matrixAutoUpdate=i.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=i.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new No,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(e){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(e),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(e){return this.quaternion.premultiply(e),this}setRotationFromAxisAngle(e,t){this.quaternion.setFromAxisAngle(e,t)}setRotationFromEuler(e){this.quaternion.setFromEuler(e,!0)}setRotationFromMatrix(e){this.quaternion.setFromRotationMatrix(e)}setRotationFromQuaternion(e){this.quaternion.copy(e)}rotateOnAxis(e,t){return uo.setFromAxisAngle(e,t),this.quaternion.multiply(uo),this}rotateOnWorldAxis(e,t){return uo.setFromAxisAngle(e,t),this.quaternion.premultiply(uo),this}rotateX(e){return this.rotateOnAxis(Lg,e)}rotateY(e){return this.rotateOnAxis(Ng,e)}rotateZ(e){return this.rotateOnAxis(Dg,e)}translateOnAxis(e,t){return Ig.copy(e).applyQuaternion(this.quaternion),this.position.add(Ig.multiplyScalar(t)),this}translateX(e){return this.translateOnAxis(Lg,e)}translateY(e){return this.translateOnAxis(Ng,e)}translateZ(e){return this.translateOnAxis(Dg,e)}localToWorld(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(this.matrixWorld)}worldToLocal(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(Ps.copy(this.matrixWorld).invert())}lookAt(e,t,n){e.isVector3?lc.copy(e):lc.set(e,t,n);let s=this.parent;this.updateWorldMatrix(!0,!1),_a.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?Ps.lookAt(_a,lc,this.up):Ps.lookAt(lc,_a,this.up),this.quaternion.setFromRotationMatrix(Ps),s&&(Ps.extractRotation(s.matrixWorld),uo.setFromRotationMatrix(Ps),this.quaternion.premultiply(uo.invert()))}add(e){if(arguments.length>1){for(let t=0;t<arguments.length;t++)this.add(arguments[t]);return this}return e===this?(ht("Object3D.add: object can't be added as a child of itself.",e),this):(e&&e.isObject3D?(e.removeFromParent(),e.parent=this,this.children.push(e),e.dispatchEvent(Fg),fo.child=e,this.dispatchEvent(fo),fo.child=null):ht("Object3D.add: object not an instance of THREE.Object3D.",e),this)}remove(e){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}let t=this.children.indexOf(e);return t!==-1&&(e.parent=null,this.children.splice(t,1),e.dispatchEvent(hE),sf.child=e,this.dispatchEvent(sf),sf.child=null),this}removeFromParent(){let e=this.parent;return e!==null&&e.remove(this),this}clear(){return this.remove(...this.children)}attach(e){return this.updateWorldMatrix(!0,!1),Ps.copy(this.matrixWorld).invert(),e.parent!==null&&(e.parent.updateWorldMatrix(!0,!1),Ps.multiply(e.parent.matrixWorld)),e.applyMatrix4(Ps),e.removeFromParent(),e.parent=this,this.children.push(e),e.updateWorldMatrix(!1,!0),e.dispatchEvent(Fg),fo.child=e,this.dispatchEvent(fo),fo.child=null,this}getObjectById(e){return this.getObjectByProperty("id",e)}getObjectByName(e){return this.getObjectByProperty("name",e)}getObjectByProperty(e,t){if(this[e]===t)return this;for(let n=0,s=this.children.length;n<s;n++){let o=this.children[n].getObjectByProperty(e,t);if(o!==void 0)return o}}getObjectsByProperty(e,t,n=[]){this[e]===t&&n.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(e,t,n);return n}getWorldPosition(e){return this.updateWorldMatrix(!0,!1),e.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(_a,e,lE),e}getWorldScale(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(_a,cE,e),e}getWorldDirection(e){this.updateWorldMatrix(!0,!1);let t=this.matrixWorld.elements;return e.set(t[8],t[9],t[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(e){e(this);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].traverse(e)}traverseVisible(e){if(this.visible===!1)return;e(this);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].traverseVisible(e)}traverseAncestors(e){let t=this.parent;t!==null&&(e(t),t.traverseAncestors(e))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let e=this.pivot;if(e!==null){let t=e.x,n=e.y,s=e.z,r=this.matrix.elements;r[12]+=t-r[0]*t-r[4]*n-r[8]*s,r[13]+=n-r[1]*t-r[5]*n-r[9]*s,r[14]+=s-r[2]*t-r[6]*n-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(e){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||e)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,e=!0);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].updateMatrixWorld(e)}updateWorldMatrix(e,t,n=!1){let s=this.parent;if(e===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||n)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,n=!0),t===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,n)}}toJSON(e){let t=e===void 0||typeof e=="string",n={};t&&(e={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(a=>({...a})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(e),s.indirectTexture=this._indirectTexture.toJSON(e),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(e)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(e)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(e).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(e).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(e.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){let u=l[c];r(e.shapes,u)}else r(e.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(e.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(e.materials,this.material[l]));s.material=a}else s.material=r(e.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(e).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];s.animations.push(r(e.animations,l))}}if(t){let a=o(e.geometries),l=o(e.materials),c=o(e.textures),h=o(e.images),u=o(e.shapes),d=o(e.skeletons),f=o(e.animations),p=o(e.nodes);a.length>0&&(n.geometries=a),l.length>0&&(n.materials=l),c.length>0&&(n.textures=c),h.length>0&&(n.images=h),u.length>0&&(n.shapes=u),d.length>0&&(n.skeletons=d),f.length>0&&(n.animations=f),p.length>0&&(n.nodes=p)}return n.object=s,n;function o(a){let l=[];for(let c in a){let h=a[c];delete h.metadata,l.push(h)}return l}}clone(e){return new this.constructor().copy(this,e)}copy(e,t=!0){if(this.name=e.name,this.up.copy(e.up),this.position.copy(e.position),this.rotation.order=e.rotation.order,this.quaternion.copy(e.quaternion),this.scale.copy(e.scale),this.pivot=e.pivot!==null?e.pivot.clone():null,this.matrix.copy(e.matrix),this.matrixWorld.copy(e.matrixWorld),this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrixWorldAutoUpdate=e.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=e.matrixWorldNeedsUpdate,this.layers.mask=e.layers.mask,this.visible=e.visible,this.castShadow=e.castShadow,this.receiveShadow=e.receiveShadow,this.frustumCulled=e.frustumCulled,this.renderOrder=e.renderOrder,this.static=e.static,this.animations=e.animations.slice(),this.userData=JSON.parse(JSON.stringify(e.userData)),t===!0)for(let n=0;n<e.children.length;n++){let s=e.children[n];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};cn.DEFAULT_UP=new S(0,1,0);cn.DEFAULT_MATRIX_AUTO_UPDATE=!0;cn.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var Nt=class extends cn{constructor(){super(),this.isGroup=!0,this.type="Group"}},uE={type:"move"},Do=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Nt,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Nt,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new S,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new S),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Nt,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new S,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new S,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(e){return this._targetRay!==null&&this._targetRay.dispatchEvent(e),this._grip!==null&&this._grip.dispatchEvent(e),this._hand!==null&&this._hand.dispatchEvent(e),this}connect(e){if(e&&e.hand){let t=this._hand;if(t)for(let n of e.hand.values())this._getHandJoint(t,n)}return this.dispatchEvent({type:"connected",data:e}),this}disconnect(e){return this.dispatchEvent({type:"disconnected",data:e}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(e,t,n){let s=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(e&&t.session.visibilityState!=="visible-blurred"){if(c&&e.hand){o=!0;for(let v of e.hand.values()){let g=t.getJointPose(v,n),m=this._getHandJoint(c,v);g!==null&&(m.matrix.fromArray(g.transform.matrix),m.matrix.decompose(m.position,m.quaternion,m.scale),m.matrixWorldNeedsUpdate=!0,m.jointRadius=g.radius),m.visible=g!==null}let h=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],d=h.position.distanceTo(u.position),f=.02,p=.005;c.inputState.pinching&&d>f+p?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:e.handedness,target:this})):!c.inputState.pinching&&d<=f-p&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:e.handedness,target:this}))}else l!==null&&e.gripSpace&&(r=t.getPose(e.gripSpace,n),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:e,target:this})));a!==null&&(s=t.getPose(e.targetRaySpace,n),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(uE)))}return a!==null&&(a.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(e,t){if(e.joints[t.jointName]===void 0){let n=new Nt;n.matrixAutoUpdate=!1,n.visible=!1,e.joints[t.jointName]=n,e.add(n)}return e.joints[t.jointName]}},j0={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},sr={h:0,s:0,l:0},cc={h:0,s:0,l:0};function rf(i,e,t){return t<0&&(t+=1),t>1&&(t-=1),t<1/6?i+(e-i)*6*t:t<1/2?e:t<2/3?i+(e-i)*6*(2/3-t):i}var et=class{constructor(e,t,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(e,t,n)}set(e,t,n){if(t===void 0&&n===void 0){let s=e;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(e,t,n);return this}setScalar(e){return this.r=e,this.g=e,this.b=e,this}setHex(e,t=Si){return e=Math.floor(e),this.r=(e>>16&255)/255,this.g=(e>>8&255)/255,this.b=(e&255)/255,Ct.colorSpaceToWorking(this,t),this}setRGB(e,t,n,s=Ct.workingColorSpace){return this.r=e,this.g=t,this.b=n,Ct.colorSpaceToWorking(this,s),this}setHSL(e,t,n,s=Ct.workingColorSpace){if(e=fp(e,1),t=mt(t,0,1),n=mt(n,0,1),t===0)this.r=this.g=this.b=n;else{let r=n<=.5?n*(1+t):n+t-n*t,o=2*n-r;this.r=rf(o,r,e+1/3),this.g=rf(o,r,e),this.b=rf(o,r,e-1/3)}return Ct.colorSpaceToWorking(this,s),this}setStyle(e,t=Si){function n(r){r!==void 0&&parseFloat(r)<1&&it("Color: Alpha component of "+e+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(e)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,t);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,t);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,t);break;default:it("Color: Unknown color model "+e)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(e)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,t);if(o===6)return this.setHex(parseInt(r,16),t);it("Color: Invalid hex color "+e)}else if(e&&e.length>0)return this.setColorName(e,t);return this}setColorName(e,t=Si){let n=j0[e.toLowerCase()];return n!==void 0?this.setHex(n,t):it("Color: Unknown color "+e),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(e){return this.r=e.r,this.g=e.g,this.b=e.b,this}copySRGBToLinear(e){return this.r=Us(e.r),this.g=Us(e.g),this.b=Us(e.b),this}copyLinearToSRGB(e){return this.r=Ao(e.r),this.g=Ao(e.g),this.b=Ao(e.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(e=Si){return Ct.workingToColorSpace($n.copy(this),e),Math.round(mt($n.r*255,0,255))*65536+Math.round(mt($n.g*255,0,255))*256+Math.round(mt($n.b*255,0,255))}getHexString(e=Si){return("000000"+this.getHex(e).toString(16)).slice(-6)}getHSL(e,t=Ct.workingColorSpace){Ct.workingToColorSpace($n.copy(this),t);let n=$n.r,s=$n.g,r=$n.b,o=Math.max(n,s,r),a=Math.min(n,s,r),l,c,h=(a+o)/2;if(a===o)l=0,c=0;else{let u=o-a;switch(c=h<=.5?u/(o+a):u/(2-o-a),o){case n:l=(s-r)/u+(s<r?6:0);break;case s:l=(r-n)/u+2;break;case r:l=(n-s)/u+4;break}l/=6}return e.h=l,e.s=c,e.l=h,e}getRGB(e,t=Ct.workingColorSpace){return Ct.workingToColorSpace($n.copy(this),t),e.r=$n.r,e.g=$n.g,e.b=$n.b,e}getStyle(e=Si){Ct.workingToColorSpace($n.copy(this),e);let t=$n.r,n=$n.g,s=$n.b;return e!==Si?`color(${e} ${t.toFixed(3)} ${n.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(t*255)},${Math.round(n*255)},${Math.round(s*255)})`}offsetHSL(e,t,n){return this.getHSL(sr),this.setHSL(sr.h+e,sr.s+t,sr.l+n)}add(e){return this.r+=e.r,this.g+=e.g,this.b+=e.b,this}addColors(e,t){return this.r=e.r+t.r,this.g=e.g+t.g,this.b=e.b+t.b,this}addScalar(e){return this.r+=e,this.g+=e,this.b+=e,this}sub(e){return this.r=Math.max(0,this.r-e.r),this.g=Math.max(0,this.g-e.g),this.b=Math.max(0,this.b-e.b),this}multiply(e){return this.r*=e.r,this.g*=e.g,this.b*=e.b,this}multiplyScalar(e){return this.r*=e,this.g*=e,this.b*=e,this}lerp(e,t){return this.r+=(e.r-this.r)*t,this.g+=(e.g-this.g)*t,this.b+=(e.b-this.b)*t,this}lerpColors(e,t,n){return this.r=e.r+(t.r-e.r)*n,this.g=e.g+(t.g-e.g)*n,this.b=e.b+(t.b-e.b)*n,this}lerpHSL(e,t){this.getHSL(sr),e.getHSL(cc);let n=Ca(sr.h,cc.h,t),s=Ca(sr.s,cc.s,t),r=Ca(sr.l,cc.l,t);return this.setHSL(n,s,r),this}setFromVector3(e){return this.r=e.x,this.g=e.y,this.b=e.z,this}applyMatrix3(e){let t=this.r,n=this.g,s=this.b,r=e.elements;return this.r=r[0]*t+r[3]*n+r[6]*s,this.g=r[1]*t+r[4]*n+r[7]*s,this.b=r[2]*t+r[5]*n+r[8]*s,this}equals(e){return e.r===this.r&&e.g===this.g&&e.b===this.b}fromArray(e,t=0){return this.r=e[t],this.g=e[t+1],this.b=e[t+2],this}toArray(e=[],t=0){return e[t]=this.r,e[t+1]=this.g,e[t+2]=this.b,e}fromBufferAttribute(e,t){return this.r=e.getX(t),this.g=e.getY(t),this.b=e.getZ(t),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},$n=new et;et.NAMES=j0;var ka=class extends cn{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new ps,this.environmentIntensity=1,this.environmentRotation=new ps,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(e,t){return super.copy(e,t),this.background=e.background!==null?e.background.clone():null,this.environment=e.environment!==null?e.environment.clone():null,this.fog=e.fog!==null?e.fog.clone():null,this.backgroundBlurriness=e.backgroundBlurriness,this.backgroundIntensity=e.backgroundIntensity,this.backgroundRotation.copy(e.backgroundRotation),this.environmentIntensity=e.environmentIntensity,this.environmentRotation.copy(e.environmentRotation),this.overrideMaterial=e.overrideMaterial!==null?e.overrideMaterial.clone():null,this.matrixAutoUpdate=e.matrixAutoUpdate,this}toJSON(e){let t=super.toJSON(e);return this.fog!==null&&(t.object.fog=this.fog.toJSON()),t.object.backgroundBlurriness=this.backgroundBlurriness,t.object.backgroundIntensity=this.backgroundIntensity,t.object.backgroundRotation=this.backgroundRotation.toArray(),t.object.environmentIntensity=this.environmentIntensity,t.object.environmentRotation=this.environmentRotation.toArray(),t}},ji=new S,Is=new S,of=new S,Ls=new S,po=new S,mo=new S,Og=new S,af=new S,lf=new S,cf=new S,hf=new Gt,uf=new Gt,df=new Gt,Fs=class i{constructor(e=new S,t=new S,n=new S){this.a=e,this.b=t,this.c=n}static getNormal(e,t,n,s){s.subVectors(n,t),ji.subVectors(e,t),s.cross(ji);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(e,t,n,s,r){ji.subVectors(s,t),Is.subVectors(n,t),of.subVectors(e,t);let o=ji.dot(ji),a=ji.dot(Is),l=ji.dot(of),c=Is.dot(Is),h=Is.dot(of),u=o*c-a*a;if(u===0)return r.set(0,0,0),null;let d=1/u,f=(c*l-a*h)*d,p=(o*h-a*l)*d;return r.set(1-f-p,p,f)}static containsPoint(e,t,n,s){return this.getBarycoord(e,t,n,s,Ls)===null?!1:Ls.x>=0&&Ls.y>=0&&Ls.x+Ls.y<=1}static getInterpolation(e,t,n,s,r,o,a,l){return this.getBarycoord(e,t,n,s,Ls)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,Ls.x),l.addScaledVector(o,Ls.y),l.addScaledVector(a,Ls.z),l)}static getInterpolatedAttribute(e,t,n,s,r,o){return hf.setScalar(0),uf.setScalar(0),df.setScalar(0),hf.fromBufferAttribute(e,t),uf.fromBufferAttribute(e,n),df.fromBufferAttribute(e,s),o.setScalar(0),o.addScaledVector(hf,r.x),o.addScaledVector(uf,r.y),o.addScaledVector(df,r.z),o}static isFrontFacing(e,t,n,s){return ji.subVectors(n,t),Is.subVectors(e,t),ji.cross(Is).dot(s)<0}set(e,t,n){return this.a.copy(e),this.b.copy(t),this.c.copy(n),this}setFromPointsAndIndices(e,t,n,s){return this.a.copy(e[t]),this.b.copy(e[n]),this.c.copy(e[s]),this}setFromAttributeAndIndices(e,t,n,s){return this.a.fromBufferAttribute(e,t),this.b.fromBufferAttribute(e,n),this.c.fromBufferAttribute(e,s),this}clone(){return new this.constructor().copy(this)}copy(e){return this.a.copy(e.a),this.b.copy(e.b),this.c.copy(e.c),this}getArea(){return ji.subVectors(this.c,this.b),Is.subVectors(this.a,this.b),ji.cross(Is).length()*.5}getMidpoint(e){return e.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(e){return i.getNormal(this.a,this.b,this.c,e)}getPlane(e){return e.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(e,t){return i.getBarycoord(e,this.a,this.b,this.c,t)}getInterpolation(e,t,n,s,r){return i.getInterpolation(e,this.a,this.b,this.c,t,n,s,r)}containsPoint(e){return i.containsPoint(e,this.a,this.b,this.c)}isFrontFacing(e){return i.isFrontFacing(this.a,this.b,this.c,e)}intersectsBox(e){return e.intersectsTriangle(this)}closestPointToPoint(e,t){let n=this.a,s=this.b,r=this.c,o,a;po.subVectors(s,n),mo.subVectors(r,n),af.subVectors(e,n);let l=po.dot(af),c=mo.dot(af);if(l<=0&&c<=0)return t.copy(n);lf.subVectors(e,s);let h=po.dot(lf),u=mo.dot(lf);if(h>=0&&u<=h)return t.copy(s);let d=l*u-h*c;if(d<=0&&l>=0&&h<=0&&l-h>0)return o=l/(l-h),t.copy(n).addScaledVector(po,o);cf.subVectors(e,r);let f=po.dot(cf),p=mo.dot(cf);if(p>=0&&f<=p)return t.copy(r);let v=f*c-l*p;if(v<=0&&c>=0&&p<=0)return a=c/(c-p),t.copy(n).addScaledVector(mo,a);let g=h*p-f*u;if(g<=0&&u-h>=0&&f-p>=0)return Og.subVectors(r,s),a=(u-h)/(u-h+(f-p)),t.copy(s).addScaledVector(Og,a);let m=1/(g+v+d);return o=v*m,a=d*m,t.copy(n).addScaledVector(po,o).addScaledVector(mo,a)}equals(e){return e.a.equals(this.a)&&e.b.equals(this.b)&&e.c.equals(this.c)}},Ut=class{constructor(e=new S(1/0,1/0,1/0),t=new S(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=e,this.max=t}set(e,t){return this.min.copy(e),this.max.copy(t),this}setFromArray(e){this.makeEmpty();for(let t=0,n=e.length;t<n;t+=3)this.expandByPoint(Zi.fromArray(e,t));return this}setFromBufferAttribute(e){this.makeEmpty();for(let t=0,n=e.count;t<n;t++)this.expandByPoint(Zi.fromBufferAttribute(e,t));return this}setFromPoints(e){this.makeEmpty();for(let t=0,n=e.length;t<n;t++)this.expandByPoint(e[t]);return this}setFromCenterAndSize(e,t){let n=Zi.copy(t).multiplyScalar(.5);return this.min.copy(e).sub(n),this.max.copy(e).add(n),this}setFromObject(e,t=!1){return this.makeEmpty(),this.expandByObject(e,t)}clone(){return new this.constructor().copy(this)}copy(e){return this.min.copy(e.min),this.max.copy(e.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(e){return this.isEmpty()?e.set(0,0,0):e.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(e){return this.isEmpty()?e.set(0,0,0):e.subVectors(this.max,this.min)}expandByPoint(e){return this.min.min(e),this.max.max(e),this}expandByVector(e){return this.min.sub(e),this.max.add(e),this}expandByScalar(e){return this.min.addScalar(-e),this.max.addScalar(e),this}expandByObject(e,t=!1){e.updateWorldMatrix(!1,!1);let n=e.geometry;if(n!==void 0){let r=n.getAttribute("position");if(t===!0&&r!==void 0&&e.isInstancedMesh!==!0&&e.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)e.isMesh===!0?e.getVertexPosition(o,Zi):Zi.fromBufferAttribute(r,o),Zi.applyMatrix4(e.matrixWorld),this.expandByPoint(Zi);else e.boundingBox!==void 0?(e.boundingBox===null&&e.computeBoundingBox(),hc.copy(e.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),hc.copy(n.boundingBox)),hc.applyMatrix4(e.matrixWorld),this.union(hc)}let s=e.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],t);return this}containsPoint(e){return e.x>=this.min.x&&e.x<=this.max.x&&e.y>=this.min.y&&e.y<=this.max.y&&e.z>=this.min.z&&e.z<=this.max.z}containsBox(e){return this.min.x<=e.min.x&&e.max.x<=this.max.x&&this.min.y<=e.min.y&&e.max.y<=this.max.y&&this.min.z<=e.min.z&&e.max.z<=this.max.z}getParameter(e,t){return t.set((e.x-this.min.x)/(this.max.x-this.min.x),(e.y-this.min.y)/(this.max.y-this.min.y),(e.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(e){return e.max.x>=this.min.x&&e.min.x<=this.max.x&&e.max.y>=this.min.y&&e.min.y<=this.max.y&&e.max.z>=this.min.z&&e.min.z<=this.max.z}intersectsSphere(e){return this.clampPoint(e.center,Zi),Zi.distanceToSquared(e.center)<=e.radius*e.radius}intersectsPlane(e){let t,n;return e.normal.x>0?(t=e.normal.x*this.min.x,n=e.normal.x*this.max.x):(t=e.normal.x*this.max.x,n=e.normal.x*this.min.x),e.normal.y>0?(t+=e.normal.y*this.min.y,n+=e.normal.y*this.max.y):(t+=e.normal.y*this.max.y,n+=e.normal.y*this.min.y),e.normal.z>0?(t+=e.normal.z*this.min.z,n+=e.normal.z*this.max.z):(t+=e.normal.z*this.max.z,n+=e.normal.z*this.min.z),t<=-e.constant&&n>=-e.constant}intersectsTriangle(e){if(this.isEmpty())return!1;this.getCenter(ba),uc.subVectors(this.max,ba),go.subVectors(e.a,ba),yo.subVectors(e.b,ba),vo.subVectors(e.c,ba),rr.subVectors(yo,go),or.subVectors(vo,yo),Rr.subVectors(go,vo);let t=[0,-rr.z,rr.y,0,-or.z,or.y,0,-Rr.z,Rr.y,rr.z,0,-rr.x,or.z,0,-or.x,Rr.z,0,-Rr.x,-rr.y,rr.x,0,-or.y,or.x,0,-Rr.y,Rr.x,0];return!ff(t,go,yo,vo,uc)||(t=[1,0,0,0,1,0,0,0,1],!ff(t,go,yo,vo,uc))?!1:(dc.crossVectors(rr,or),t=[dc.x,dc.y,dc.z],ff(t,go,yo,vo,uc))}clampPoint(e,t){return t.copy(e).clamp(this.min,this.max)}distanceToPoint(e){return this.clampPoint(e,Zi).distanceTo(e)}getBoundingSphere(e){return this.isEmpty()?e.makeEmpty():(this.getCenter(e.center),e.radius=this.getSize(Zi).length()*.5),e}intersect(e){return this.min.max(e.min),this.max.min(e.max),this.isEmpty()&&this.makeEmpty(),this}union(e){return this.min.min(e.min),this.max.max(e.max),this}applyMatrix4(e){return this.isEmpty()?this:(Ns[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(e),Ns[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(e),Ns[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(e),Ns[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(e),Ns[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(e),Ns[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(e),Ns[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(e),Ns[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(e),this.setFromPoints(Ns),this)}translate(e){return this.min.add(e),this.max.add(e),this}equals(e){return e.min.equals(this.min)&&e.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(e){return this.min.fromArray(e.min),this.max.fromArray(e.max),this}},Ns=[new S,new S,new S,new S,new S,new S,new S,new S],Zi=new S,hc=new Ut,go=new S,yo=new S,vo=new S,rr=new S,or=new S,Rr=new S,ba=new S,uc=new S,dc=new S,Cr=new S;function ff(i,e,t,n,s){for(let r=0,o=i.length-3;r<=o;r+=3){Cr.fromArray(i,r);let a=s.x*Math.abs(Cr.x)+s.y*Math.abs(Cr.y)+s.z*Math.abs(Cr.z),l=e.dot(Cr),c=t.dot(Cr),h=n.dot(Cr);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>a)return!1}return!0}var En=new S,fc=new ue,dE=0,kt=class extends Ji{constructor(e,t,n=!1){if(super(),Array.isArray(e))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:dE++}),this.name="",this.array=e,this.itemSize=t,this.count=e!==void 0?e.length/t:0,this.normalized=n,this.usage=up,this.updateRanges=[],this.gpuType=pi,this.version=0,this._normalizationScale=e!==void 0?au(e):void 0}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.name=e.name,this.array=new e.array.constructor(e.array),this.itemSize=e.itemSize,this.count=e.count,this.normalized=e.normalized,this.usage=e.usage,this.gpuType=e.gpuType,this._normalizationScale=e._normalizationScale,this}copyAt(e,t,n){e*=this.itemSize,n*=t.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[e+s]=t.array[n+s];return this}copyArray(e){return this.array.set(e),this}applyMatrix3(e){if(this.itemSize===2)for(let t=0,n=this.count;t<n;t++)fc.fromBufferAttribute(this,t),fc.applyMatrix3(e),this.setXY(t,fc.x,fc.y);else if(this.itemSize===3)for(let t=0,n=this.count;t<n;t++)En.fromBufferAttribute(this,t),En.applyMatrix3(e),this.setXYZ(t,En.x,En.y,En.z);return this}applyMatrix4(e){for(let t=0,n=this.count;t<n;t++)En.fromBufferAttribute(this,t),En.applyMatrix4(e),this.setXYZ(t,En.x,En.y,En.z);return this}applyNormalMatrix(e){for(let t=0,n=this.count;t<n;t++)En.fromBufferAttribute(this,t),En.applyNormalMatrix(e),this.setXYZ(t,En.x,En.y,En.z);return this}transformDirection(e){for(let t=0,n=this.count;t<n;t++)En.fromBufferAttribute(this,t),En.transformDirection(e),this.setXYZ(t,En.x,En.y,En.z);return this}set(e,t=0){return this.array.set(e,t),this}getComponent(e,t){let n=this.array[e*this.itemSize+t];return this.normalized&&(n=this._denormalize(n)),n}setComponent(e,t,n){return this.normalized&&(n=this._normalize(n)),this.array[e*this.itemSize+t]=n,this}getX(e){let t=this.array[e*this.itemSize];return this.normalized&&(t=this._denormalize(t)),t}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize]=t,this}getY(e){let t=this.array[e*this.itemSize+1];return this.normalized&&(t=this._denormalize(t)),t}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+1]=t,this}getZ(e){let t=this.array[e*this.itemSize+2];return this.normalized&&(t=this._denormalize(t)),t}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+2]=t,this}getW(e){let t=this.array[e*this.itemSize+3];return this.normalized&&(t=this._denormalize(t)),t}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+3]=t,this}setXY(e,t,n){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n)),this.array[e+0]=t,this.array[e+1]=n,this}setXYZ(e,t,n,s){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s)),this.array[e+0]=t,this.array[e+1]=n,this.array[e+2]=s,this}setXYZW(e,t,n,s,r){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s),r=this._normalize(r)),this.array[e+0]=t,this.array[e+1]=n,this.array[e+2]=s,this.array[e+3]=r,this}onUpload(e){return this.onUploadCallback=e,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let e={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return e.name=this.name,e.usage=this.usage,e.gpuType=this.gpuType,e}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):mp(e,this.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):gp(e,this.array)}};var Ba=class extends kt{constructor(e,t,n){super(new Uint16Array(e),t,n)}};var Ha=class extends kt{constructor(e,t,n){super(new Uint32Array(e),t,n)}};var ot=class extends kt{constructor(e,t,n){super(new Float32Array(e),t,n)}},fE=new Ut,Ea=new S,pf=new S,Vn=class{constructor(e=new S,t=-1){this.isSphere=!0,this.center=e,this.radius=t}set(e,t){return this.center.copy(e),this.radius=t,this}setFromPoints(e,t){let n=this.center;t!==void 0?n.copy(t):fE.setFromPoints(e).getCenter(n);let s=0;for(let r=0,o=e.length;r<o;r++)s=Math.max(s,n.distanceToSquared(e[r]));return this.radius=Math.sqrt(s),this}copy(e){return this.center.copy(e.center),this.radius=e.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(e){return e.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(e){return e.distanceTo(this.center)-this.radius}intersectsSphere(e){let t=this.radius+e.radius;return e.center.distanceToSquared(this.center)<=t*t}intersectsBox(e){return e.intersectsSphere(this)}intersectsPlane(e){return Math.abs(e.distanceToPoint(this.center))<=this.radius}clampPoint(e,t){let n=this.center.distanceToSquared(e);return t.copy(e),n>this.radius*this.radius&&(t.sub(this.center).normalize(),t.multiplyScalar(this.radius).add(this.center)),t}getBoundingBox(e){return this.isEmpty()?(e.makeEmpty(),e):(e.set(this.center,this.center),e.expandByScalar(this.radius),e)}applyMatrix4(e){return this.center.applyMatrix4(e),this.radius=this.radius*e.getMaxScaleOnAxis(),this}translate(e){return this.center.add(e),this}expandByPoint(e){if(this.isEmpty())return this.center.copy(e),this.radius=0,this;Ea.subVectors(e,this.center);let t=Ea.lengthSq();if(t>this.radius*this.radius){let n=Math.sqrt(t),s=(n-this.radius)*.5;this.center.addScaledVector(Ea,s/n),this.radius+=s}return this}union(e){return e.isEmpty()?this:this.isEmpty()?(this.copy(e),this):(this.center.equals(e.center)===!0?this.radius=Math.max(this.radius,e.radius):(pf.subVectors(e.center,this.center).setLength(e.radius),this.expandByPoint(Ea.copy(e.center).add(pf)),this.expandByPoint(Ea.copy(e.center).sub(pf))),this)}equals(e){return e.center.equals(this.center)&&e.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(e){return this.radius=e.radius,this.center.fromArray(e.center),this}},pE=0,Oi=new Qe,mf=new cn,xo=new S,Mi=new Ut,wa=new Ut,kn=new S,St=class i extends Ji{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:pE++}),this.uuid=$s(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(e){return Array.isArray(e)?this.index=new(Bb(e)?Ha:Ba)(e,1):this.index=e,this}setIndirect(e,t=0){return this.indirect=e,this.indirectOffset=t,this}getIndirect(){return this.indirect}getAttribute(e){return this.attributes[e]}setAttribute(e,t){return this.attributes[e]=t,this}deleteAttribute(e){return delete this.attributes[e],this}hasAttribute(e){return this.attributes[e]!==void 0}addGroup(e,t,n=0){this.groups.push({start:e,count:t,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(e,t){this.drawRange.start=e,this.drawRange.count=t}applyMatrix4(e){let t=this.attributes.position;t!==void 0&&(t.applyMatrix4(e),t.needsUpdate=!0);let n=this.attributes.normal;if(n!==void 0){let r=new yt().getNormalMatrix(e);n.applyNormalMatrix(r),n.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(e),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(e){return Oi.makeRotationFromQuaternion(e),this.applyMatrix4(Oi),this}rotateX(e){return Oi.makeRotationX(e),this.applyMatrix4(Oi),this}rotateY(e){return Oi.makeRotationY(e),this.applyMatrix4(Oi),this}rotateZ(e){return Oi.makeRotationZ(e),this.applyMatrix4(Oi),this}translate(e,t,n){return Oi.makeTranslation(e,t,n),this.applyMatrix4(Oi),this}scale(e,t,n){return Oi.makeScale(e,t,n),this.applyMatrix4(Oi),this}lookAt(e){return mf.lookAt(e),mf.updateMatrix(),this.applyMatrix4(mf.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(xo).negate(),this.translate(xo.x,xo.y,xo.z),this}setFromPoints(e){let t=this.getAttribute("position");if(t===void 0){let n=[];for(let s=0,r=e.length;s<r;s++){let o=e[s];n.push(o.x,o.y,o.z||0)}this.setAttribute("position",new ot(n,3))}else{let n=Math.min(e.length,t.count);for(let s=0;s<n;s++){let r=e[s];t.setXYZ(s,r.x,r.y,r.z||0)}e.length>t.count&&it("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),t.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Ut);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){ht("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new S(-1/0,-1/0,-1/0),new S(1/0,1/0,1/0));return}if(e!==void 0){if(this.boundingBox.setFromBufferAttribute(e),t)for(let n=0,s=t.length;n<s;n++){let r=t[n];Mi.setFromBufferAttribute(r),this.morphTargetsRelative?(kn.addVectors(this.boundingBox.min,Mi.min),this.boundingBox.expandByPoint(kn),kn.addVectors(this.boundingBox.max,Mi.max),this.boundingBox.expandByPoint(kn)):(this.boundingBox.expandByPoint(Mi.min),this.boundingBox.expandByPoint(Mi.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&ht('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Vn);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){ht("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new S,1/0);return}if(e){let n=this.boundingSphere.center;if(Mi.setFromBufferAttribute(e),t)for(let r=0,o=t.length;r<o;r++){let a=t[r];wa.setFromBufferAttribute(a),this.morphTargetsRelative?(kn.addVectors(Mi.min,wa.min),Mi.expandByPoint(kn),kn.addVectors(Mi.max,wa.max),Mi.expandByPoint(kn)):(Mi.expandByPoint(wa.min),Mi.expandByPoint(wa.max))}Mi.getCenter(n);let s=0;for(let r=0,o=e.count;r<o;r++)kn.fromBufferAttribute(e,r),s=Math.max(s,n.distanceToSquared(kn));if(t)for(let r=0,o=t.length;r<o;r++){let a=t[r],l=this.morphTargetsRelative;for(let c=0,h=a.count;c<h;c++)kn.fromBufferAttribute(a,c),l&&(xo.fromBufferAttribute(e,c),kn.add(xo)),s=Math.max(s,n.distanceToSquared(kn))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&ht('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let e=this.index,t=this.attributes;if(e===null||t.position===void 0||t.normal===void 0||t.uv===void 0){ht("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let n=t.position,s=t.normal,r=t.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==n.count)&&(o=new kt(new Float32Array(4*n.count),4),this.setAttribute("tangent",o));let a=[],l=[],c=new Uint8Array(n.count);for(let N=0;N<n.count;N++)a[N]=new S,l[N]=new S;let h=new S,u=new S,d=new S,f=new ue,p=new ue,v=new ue,g=new S,m=new S;function y(N,P,I){c[N]=c[P]=c[I]=1,h.fromBufferAttribute(n,N),u.fromBufferAttribute(n,P),d.fromBufferAttribute(n,I),f.fromBufferAttribute(r,N),p.fromBufferAttribute(r,P),v.fromBufferAttribute(r,I),u.sub(h),d.sub(h),p.sub(f),v.sub(f);let U=1/(p.x*v.y-v.x*p.y);isFinite(U)&&(g.copy(u).multiplyScalar(v.y).addScaledVector(d,-p.y).multiplyScalar(U),m.copy(d).multiplyScalar(p.x).addScaledVector(u,-v.x).multiplyScalar(U),a[N].add(g),a[P].add(g),a[I].add(g),l[N].add(m),l[P].add(m),l[I].add(m))}let b=this.groups;b.length===0&&(b=[{start:0,count:e.count}]);for(let N=0,P=b.length;N<P;++N){let I=b[N],U=I.start,H=I.count;for(let L=U,k=U+H;L<k;L+=3)y(e.getX(L+0),e.getX(L+1),e.getX(L+2))}let x=new S,T=new S,M=new S,_=new S;function w(N){M.fromBufferAttribute(s,N),_.copy(M);let P=a[N];x.copy(P),x.sub(M.multiplyScalar(M.dot(P))).normalize(),T.crossVectors(_,P);let U=T.dot(l[N])<0?-1:1;o.setXYZW(N,x.x,x.y,x.z,U)}for(let N=0,P=n.count;N<P;++N)c[N]&&w(N);this._transformed=!0}computeVertexNormals(){let e=this.index,t=this.getAttribute("position");if(t!==void 0){let n=this.getAttribute("normal");if(n===void 0||n.count!==t.count)n=new kt(new Float32Array(t.count*3),3),this.setAttribute("normal",n);else for(let d=0,f=n.count;d<f;d++)n.setXYZ(d,0,0,0);let s=new S,r=new S,o=new S,a=new S,l=new S,c=new S,h=new S,u=new S;if(e)for(let d=0,f=e.count;d<f;d+=3){let p=e.getX(d+0),v=e.getX(d+1),g=e.getX(d+2);s.fromBufferAttribute(t,p),r.fromBufferAttribute(t,v),o.fromBufferAttribute(t,g),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),a.fromBufferAttribute(n,p),l.fromBufferAttribute(n,v),c.fromBufferAttribute(n,g),a.add(h),l.add(h),c.add(h),n.setXYZ(p,a.x,a.y,a.z),n.setXYZ(v,l.x,l.y,l.z),n.setXYZ(g,c.x,c.y,c.z)}else for(let d=0,f=t.count;d<f;d+=3)s.fromBufferAttribute(t,d+0),r.fromBufferAttribute(t,d+1),o.fromBufferAttribute(t,d+2),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),n.setXYZ(d+0,h.x,h.y,h.z),n.setXYZ(d+1,h.x,h.y,h.z),n.setXYZ(d+2,h.x,h.y,h.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){let e=this.attributes.normal;for(let t=0,n=e.count;t<n;t++)kn.fromBufferAttribute(e,t),kn.normalize(),e.setXYZ(t,kn.x,kn.y,kn.z)}toNonIndexed(){function e(a,l){let c=a.array,h=a.itemSize,u=a.normalized,d=new c.constructor(l.length*h),f=0,p=0;for(let v=0,g=l.length;v<g;v++){a.isInterleavedBufferAttribute?f=l[v]*a.data.stride+a.offset:f=l[v]*h;for(let m=0;m<h;m++)d[p++]=c[f++]}return new kt(d,h,u)}if(this.index===null)return it("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let t=new i,n=this.index.array,s=this.attributes;for(let a in s){let l=s[a],c=e(l,n);t.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let h=0,u=c.length;h<u;h++){let d=c[h],f=e(d,n);l.push(f)}t.morphAttributes[a]=l}t.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];t.addGroup(c.start,c.count,c.materialIndex)}return t}toJSON(){let e={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(e.uuid=this.uuid,e.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,e.name=this.name,Object.keys(this.userData).length>0&&(e.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(e[c]=l[c]);return e}e.data={attributes:{}};let t=this.index;t!==null&&(e.data.index={type:t.array.constructor.name,array:Array.prototype.slice.call(t.array)});let n=this.attributes;for(let l in n){let c=n[l];e.data.attributes[l]=c.toJSON(e.data)}let s={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],h=[];for(let u=0,d=c.length;u<d;u++){let f=c[u];h.push(f.toJSON(e.data))}h.length>0&&(s[l]=h,r=!0)}r&&(e.data.morphAttributes=s,e.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(e.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(e.data.boundingSphere=a.toJSON()),e}clone(){return new this.constructor().copy(this)}copy(e){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let t={};this.name=e.name;let n=e.index;n!==null&&this.setIndex(n.clone());let s=e.attributes;for(let c in s){let h=s[c];this.setAttribute(c,h.clone(t))}let r=e.morphAttributes;for(let c in r){let h=[],u=r[c];for(let d=0,f=u.length;d<f;d++)h.push(u[d].clone(t));this.morphAttributes[c]=h}this.morphTargetsRelative=e.morphTargetsRelative;let o=e.groups;for(let c=0,h=o.length;c<h;c++){let u=o[c];this.addGroup(u.start,u.count,u.materialIndex)}let a=e.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=e.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=e.drawRange.start,this.drawRange.count=e.drawRange.count,this.userData=e.userData,this._transformed=e._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}},za=class{constructor(e,t){this.isInterleavedBuffer=!0,this.array=e,this.stride=t,this.count=e!==void 0?e.length/t:0,this.usage=up,this.updateRanges=[],this.version=0,this.uuid=$s()}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.array=new e.array.constructor(e.array),this.count=e.count,this.stride=e.stride,this.usage=e.usage,this}copyAt(e,t,n){e*=this.stride,n*=t.stride;for(let s=0,r=this.stride;s<r;s++)this.array[e+s]=t.array[n+s];return this}set(e,t=0){return this.array.set(e,t),this}clone(e){e.arrayBuffers===void 0&&(e.arrayBuffers={});let t=Ug(this.array);e.arrayBuffers[t]===void 0&&(e.arrayBuffers[t]=this.array.slice(0).buffer);let n=new this.array.constructor(e.arrayBuffers[t]),s=new this.constructor(n,this.stride);return s.setUsage(this.usage),s}onUpload(e){return this.onUploadCallback=e,this}toJSON(e){e.arrayBuffers===void 0&&(e.arrayBuffers={});let t=Ug(this.array);e.arrayBuffers[t]===void 0&&(e.arrayBuffers[t]=Array.from(new Uint32Array(this.array.slice(0).buffer)));let n={uuid:this.uuid,buffer:t,type:this.array.constructor.name,stride:this.stride};return n.usage=this.usage,n}};function Ug(i){return i.buffer._uuid===void 0&&(i.buffer._uuid=$s()),i.byteOffset===0&&i.byteLength===i.buffer.byteLength?i.buffer._uuid:i.buffer._uuid+":"+i.byteOffset+":"+i.byteLength}var ii=new S,ki=class i{constructor(e,t,n,s=!1){this.isInterleavedBufferAttribute=!0,this.name="",this.data=e,this.itemSize=t,this.offset=n,this.normalized=s,this._normalizationScale=e!==void 0?au(e.array):void 0}get count(){return this.data.count}get array(){return this.data.array}set needsUpdate(e){this.data.needsUpdate=e}applyMatrix4(e){for(let t=0,n=this.data.count;t<n;t++)ii.fromBufferAttribute(this,t),ii.applyMatrix4(e),this.setXYZ(t,ii.x,ii.y,ii.z);return this}applyNormalMatrix(e){for(let t=0,n=this.count;t<n;t++)ii.fromBufferAttribute(this,t),ii.applyNormalMatrix(e),this.setXYZ(t,ii.x,ii.y,ii.z);return this}transformDirection(e){for(let t=0,n=this.count;t<n;t++)ii.fromBufferAttribute(this,t),ii.transformDirection(e),this.setXYZ(t,ii.x,ii.y,ii.z);return this}getComponent(e,t){let n=this.array[e*this.data.stride+this.offset+t];return this.normalized&&(n=this._denormalize(n)),n}setComponent(e,t,n){return this.normalized&&(n=this._normalize(n)),this.data.array[e*this.data.stride+this.offset+t]=n,this}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset]=t,this}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+1]=t,this}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+2]=t,this}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+3]=t,this}getX(e){let t=this.data.array[e*this.data.stride+this.offset];return this.normalized&&(t=this._denormalize(t)),t}getY(e){let t=this.data.array[e*this.data.stride+this.offset+1];return this.normalized&&(t=this._denormalize(t)),t}getZ(e){let t=this.data.array[e*this.data.stride+this.offset+2];return this.normalized&&(t=this._denormalize(t)),t}getW(e){let t=this.data.array[e*this.data.stride+this.offset+3];return this.normalized&&(t=this._denormalize(t)),t}setXY(e,t,n){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),n=this._normalize(n)),this.data.array[e+0]=t,this.data.array[e+1]=n,this}setXYZ(e,t,n,s){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s)),this.data.array[e+0]=t,this.data.array[e+1]=n,this.data.array[e+2]=s,this}setXYZW(e,t,n,s,r){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s),r=this._normalize(r)),this.data.array[e+0]=t,this.data.array[e+1]=n,this.data.array[e+2]=s,this.data.array[e+3]=r,this}clone(e){if(e===void 0){Oa("InterleavedBufferAttribute.clone(): Cloning an interleaved buffer attribute will de-interleave buffer data.");let t=[];for(let n=0;n<this.count;n++){let s=n*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)t.push(this.data.array[s+r])}return new kt(new this.array.constructor(t),this.itemSize,this.normalized)}else return e.interleavedBuffers===void 0&&(e.interleavedBuffers={}),e.interleavedBuffers[this.data.uuid]===void 0&&(e.interleavedBuffers[this.data.uuid]=this.data.clone(e)),new i(e.interleavedBuffers[this.data.uuid],this.itemSize,this.offset,this.normalized)}toJSON(e){if(e===void 0){Oa("InterleavedBufferAttribute.toJSON(): Serializing an interleaved buffer attribute will de-interleave buffer data.");let t=[];for(let n=0;n<this.count;n++){let s=n*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)t.push(this.data.array[s+r])}return{itemSize:this.itemSize,type:this.array.constructor.name,array:t,normalized:this.normalized}}else return e.interleavedBuffers===void 0&&(e.interleavedBuffers={}),e.interleavedBuffers[this.data.uuid]===void 0&&(e.interleavedBuffers[this.data.uuid]=this.data.toJSON(e)),{isInterleavedBufferAttribute:!0,itemSize:this.itemSize,data:this.data.uuid,offset:this.offset,normalized:this.normalized}}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):mp(e,this.data.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):gp(e,this.data.array)}},gf=new S,mE=new S,gE=new yt,si=class{constructor(e=new S(1,0,0),t=0){this.isPlane=!0,this.normal=e,this.constant=t}set(e,t){return this.normal.copy(e),this.constant=t,this}setComponents(e,t,n,s){return this.normal.set(e,t,n),this.constant=s,this}setFromNormalAndCoplanarPoint(e,t){return this.normal.copy(e),this.constant=-t.dot(this.normal),this}setFromCoplanarPoints(e,t,n){let s=gf.subVectors(n,t).cross(mE.subVectors(e,t)).normalize();return this.setFromNormalAndCoplanarPoint(s,e),this}copy(e){return this.normal.copy(e.normal),this.constant=e.constant,this}normalize(){let e=1/this.normal.length();return this.normal.multiplyScalar(e),this.constant*=e,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(e){return this.normal.dot(e)+this.constant}distanceToSphere(e){return this.distanceToPoint(e.center)-e.radius}projectPoint(e,t){return t.copy(e).addScaledVector(this.normal,-this.distanceToPoint(e))}intersectLine(e,t,n=!0){let s=e.delta(gf),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(e.start)===0?t.copy(e.start):null;let o=-(e.start.dot(this.normal)+this.constant)/r;return n===!0&&(o<0||o>1)?null:t.copy(e.start).addScaledVector(s,o)}intersectsLine(e){let t=this.distanceToPoint(e.start),n=this.distanceToPoint(e.end);return t<0&&n>0||n<0&&t>0}intersectsBox(e){return e.intersectsPlane(this)}intersectsSphere(e){return e.intersectsPlane(this)}coplanarPoint(e){return e.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(e,t){let n=t||gE.getNormalMatrix(e),s=this.coplanarPoint(gf).applyMatrix4(e),r=this.normal.applyMatrix3(n).normalize();return this.constant=-s.dot(r),this}translate(e){return this.constant-=e.dot(this.normal),this}equals(e){return e.normal.equals(this.normal)&&e.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(e){return this.normal.fromArray(e.normal),this.constant=e.constant,this}},yE=0,Ki=class extends Ji{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:yE++}),this.uuid=$s(),this.name="",this.type="Material",this.blending=Vo,this.side=vr,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=qf,this.blendDst=Yf,this.blendEquation=Ur,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new et(0,0,0),this.blendAlpha=0,this.depthFunc=Ro,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=B0,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=Bc,this.stencilZFail=Bc,this.stencilZPass=Bc,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(e){this._alphaTest>0!=e>0&&this.version++,this._alphaTest=e}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(e){if(e!==void 0)for(let t in e){let n=e[t];if(n===void 0){it(`Material: parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){it(`Material: '${t}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(n):s&&s.isVector2&&n&&n.isVector2||s&&s.isEuler&&n&&n.isEuler||s&&s.isVector3&&n&&n.isVector3?s.copy(n):this[t]=n}}toJSON(e){let t=e===void 0||typeof e=="string";t&&(e={textures:{},images:{}});let n={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,n.blending=this.blending,n.side=this.side,n.shadowSide=this.shadowSide,n.vertexColors=this.vertexColors,n.opacity=this.opacity,n.transparent=this.transparent,n.blendSrc=this.blendSrc,n.blendDst=this.blendDst,n.blendEquation=this.blendEquation,n.blendSrcAlpha=this.blendSrcAlpha,n.blendDstAlpha=this.blendDstAlpha,n.blendEquationAlpha=this.blendEquationAlpha,n.blendColor=this.blendColor.getHex(),n.blendAlpha=this.blendAlpha,n.depthFunc=this.depthFunc,n.depthTest=this.depthTest,n.depthWrite=this.depthWrite,n.colorWrite=this.colorWrite,n.clipIntersection=this.clipIntersection,n.clipShadows=this.clipShadows,n.stencilWriteMask=this.stencilWriteMask,n.stencilFunc=this.stencilFunc,n.stencilRef=this.stencilRef,n.stencilFuncMask=this.stencilFuncMask,n.stencilFail=this.stencilFail,n.stencilZFail=this.stencilZFail,n.stencilZPass=this.stencilZPass,n.stencilWrite=this.stencilWrite,n.polygonOffset=this.polygonOffset,n.polygonOffsetFactor=this.polygonOffsetFactor,n.polygonOffsetUnits=this.polygonOffsetUnits,n.dithering=this.dithering,n.alphaTest=this.alphaTest,n.alphaHash=this.alphaHash,n.alphaToCoverage=this.alphaToCoverage,n.premultipliedAlpha=this.premultipliedAlpha,n.forceSinglePass=this.forceSinglePass,n.allowOverride=this.allowOverride,n.visible=this.visible,n.toneMapped=this.toneMapped,n.name=this.name,this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(n.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(n.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(e).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(e).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(e).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(e).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(n.sheenColorMap=this.sheenColorMap.toJSON(e).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(n.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(e).uuid),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(n.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(n.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(n.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(e).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(e).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(e).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(e).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(e).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(e).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(e).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(e).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(e).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(e).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(e).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(e).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(e).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(e).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(e).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(e).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(e).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(e).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(e).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(e).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(e).uuid),this.attenuationDistance!==void 0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(n.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(n.rotation=this.rotation),this.depthPacking!==void 0&&(n.depthPacking=this.depthPacking),this.linewidth!==void 0&&(n.linewidth=this.linewidth),this.linecap!==void 0&&(n.linecap=this.linecap),this.linejoin!==void 0&&(n.linejoin=this.linejoin),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.wireframe!==void 0&&(n.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(n.flatShading=this.flatShading),this.fog!==void 0&&(n.fog=this.fog),Object.keys(this.userData).length>0&&(n.userData=this.userData);function s(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(t){let r=s(e.textures),o=s(e.images);r.length>0&&(n.textures=r),o.length>0&&(n.images=o)}return n}fromJSON(e,t){if(e.uuid!==void 0&&(this.uuid=e.uuid),e.name!==void 0&&(this.name=e.name),e.color!==void 0&&this.color!==void 0&&this.color.setHex(e.color),e.roughness!==void 0&&(this.roughness=e.roughness),e.metalness!==void 0&&(this.metalness=e.metalness),e.sheen!==void 0&&(this.sheen=e.sheen),e.sheenColor!==void 0&&(this.sheenColor=new et().setHex(e.sheenColor)),e.sheenRoughness!==void 0&&(this.sheenRoughness=e.sheenRoughness),e.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(e.emissive),e.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(e.specular),e.specularIntensity!==void 0&&(this.specularIntensity=e.specularIntensity),e.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(e.specularColor),e.shininess!==void 0&&(this.shininess=e.shininess),e.clearcoat!==void 0&&(this.clearcoat=e.clearcoat),e.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=e.clearcoatRoughness),e.diffuseRoughness!==void 0&&(this.diffuseRoughness=e.diffuseRoughness),e.dispersion!==void 0&&(this.dispersion=e.dispersion),e.retroreflectivity!==void 0&&(this.retroreflectivity=e.retroreflectivity),e.iridescence!==void 0&&(this.iridescence=e.iridescence),e.iridescenceIOR!==void 0&&(this.iridescenceIOR=e.iridescenceIOR),e.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessMinimum),e.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=e.iridescenceThicknessMaximum),e.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=e.iridescenceThicknessRange[1]),e.transmission!==void 0&&(this.transmission=e.transmission),e.thickness!==void 0&&(this.thickness=e.thickness),e.attenuationDistance!==void 0&&(this.attenuationDistance=e.attenuationDistance),e.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(e.attenuationColor),e.anisotropy!==void 0&&(this.anisotropy=e.anisotropy),e.anisotropyRotation!==void 0&&(this.anisotropyRotation=e.anisotropyRotation),e.fog!==void 0&&(this.fog=e.fog),e.flatShading!==void 0&&(this.flatShading=e.flatShading),e.blending!==void 0&&(this.blending=e.blending),e.combine!==void 0&&(this.combine=e.combine),e.side!==void 0&&(this.side=e.side),e.shadowSide!==void 0&&(this.shadowSide=e.shadowSide),e.opacity!==void 0&&(this.opacity=e.opacity),e.transparent!==void 0&&(this.transparent=e.transparent),e.alphaTest!==void 0&&(this.alphaTest=e.alphaTest),e.alphaHash!==void 0&&(this.alphaHash=e.alphaHash),e.depthFunc!==void 0&&(this.depthFunc=e.depthFunc),e.depthTest!==void 0&&(this.depthTest=e.depthTest),e.depthWrite!==void 0&&(this.depthWrite=e.depthWrite),e.colorWrite!==void 0&&(this.colorWrite=e.colorWrite),e.clippingPlanes!==void 0&&(this.clippingPlanes=e.clippingPlanes.map(n=>new si().fromJSON(n))),e.clipIntersection!==void 0&&(this.clipIntersection=e.clipIntersection),e.clipShadows!==void 0&&(this.clipShadows=e.clipShadows),e.depthPacking!==void 0&&(this.depthPacking=e.depthPacking),e.blendSrc!==void 0&&(this.blendSrc=e.blendSrc),e.blendDst!==void 0&&(this.blendDst=e.blendDst),e.blendEquation!==void 0&&(this.blendEquation=e.blendEquation),e.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=e.blendSrcAlpha),e.blendDstAlpha!==void 0&&(this.blendDstAlpha=e.blendDstAlpha),e.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=e.blendEquationAlpha),e.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(e.blendColor),e.blendAlpha!==void 0&&(this.blendAlpha=e.blendAlpha),e.stencilWriteMask!==void 0&&(this.stencilWriteMask=e.stencilWriteMask),e.stencilFunc!==void 0&&(this.stencilFunc=e.stencilFunc),e.stencilRef!==void 0&&(this.stencilRef=e.stencilRef),e.stencilFuncMask!==void 0&&(this.stencilFuncMask=e.stencilFuncMask),e.stencilFail!==void 0&&(this.stencilFail=e.stencilFail),e.stencilZFail!==void 0&&(this.stencilZFail=e.stencilZFail),e.stencilZPass!==void 0&&(this.stencilZPass=e.stencilZPass),e.stencilWrite!==void 0&&(this.stencilWrite=e.stencilWrite),e.wireframe!==void 0&&(this.wireframe=e.wireframe),e.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=e.wireframeLinewidth),e.wireframeLinecap!==void 0&&(this.wireframeLinecap=e.wireframeLinecap),e.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=e.wireframeLinejoin),e.rotation!==void 0&&(this.rotation=e.rotation),e.linewidth!==void 0&&(this.linewidth=e.linewidth),e.linecap!==void 0&&(this.linecap=e.linecap),e.linejoin!==void 0&&(this.linejoin=e.linejoin),e.dashSize!==void 0&&(this.dashSize=e.dashSize),e.gapSize!==void 0&&(this.gapSize=e.gapSize),e.scale!==void 0&&(this.scale=e.scale),e.polygonOffset!==void 0&&(this.polygonOffset=e.polygonOffset),e.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=e.polygonOffsetFactor),e.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=e.polygonOffsetUnits),e.dithering!==void 0&&(this.dithering=e.dithering),e.alphaToCoverage!==void 0&&(this.alphaToCoverage=e.alphaToCoverage),e.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=e.premultipliedAlpha),e.forceSinglePass!==void 0&&(this.forceSinglePass=e.forceSinglePass),e.allowOverride!==void 0&&(this.allowOverride=e.allowOverride),e.visible!==void 0&&(this.visible=e.visible),e.toneMapped!==void 0&&(this.toneMapped=e.toneMapped),e.userData!==void 0&&(this.userData=e.userData),e.vertexColors!==void 0&&(typeof e.vertexColors=="number"?this.vertexColors=e.vertexColors>0:this.vertexColors=e.vertexColors),e.size!==void 0&&(this.size=e.size),e.sizeAttenuation!==void 0&&(this.sizeAttenuation=e.sizeAttenuation),e.map!==void 0&&(this.map=t[e.map]||null),e.matcap!==void 0&&(this.matcap=t[e.matcap]||null),e.alphaMap!==void 0&&(this.alphaMap=t[e.alphaMap]||null),e.bumpMap!==void 0&&(this.bumpMap=t[e.bumpMap]||null),e.bumpScale!==void 0&&(this.bumpScale=e.bumpScale),e.normalMap!==void 0&&(this.normalMap=t[e.normalMap]||null),e.normalMapType!==void 0&&(this.normalMapType=e.normalMapType),e.normalScale!==void 0){let n=e.normalScale;Array.isArray(n)===!1&&(n=[n,n]),this.normalScale=new ue().fromArray(n)}return e.displacementMap!==void 0&&(this.displacementMap=t[e.displacementMap]||null),e.displacementScale!==void 0&&(this.displacementScale=e.displacementScale),e.displacementBias!==void 0&&(this.displacementBias=e.displacementBias),e.roughnessMap!==void 0&&(this.roughnessMap=t[e.roughnessMap]||null),e.metalnessMap!==void 0&&(this.metalnessMap=t[e.metalnessMap]||null),e.emissiveMap!==void 0&&(this.emissiveMap=t[e.emissiveMap]||null),e.emissiveIntensity!==void 0&&(this.emissiveIntensity=e.emissiveIntensity),e.specularMap!==void 0&&(this.specularMap=t[e.specularMap]||null),e.specularIntensityMap!==void 0&&(this.specularIntensityMap=t[e.specularIntensityMap]||null),e.specularColorMap!==void 0&&(this.specularColorMap=t[e.specularColorMap]||null),e.envMap!==void 0&&(this.envMap=t[e.envMap]||null),e.envMapRotation!==void 0&&this.envMapRotation.fromArray(e.envMapRotation),e.envMapIntensity!==void 0&&(this.envMapIntensity=e.envMapIntensity),e.reflectivity!==void 0&&(this.reflectivity=e.reflectivity),e.refractionRatio!==void 0&&(this.refractionRatio=e.refractionRatio),e.lightMap!==void 0&&(this.lightMap=t[e.lightMap]||null),e.lightMapIntensity!==void 0&&(this.lightMapIntensity=e.lightMapIntensity),e.aoMap!==void 0&&(this.aoMap=t[e.aoMap]||null),e.aoMapIntensity!==void 0&&(this.aoMapIntensity=e.aoMapIntensity),e.gradientMap!==void 0&&(this.gradientMap=t[e.gradientMap]||null),e.clearcoatMap!==void 0&&(this.clearcoatMap=t[e.clearcoatMap]||null),e.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=t[e.clearcoatRoughnessMap]||null),e.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=t[e.clearcoatNormalMap]||null),e.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new ue().fromArray(e.clearcoatNormalScale)),e.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=t[e.diffuseRoughnessMap]||null),e.iridescenceMap!==void 0&&(this.iridescenceMap=t[e.iridescenceMap]||null),e.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=t[e.iridescenceThicknessMap]||null),e.transmissionMap!==void 0&&(this.transmissionMap=t[e.transmissionMap]||null),e.thicknessMap!==void 0&&(this.thicknessMap=t[e.thicknessMap]||null),e.anisotropyMap!==void 0&&(this.anisotropyMap=t[e.anisotropyMap]||null),e.sheenColorMap!==void 0&&(this.sheenColorMap=t[e.sheenColorMap]||null),e.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=t[e.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(e){this.name=e.name,this.blending=e.blending,this.side=e.side,this.vertexColors=e.vertexColors,this.opacity=e.opacity,this.transparent=e.transparent,this.blendSrc=e.blendSrc,this.blendDst=e.blendDst,this.blendEquation=e.blendEquation,this.blendSrcAlpha=e.blendSrcAlpha,this.blendDstAlpha=e.blendDstAlpha,this.blendEquationAlpha=e.blendEquationAlpha,this.blendColor.copy(e.blendColor),this.blendAlpha=e.blendAlpha,this.depthFunc=e.depthFunc,this.depthTest=e.depthTest,this.depthWrite=e.depthWrite,this.stencilWriteMask=e.stencilWriteMask,this.stencilFunc=e.stencilFunc,this.stencilRef=e.stencilRef,this.stencilFuncMask=e.stencilFuncMask,this.stencilFail=e.stencilFail,this.stencilZFail=e.stencilZFail,this.stencilZPass=e.stencilZPass,this.stencilWrite=e.stencilWrite;let t=e.clippingPlanes,n=null;if(t!==null){let s=t.length;n=new Array(s);for(let r=0;r!==s;++r)n[r]=t[r].clone()}return this.clippingPlanes=n,this.clipIntersection=e.clipIntersection,this.clipShadows=e.clipShadows,this.shadowSide=e.shadowSide,this.colorWrite=e.colorWrite,this.precision=e.precision,this.polygonOffset=e.polygonOffset,this.polygonOffsetFactor=e.polygonOffsetFactor,this.polygonOffsetUnits=e.polygonOffsetUnits,this.dithering=e.dithering,this.alphaTest=e.alphaTest,this.alphaHash=e.alphaHash,this.alphaToCoverage=e.alphaToCoverage,this.premultipliedAlpha=e.premultipliedAlpha,this.forceSinglePass=e.forceSinglePass,this.allowOverride=e.allowOverride,this.visible=e.visible,this.toneMapped=e.toneMapped,this.userData=JSON.parse(JSON.stringify(e.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(e){e===!0&&this.version++}};var Ds=new S,yf=new S,pc=new S,mc=new S,cr=class{constructor(e=new S,t=new S(0,0,-1)){this.origin=e,this.direction=t}set(e,t){return this.origin.copy(e),this.direction.copy(t),this}copy(e){return this.origin.copy(e.origin),this.direction.copy(e.direction),this}at(e,t){return t.copy(this.origin).addScaledVector(this.direction,e)}lookAt(e){return this.direction.copy(e).sub(this.origin).normalize(),this}recast(e){return this.origin.copy(this.at(e,Ds)),this}closestPointToPoint(e,t){t.subVectors(e,this.origin);let n=t.dot(this.direction);return n<0?t.copy(this.origin):t.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(e){return Math.sqrt(this.distanceSqToPoint(e))}distanceSqToPoint(e){let t=Ds.subVectors(e,this.origin).dot(this.direction);return t<0?this.origin.distanceToSquared(e):(Ds.copy(this.origin).addScaledVector(this.direction,t),Ds.distanceToSquared(e))}distanceSqToSegment(e,t,n,s){yf.copy(e).add(t).multiplyScalar(.5),pc.copy(t).sub(e).normalize(),mc.copy(this.origin).sub(yf);let r=e.distanceTo(t)*.5,o=-this.direction.dot(pc),a=mc.dot(this.direction),l=-mc.dot(pc),c=mc.lengthSq(),h=Math.abs(1-o*o),u,d,f,p;if(h>0)if(u=o*l-a,d=o*a-l,p=r*h,u>=0)if(d>=-p)if(d<=p){let v=1/h;u*=v,d*=v,f=u*(u+o*d+2*a)+d*(o*u+d+2*l)+c}else d=r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d=-r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d<=-p?(u=Math.max(0,-(-o*r+a)),d=u>0?-r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c):d<=p?(u=0,d=Math.min(Math.max(-r,-l),r),f=d*(d+2*l)+c):(u=Math.max(0,-(o*r+a)),d=u>0?r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c);else d=o>0?-r:r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;return n&&n.copy(this.origin).addScaledVector(this.direction,u),s&&s.copy(yf).addScaledVector(pc,d),f}intersectSphere(e,t){if(e.radius<0)return null;Ds.subVectors(e.center,this.origin);let n=Ds.dot(this.direction),s=Ds.dot(Ds)-n*n,r=e.radius*e.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=n-o,l=n+o;return l<0?null:a<0?this.at(l,t):this.at(a,t)}intersectsSphere(e){return e.radius<0?!1:this.distanceSqToPoint(e.center)<=e.radius*e.radius}distanceToPlane(e){let t=e.normal.dot(this.direction);if(t===0)return e.distanceToPoint(this.origin)===0?0:null;let n=-(this.origin.dot(e.normal)+e.constant)/t;return n>=0?n:null}intersectPlane(e,t){let n=this.distanceToPlane(e);return n===null?null:this.at(n,t)}intersectsPlane(e){let t=e.distanceToPoint(this.origin);return t===0||e.normal.dot(this.direction)*t<0}intersectBox(e,t){let n,s,r,o,a,l,c=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,d=this.origin;return c>=0?(n=(e.min.x-d.x)*c,s=(e.max.x-d.x)*c):(n=(e.max.x-d.x)*c,s=(e.min.x-d.x)*c),h>=0?(r=(e.min.y-d.y)*h,o=(e.max.y-d.y)*h):(r=(e.max.y-d.y)*h,o=(e.min.y-d.y)*h),n>o||r>s||((r>n||isNaN(n))&&(n=r),(o<s||isNaN(s))&&(s=o),u>=0?(a=(e.min.z-d.z)*u,l=(e.max.z-d.z)*u):(a=(e.max.z-d.z)*u,l=(e.min.z-d.z)*u),n>l||a>s)||((a>n||n!==n)&&(n=a),(l<s||s!==s)&&(s=l),s<0)?null:this.at(n>=0?n:s,t)}intersectsBox(e){return this.intersectBox(e,Ds)!==null}intersectTriangle(e,t,n,s,r){let o=this.origin,a=this.direction,l=a.x,c=a.y,h=a.z,u=e.x-o.x,d=e.y-o.y,f=e.z-o.z,p=t.x-o.x,v=t.y-o.y,g=t.z-o.z,m=n.x-o.x,y=n.y-o.y,b=n.z-o.z,x=Math.abs(l),T=Math.abs(c),M=Math.abs(h),_,w,N,P,I,U,H,L,k,q,V,ce;if(x>=T&&x>=M?(N=l,U=u,k=p,ce=m,l>=0?(_=c,w=h,P=d,I=f,H=v,L=g,q=y,V=b):(_=h,w=c,P=f,I=d,H=g,L=v,q=b,V=y)):T>=M?(N=c,U=d,k=v,ce=y,c>=0?(_=h,w=l,P=f,I=u,H=g,L=p,q=b,V=m):(_=l,w=h,P=u,I=f,H=p,L=g,q=m,V=b)):(N=h,U=f,k=g,ce=b,h>=0?(_=l,w=c,P=u,I=d,H=p,L=v,q=m,V=y):(_=c,w=l,P=d,I=u,H=v,L=p,q=y,V=m)),N===0)return null;let Z=_/N,Q=w/N,te=1/N,pe=P-Z*U,he=I-Q*U,ee=H-Z*k,ye=L-Q*k,xe=q-Z*ce,Le=V-Q*ce,Me=xe*ye-Le*ee,Ve=pe*Le-he*xe,at=ee*he-ye*pe;if(s){if(Me<0||Ve<0||at<0)return null}else if((Me<0||Ve<0||at<0)&&(Me>0||Ve>0||at>0))return null;let Ze=Me+Ve+at;if(Ze===0)return null;let lt=te*(Me*U+Ve*k+at*ce);return(Ze>0?lt<0:lt>0)?null:this.at(lt/Ze,r)}applyMatrix4(e){return this.origin.applyMatrix4(e),this.direction.transformDirection(e),this}equals(e){return e.origin.equals(this.origin)&&e.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},Rn=class extends Ki{constructor(e){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new et(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new ps,this.combine=vl,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.fog=e.fog,this}},kg=new Qe,Pr=new cr,gc=new Vn,Bg=new S,yc=new S,vc=new S,xc=new S,vf=new S,_c=new S,Hg=new S,bc=new S,wt=class extends cn{constructor(e=new St,t=new Rn){super(),this.isMesh=!0,this.type="Mesh",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let s=t[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(e,t){let n=this.geometry,s=n.attributes.position,r=n.morphAttributes.position,o=n.morphTargetsRelative;t.fromBufferAttribute(s,e);let a=this.morphTargetInfluences;if(r&&a){_c.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let h=a[l],u=r[l];h!==0&&(vf.fromBufferAttribute(u,e),o?_c.addScaledVector(vf,h):_c.addScaledVector(vf.sub(t),h))}t.add(_c)}return t}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),gc.copy(n.boundingSphere),gc.applyMatrix4(r),Pr.copy(e.ray).recast(e.near),!(gc.containsPoint(Pr.origin)===!1&&(Pr.intersectSphere(gc,Bg)===null||Pr.origin.distanceToSquared(Bg)>(e.far-e.near)**2))&&(kg.copy(r).invert(),Pr.copy(e.ray).applyMatrix4(kg),!(n.boundingBox!==null&&Pr.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(e,t,Pr)))}_computeIntersections(e,t,n){let s,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,d=r.groups,f=r.drawRange;if(a!==null)if(Array.isArray(o))for(let p=0,v=d.length;p<v;p++){let g=d[p],m=o[g.materialIndex],y=Math.max(g.start,f.start),b=Math.min(a.count,Math.min(g.start+g.count,f.start+f.count));for(let x=y,T=b;x<T;x+=3){let M=a.getX(x),_=a.getX(x+1),w=a.getX(x+2);s=Ec(this,m,e,n,c,h,u,M,_,w),s&&(s.faceIndex=Math.floor(x/3),s.face.materialIndex=g.materialIndex,t.push(s))}}else{let p=Math.max(0,f.start),v=Math.min(a.count,f.start+f.count);for(let g=p,m=v;g<m;g+=3){let y=a.getX(g),b=a.getX(g+1),x=a.getX(g+2);s=Ec(this,o,e,n,c,h,u,y,b,x),s&&(s.faceIndex=Math.floor(g/3),t.push(s))}}else if(l!==void 0)if(Array.isArray(o))for(let p=0,v=d.length;p<v;p++){let g=d[p],m=o[g.materialIndex],y=Math.max(g.start,f.start),b=Math.min(l.count,Math.min(g.start+g.count,f.start+f.count));for(let x=y,T=b;x<T;x+=3){let M=x,_=x+1,w=x+2;s=Ec(this,m,e,n,c,h,u,M,_,w),s&&(s.faceIndex=Math.floor(x/3),s.face.materialIndex=g.materialIndex,t.push(s))}}else{let p=Math.max(0,f.start),v=Math.min(l.count,f.start+f.count);for(let g=p,m=v;g<m;g+=3){let y=g,b=g+1,x=g+2;s=Ec(this,o,e,n,c,h,u,y,b,x),s&&(s.faceIndex=Math.floor(g/3),t.push(s))}}}};function vE(i,e,t,n,s,r,o,a){let l;if(e.side===li?l=n.intersectTriangle(o,r,s,!0,a):l=n.intersectTriangle(s,r,o,e.side===vr,a),l===null)return null;bc.copy(a),bc.applyMatrix4(i.matrixWorld);let c=t.ray.origin.distanceTo(bc);return c<t.near||c>t.far?null:{distance:c,point:bc.clone(),object:i}}function Ec(i,e,t,n,s,r,o,a,l,c){i.getVertexPosition(a,yc),i.getVertexPosition(l,vc),i.getVertexPosition(c,xc);let h=vE(i,e,t,n,yc,vc,xc,Hg);if(h){let u=new S;Fs.getBarycoord(Hg,yc,vc,xc,u),s&&(h.uv=Fs.getInterpolatedAttribute(s,a,l,c,u,new ue)),r&&(h.uv1=Fs.getInterpolatedAttribute(r,a,l,c,u,new ue)),o&&(h.normal=Fs.getInterpolatedAttribute(o,a,l,c,u,new S),h.normal.dot(n.direction)>0&&h.normal.multiplyScalar(-1));let d={a,b:l,c,normal:new S,materialIndex:0};Fs.getNormal(yc,vc,xc,d.normal),h.face=d,h.barycoord=u}return h}var lr=class extends mi{constructor(e=null,t=1,n=1,s,r,o,a,l,c=Bn,h=Bn,u,d){super(null,o,a,l,c,h,s,r,u,d),this.isDataTexture=!0,this.image={data:e,width:t,height:n},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var Fo=class extends kt{constructor(e,t,n,s=1){super(e,t,n),this.isInstancedBufferAttribute=!0,this.meshPerAttribute=s}copy(e){return super.copy(e),this.meshPerAttribute=e.meshPerAttribute,this}toJSON(){let e=super.toJSON();return e.meshPerAttribute=this.meshPerAttribute,e.isInstancedBufferAttribute=!0,e}},_o=new Qe,zg=new Qe,wc=[],Vg=new Ut,xE=new Qe,Ma=new wt,Sa=new Vn,Nr=class extends wt{constructor(e,t,n){super(e,t),this.isInstancedMesh=!0,this.instanceMatrix=new Fo(new Float32Array(n*16),16),this.instanceColor=null,this.morphTexture=null,this.count=n,this.boundingBox=null,this.boundingSphere=null;for(let s=0;s<n;s++)this.setMatrixAt(s,xE)}computeBoundingBox(){let e=this.geometry,t=this.count;this.boundingBox===null&&(this.boundingBox=new Ut),e.boundingBox===null&&e.computeBoundingBox(),this.boundingBox.makeEmpty();for(let n=0;n<t;n++)this.getMatrixAt(n,_o),Vg.copy(e.boundingBox).applyMatrix4(_o),this.boundingBox.union(Vg)}computeBoundingSphere(){let e=this.geometry,t=this.count;this.boundingSphere===null&&(this.boundingSphere=new Vn),e.boundingSphere===null&&e.computeBoundingSphere(),this.boundingSphere.makeEmpty();for(let n=0;n<t;n++)this.getMatrixAt(n,_o),Sa.copy(e.boundingSphere).applyMatrix4(_o),this.boundingSphere.union(Sa)}copy(e,t){return super.copy(e,t),this.instanceMatrix.copy(e.instanceMatrix),this.morphTexture=e.morphTexture!==null?e.morphTexture.clone():null,this.instanceColor=e.instanceColor!==null?e.instanceColor.clone():null,this.count=e.count,this.boundingBox=e.boundingBox!==null?e.boundingBox.clone():null,this.boundingSphere=e.boundingSphere!==null?e.boundingSphere.clone():null,this}getColorAt(e,t){return this.instanceColor===null?t.setRGB(1,1,1):t.fromArray(this.instanceColor.array,e*3)}getMatrixAt(e,t){return t.fromArray(this.instanceMatrix.array,e*16)}getMorphAt(e,t){let n=t.morphTargetInfluences,s=this.morphTexture.source.data.data,r=n.length+1,o=e*r+1;for(let a=0;a<n.length;a++)n[a]=s[o+a]}raycast(e,t){let n=this.matrixWorld,s=this.count;if(Ma.geometry=this.geometry,Ma.material=this.material,Ma.material!==void 0&&(this.boundingSphere===null&&this.computeBoundingSphere(),Sa.copy(this.boundingSphere),Sa.applyMatrix4(n),e.ray.intersectsSphere(Sa)!==!1))for(let r=0;r<s;r++){this.getMatrixAt(r,_o),zg.multiplyMatrices(n,_o),Ma.matrixWorld=zg,Ma.raycast(e,wc);for(let o=0,a=wc.length;o<a;o++){let l=wc[o];l.instanceId=r,l.object=this,t.push(l)}wc.length=0}}setColorAt(e,t){return this.instanceColor===null&&(this.instanceColor=new Fo(new Float32Array(this.instanceMatrix.count*3).fill(1),3)),t.toArray(this.instanceColor.array,e*3),this}setMatrixAt(e,t){return t.toArray(this.instanceMatrix.array,e*16),this}setMorphAt(e,t){let n=t.morphTargetInfluences,s=n.length+1;this.morphTexture===null&&(this.morphTexture=new lr(new Float32Array(s*this.count),s,this.count,Rh,pi));let r=this.morphTexture.source.data.data,o=0;for(let c=0;c<n.length;c++)o+=n[c];let a=this.geometry.morphTargetsRelative?1:1-o,l=s*e;return r[l]=a,r.set(n,l+1),this}updateMorphTargets(){}dispose(){super.dispose(),this.instanceMatrix.dispose(),this.instanceColor!==null&&this.instanceColor.dispose(),this.morphTexture!==null&&(this.morphTexture.dispose(),this.morphTexture=null)}},Ir=new Vn,_E=new ue(.5,.5),Mc=new S,Bs=class{constructor(e=new si,t=new si,n=new si,s=new si,r=new si,o=new si){this.planes=[e,t,n,s,r,o]}set(e,t,n,s,r,o){let a=this.planes;return a[0].copy(e),a[1].copy(t),a[2].copy(n),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(e){let t=this.planes;for(let n=0;n<6;n++)t[n].copy(e.planes[n]);return this}setFromProjectionMatrix(e,t=Ui,n=!1){let s=this.planes,r=e.elements,o=r[0],a=r[1],l=r[2],c=r[3],h=r[4],u=r[5],d=r[6],f=r[7],p=r[8],v=r[9],g=r[10],m=r[11],y=r[12],b=r[13],x=r[14],T=r[15];if(s[0].setComponents(c-o,f-h,m-p,T-y).normalize(),s[1].setComponents(c+o,f+h,m+p,T+y).normalize(),s[2].setComponents(c+a,f+u,m+v,T+b).normalize(),s[3].setComponents(c-a,f-u,m-v,T-b).normalize(),n)s[4].setComponents(l,d,g,x).normalize(),s[5].setComponents(c-l,f-d,m-g,T-x).normalize();else if(s[4].setComponents(c-l,f-d,m-g,T-x).normalize(),t===Ui)s[5].setComponents(c+l,f+d,m+g,T+x).normalize();else if(t===Co)s[5].setComponents(l,d,g,x).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+t);return this}intersectsObject(e){if(e.boundingSphere!==void 0)e.boundingSphere===null&&e.computeBoundingSphere(),Ir.copy(e.boundingSphere).applyMatrix4(e.matrixWorld);else{let t=e.geometry;t.boundingSphere===null&&t.computeBoundingSphere(),Ir.copy(t.boundingSphere).applyMatrix4(e.matrixWorld)}return this.intersectsSphere(Ir)}intersectsSprite(e){Ir.center.set(0,0,0);let t=_E.distanceTo(e.center);return Ir.radius=.7071067811865476+t,Ir.applyMatrix4(e.matrixWorld),this.intersectsSphere(Ir)}intersectsSphere(e){let t=this.planes,n=e.center,s=-e.radius;for(let r=0;r<6;r++)if(t[r].distanceToPoint(n)<s)return!1;return!0}intersectsBox(e){let t=this.planes;for(let n=0;n<6;n++){let s=t[n];if(Mc.x=s.normal.x>0?e.max.x:e.min.x,Mc.y=s.normal.y>0?e.max.y:e.min.y,Mc.z=s.normal.z>0?e.max.z:e.min.z,s.distanceToPoint(Mc)<0)return!1}return!0}containsPoint(e){let t=this.planes;for(let n=0;n<6;n++)if(t[n].distanceToPoint(e)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},Gg=new Qe,Va=class i{constructor(){this.coordinateSystem=Ui,this._frustums=[],this._count=0}setFromArrayCamera(e){let t=e.cameras,n=this._frustums;for(let s=0;s<t.length;s++){let r=t[s];Gg.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),n[s]===void 0&&(n[s]=new Bs),n[s].setFromProjectionMatrix(Gg,r.coordinateSystem,r.reversedDepth)}return this._count=t.length,this}getFrustum(e){return this._frustums[e]}intersectsObject(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsObject(e))return!0;return!1}intersectsSprite(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsSprite(e))return!0;return!1}intersectsSphere(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsSphere(e))return!0;return!1}intersectsBox(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsBox(e))return!0;return!1}containsPoint(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].containsPoint(e))return!0;return!1}copy(e){this.coordinateSystem=e.coordinateSystem;let t=this._frustums,n=e._frustums;for(let s=0;s<e._count;s++)t[s]===void 0&&(t[s]=new Bs),t[s].copy(n[s]);return this._count=e._count,this}clone(){return new i().copy(this)}};function xf(i,e){return i-e}function bE(i,e){return i.z-e.z}function EE(i,e){return e.z-i.z}var Nf=class{constructor(){this.index=0,this.pool=[],this.list=[]}push(e,t,n,s){let r=this.pool,o=this.list;this.index>=r.length&&r.push({start:-1,count:-1,z:-1,index:-1});let a=r[this.index];o.push(a),this.index++,a.start=e,a.count=t,a.z=n,a.index=s}reset(){this.list.length=0,this.index=0}},fi=new Qe,wE=new et(1,1,1),ME=new Bs,SE=new Va,Sc=new Ut,Lr=new Vn,_f=new S,Wg=new S,Xg=new S,TE=new S,bf=new Nf,jn=new wt,Tc=[];function AE(i,e,t=0){let n=e.itemSize;if(i.isInterleavedBufferAttribute||i.array.constructor!==e.array.constructor){let s=i.count;for(let r=0;r<s;r++)for(let o=0;o<n;o++)e.setComponent(r+t,o,i.getComponent(r,o))}else e.array.set(i.array,t*n);e.needsUpdate=!0}function us(i,e){if(i.constructor!==e.constructor){let t=Math.min(i.length,e.length);for(let n=0;n<t;n++)e[n]=i[n]}else{let t=Math.min(i.length,e.length);e.set(new i.constructor(i.buffer,0,t))}}var Ga=class extends wt{constructor(e,t,n=t*2,s){super(new St,s),this.isBatchedMesh=!0,this.perObjectFrustumCulled=!0,this.sortObjects=!0,this.boundingBox=null,this.boundingSphere=null,this.customSort=null,this._instanceInfo=[],this._geometryInfo=[],this._availableInstanceIds=[],this._availableGeometryIds=[],this._nextIndexStart=0,this._nextVertexStart=0,this._geometryCount=0,this._visibilityChanged=!0,this._geometryInitialized=!1,this._maxInstanceCount=e,this._maxVertexCount=t,this._maxIndexCount=n,this._multiDrawCounts=new Int32Array(e),this._multiDrawStarts=new Int32Array(e),this._multiDrawCount=0,this._multiDrawBytesPerElement=1,this._mergedDrawCounts=new Int32Array(e),this._mergedDrawStarts=new Int32Array(e),this._mergedDrawInstanceCounts=new Int32Array(e),this._mergedDrawCount=0,this._matricesTexture=null,this._indirectTexture=null,this._colorsTexture=null,this._previousMatricesTexture=null,this._initMatricesTexture(),this._initIndirectTexture()}get maxInstanceCount(){return this._maxInstanceCount}get instanceCount(){return this._instanceInfo.length-this._availableInstanceIds.length}get unusedVertexCount(){return this._maxVertexCount-this._nextVertexStart}get unusedIndexCount(){return this._maxIndexCount-this._nextIndexStart}_initMatricesTexture(){let e=Math.sqrt(this._maxInstanceCount*4);e=Math.ceil(e/4)*4,e=Math.max(e,4);let t=new Float32Array(e*e*4),n=new lr(t,e,e,Ti,pi);this._matricesTexture=n}_initIndirectTexture(){let e=Math.sqrt(this._maxInstanceCount);e=Math.ceil(e);let t=new Uint32Array(e*e),n=new lr(t,e,e,_l,zi);this._indirectTexture=n}_initColorsTexture(){let e=Math.sqrt(this._maxInstanceCount);e=Math.ceil(e);let t=new Float32Array(e*e*4).fill(1),n=new lr(t,e,e,Ti,pi);n.colorSpace=Ct.workingColorSpace,this._colorsTexture=n}_initializeGeometry(e){let t=this.geometry,n=this._maxVertexCount,s=this._maxIndexCount;if(this._geometryInitialized===!1){for(let r in e.attributes){let o=e.getAttribute(r),{array:a,itemSize:l,normalized:c}=o,h=new a.constructor(n*l),u=new kt(h,l,c);t.setAttribute(r,u)}if(e.getIndex()!==null){let r=n>65535?new Uint32Array(s):new Uint16Array(s);t.setIndex(new kt(r,1))}this._geometryInitialized=!0}}_validateGeometry(e){let t=this.geometry;if(!!e.getIndex()!=!!t.getIndex())throw new Error('THREE.BatchedMesh: All geometries must consistently have "index".');for(let n in t.attributes){if(!e.hasAttribute(n))throw new Error(`THREE.BatchedMesh: Added geometry missing "${n}". All geometries must have consistent attributes.`);let s=e.getAttribute(n),r=t.getAttribute(n);if(s.itemSize!==r.itemSize||s.normalized!==r.normalized)throw new Error(`THREE.BatchedMesh: Added geometry attribute "${n}" has an inconsistent itemSize or normalized value.`)}}validateInstanceId(e){let t=this._instanceInfo;if(e<0||e>=t.length||t[e].active===!1)throw new Error(`THREE.BatchedMesh: Invalid instanceId ${e}. Instance is either out of range or has been deleted.`)}validateGeometryId(e){let t=this._geometryInfo;if(e<0||e>=t.length||t[e].active===!1)throw new Error(`THREE.BatchedMesh: Invalid geometryId ${e}. Geometry is either out of range or has been deleted.`)}setCustomSort(e){return this.customSort=e,this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Ut);let e=this.boundingBox,t=this._instanceInfo;e.makeEmpty();for(let n=0,s=t.length;n<s;n++){if(t[n].active===!1)continue;let r=t[n].geometryIndex;this.getMatrixAt(n,fi),this.getBoundingBoxAt(r,Sc).applyMatrix4(fi),e.union(Sc)}}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Vn);let e=this.boundingSphere,t=this._instanceInfo;e.makeEmpty();for(let n=0,s=t.length;n<s;n++){if(t[n].active===!1)continue;let r=t[n].geometryIndex;this.getMatrixAt(n,fi),this.getBoundingSphereAt(r,Lr).applyMatrix4(fi),e.union(Lr)}}addInstance(e){if(this._instanceInfo.length>=this.maxInstanceCount&&this._availableInstanceIds.length===0)throw new Error("THREE.BatchedMesh: Maximum item count reached.");let n={visible:!0,active:!0,geometryIndex:e},s=null;this._availableInstanceIds.length>0?(this._availableInstanceIds.sort(xf),s=this._availableInstanceIds.shift(),this._instanceInfo[s]=n):(s=this._instanceInfo.length,this._instanceInfo.push(n));let r=this._matricesTexture;fi.identity().toArray(r.image.data,s*16),r.needsUpdate=!0;let o=this._colorsTexture;return o&&(wE.toArray(o.image.data,s*4),o.needsUpdate=!0),this._visibilityChanged=!0,s}addGeometry(e,t=-1,n=-1){this._initializeGeometry(e),this._validateGeometry(e);let s={vertexStart:-1,vertexCount:-1,reservedVertexCount:-1,indexStart:-1,indexCount:-1,reservedIndexCount:-1,start:-1,count:-1,boundingBox:null,boundingSphere:null,active:!0},r=this._geometryInfo;s.vertexStart=this._nextVertexStart,s.reservedVertexCount=t===-1?e.getAttribute("position").count:t;let o=e.getIndex();if(o!==null&&(s.indexStart=this._nextIndexStart,s.reservedIndexCount=n===-1?o.count:n),s.indexStart!==-1&&s.indexStart+s.reservedIndexCount>this._maxIndexCount||s.vertexStart+s.reservedVertexCount>this._maxVertexCount)throw new Error("THREE.BatchedMesh: Reserved space request exceeds the maximum buffer size.");let l;return this._availableGeometryIds.length>0?(this._availableGeometryIds.sort(xf),l=this._availableGeometryIds.shift(),r[l]=s):(l=this._geometryCount,this._geometryCount++,r.push(s)),this.setGeometryAt(l,e),this._nextIndexStart=s.indexStart+s.reservedIndexCount,this._nextVertexStart=s.vertexStart+s.reservedVertexCount,l}setGeometryAt(e,t){if(e>=this._geometryCount)throw new Error("THREE.BatchedMesh: Maximum geometry count reached.");this._validateGeometry(t);let n=this.geometry,s=n.getIndex()!==null,r=n.getIndex(),o=t.getIndex(),a=this._geometryInfo[e];if(s&&o.count>a.reservedIndexCount||t.attributes.position.count>a.reservedVertexCount)throw new Error("THREE.BatchedMesh: Reserved space not large enough for provided geometry.");let l=a.vertexStart,c=a.reservedVertexCount;a.vertexCount=t.getAttribute("position").count;for(let h in n.attributes){let u=t.getAttribute(h),d=n.getAttribute(h);AE(u,d,l);let f=u.itemSize;for(let p=u.count,v=c;p<v;p++){let g=l+p;for(let m=0;m<f;m++)d.setComponent(g,m,0)}d.needsUpdate=!0,d.addUpdateRange(l*f,c*f)}if(s){let h=a.indexStart,u=a.reservedIndexCount;a.indexCount=t.getIndex().count;for(let d=0;d<o.count;d++)r.setX(h+d,l+o.getX(d));for(let d=o.count,f=u;d<f;d++)r.setX(h+d,l);r.needsUpdate=!0,r.addUpdateRange(h,a.reservedIndexCount)}return a.start=s?a.indexStart:a.vertexStart,a.count=s?a.indexCount:a.vertexCount,a.boundingBox=null,t.boundingBox!==null&&(a.boundingBox=t.boundingBox.clone()),a.boundingSphere=null,t.boundingSphere!==null&&(a.boundingSphere=t.boundingSphere.clone()),this._visibilityChanged=!0,e}deleteGeometry(e){let t=this._geometryInfo;if(e>=t.length||t[e].active===!1)return this;let n=this._instanceInfo;for(let s=0,r=n.length;s<r;s++)n[s].active&&n[s].geometryIndex===e&&this.deleteInstance(s);return t[e].active=!1,this._availableGeometryIds.push(e),this._visibilityChanged=!0,this}deleteInstance(e){return this.validateInstanceId(e),this._instanceInfo[e].active=!1,this._availableInstanceIds.push(e),this._visibilityChanged=!0,this}optimize(){let e=0,t=0,n=this._geometryInfo,s=n.map((o,a)=>a).sort((o,a)=>n[o].vertexStart-n[a].vertexStart),r=this.geometry;for(let o=0,a=n.length;o<a;o++){let l=s[o],c=n[l];if(c.active!==!1){if(r.index!==null){if(c.indexStart!==t){let{indexStart:h,vertexStart:u,reservedIndexCount:d}=c,f=r.index,p=f.array,v=e-u;for(let g=h;g<h+d;g++)p[g]=p[g]+v;f.array.copyWithin(t,h,h+d),f.addUpdateRange(t,d),f.needsUpdate=!0,c.indexStart=t}t+=c.reservedIndexCount}if(c.vertexStart!==e){let{vertexStart:h,reservedVertexCount:u}=c,d=r.attributes;for(let f in d){let p=d[f],{array:v,itemSize:g}=p;v.copyWithin(e*g,h*g,(h+u)*g),p.addUpdateRange(e*g,u*g),p.needsUpdate=!0}c.vertexStart=e}e+=c.reservedVertexCount,c.start=r.index?c.indexStart:c.vertexStart}}return this._nextIndexStart=t,this._nextVertexStart=e,this._visibilityChanged=!0,this}getBoundingBoxAt(e,t){if(e>=this._geometryCount)return null;let n=this.geometry,s=this._geometryInfo[e];if(s.boundingBox===null){let r=new Ut,o=n.index,a=n.attributes.position;for(let l=s.start,c=s.start+s.count;l<c;l++){let h=l;o&&(h=o.getX(h)),r.expandByPoint(_f.fromBufferAttribute(a,h))}s.boundingBox=r}return t.copy(s.boundingBox),t}getBoundingSphereAt(e,t){if(e>=this._geometryCount)return null;let n=this.geometry,s=this._geometryInfo[e];if(s.boundingSphere===null){let r=new Vn;this.getBoundingBoxAt(e,Sc),Sc.getCenter(r.center);let o=n.index,a=n.attributes.position,l=0;for(let c=s.start,h=s.start+s.count;c<h;c++){let u=c;o&&(u=o.getX(u)),_f.fromBufferAttribute(a,u),l=Math.max(l,r.center.distanceToSquared(_f))}r.radius=Math.sqrt(l),s.boundingSphere=r}return t.copy(s.boundingSphere),t}setMatrixAt(e,t){this.validateInstanceId(e);let n=this._matricesTexture,s=this._matricesTexture.image.data;return t.toArray(s,e*16),n.needsUpdate=!0,this}getMatrixAt(e,t){return this.validateInstanceId(e),t.fromArray(this._matricesTexture.image.data,e*16)}setColorAt(e,t){return this.validateInstanceId(e),this._colorsTexture===null&&this._initColorsTexture(),t.toArray(this._colorsTexture.image.data,e*4),this._colorsTexture.needsUpdate=!0,this}getColorAt(e,t){return this.validateInstanceId(e),this._colorsTexture===null?t.isVector4?t.set(1,1,1,1):t.setRGB(1,1,1):t.fromArray(this._colorsTexture.image.data,e*4)}setVisibleAt(e,t){return this.validateInstanceId(e),this._instanceInfo[e].visible===t?this:(this._instanceInfo[e].visible=t,this._visibilityChanged=!0,this)}getVisibleAt(e){return this.validateInstanceId(e),this._instanceInfo[e].visible}setGeometryIdAt(e,t){return this.validateInstanceId(e),this.validateGeometryId(t),this._instanceInfo[e].geometryIndex=t,this._visibilityChanged=!0,this}getGeometryIdAt(e){return this.validateInstanceId(e),this._instanceInfo[e].geometryIndex}getGeometryRangeAt(e,t={}){this.validateGeometryId(e);let n=this._geometryInfo[e];return t.vertexStart=n.vertexStart,t.vertexCount=n.vertexCount,t.reservedVertexCount=n.reservedVertexCount,t.indexStart=n.indexStart,t.indexCount=n.indexCount,t.reservedIndexCount=n.reservedIndexCount,t.start=n.start,t.count=n.count,t}setInstanceCount(e){let t=this._availableInstanceIds,n=this._instanceInfo;for(t.sort(xf);t[t.length-1]===n.length-1;)n.pop(),t.pop();if(e<n.length)throw new Error(`THREE.BatchedMesh: Instance ids outside the range ${e} are being used. Cannot shrink instance count.`);let s=new Int32Array(e),r=new Int32Array(e);us(this._multiDrawCounts,s),us(this._multiDrawStarts,r),this._multiDrawCounts=s,this._multiDrawStarts=r;let o=new Int32Array(e),a=new Int32Array(e),l=new Int32Array(e);us(this._mergedDrawCounts,o),us(this._mergedDrawStarts,a),us(this._mergedDrawInstanceCounts,l),this._mergedDrawCounts=o,this._mergedDrawStarts=a,this._mergedDrawInstanceCounts=l,this._maxInstanceCount=e;let c=this._indirectTexture,h=this._matricesTexture,u=this._colorsTexture;c.dispose(),this._initIndirectTexture(),us(c.image.data,this._indirectTexture.image.data),h.dispose(),this._initMatricesTexture(),us(h.image.data,this._matricesTexture.image.data),u&&(u.dispose(),this._initColorsTexture(),us(u.image.data,this._colorsTexture.image.data)),this._previousMatricesTexture!==null&&(this._previousMatricesTexture.dispose(),this._previousMatricesTexture=null)}setGeometrySize(e,t){let n=[...this._geometryInfo].filter(a=>a.active);if(Math.max(...n.map(a=>a.vertexStart+a.reservedVertexCount))>e)throw new Error(`THREE.BatchedMesh: Geometry vertex values are being used outside the range ${e}. Cannot shrink further.`);if(this.geometry.index&&Math.max(...n.map(l=>l.indexStart+l.reservedIndexCount))>t)throw new Error(`THREE.BatchedMesh: Geometry index values are being used outside the range ${t}. Cannot shrink further.`);let r=this.geometry;r.dispose(),this._maxVertexCount=e,this._maxIndexCount=t,this._geometryInitialized&&(this._geometryInitialized=!1,this.geometry=new St,this._initializeGeometry(r));let o=this.geometry;r.index&&us(r.index.array,o.index.array);for(let a in r.attributes)us(r.attributes[a].array,o.attributes[a].array);this._visibilityChanged=!0}raycast(e,t){let n=this._instanceInfo,s=this._geometryInfo,r=this.matrixWorld,o=this.geometry;jn.material=this.material,jn.geometry.index=o.index,jn.geometry.attributes=o.attributes,jn.geometry.boundingBox===null&&(jn.geometry.boundingBox=new Ut),jn.geometry.boundingSphere===null&&(jn.geometry.boundingSphere=new Vn);for(let a=0,l=n.length;a<l;a++){if(!n[a].visible||!n[a].active)continue;let c=n[a].geometryIndex,h=s[c];jn.geometry.setDrawRange(h.start,h.count),this.getMatrixAt(a,jn.matrixWorld).premultiply(r),this.getBoundingBoxAt(c,jn.geometry.boundingBox),this.getBoundingSphereAt(c,jn.geometry.boundingSphere),jn.raycast(e,Tc);for(let u=0,d=Tc.length;u<d;u++){let f=Tc[u];f.object=this,f.batchId=a,t.push(f)}Tc.length=0}jn.material=null,jn.geometry.index=null,jn.geometry.attributes={},jn.geometry.setDrawRange(0,1/0)}copy(e){return super.copy(e),this.geometry=e.geometry.clone(),this.perObjectFrustumCulled=e.perObjectFrustumCulled,this.sortObjects=e.sortObjects,this.boundingBox=e.boundingBox!==null?e.boundingBox.clone():null,this.boundingSphere=e.boundingSphere!==null?e.boundingSphere.clone():null,this._geometryInfo=e._geometryInfo.map(t=>({...t,boundingBox:t.boundingBox!==null?t.boundingBox.clone():null,boundingSphere:t.boundingSphere!==null?t.boundingSphere.clone():null})),this._instanceInfo=e._instanceInfo.map(t=>({...t})),this._availableInstanceIds=e._availableInstanceIds.slice(),this._availableGeometryIds=e._availableGeometryIds.slice(),this._nextIndexStart=e._nextIndexStart,this._nextVertexStart=e._nextVertexStart,this._geometryCount=e._geometryCount,this._maxInstanceCount=e._maxInstanceCount,this._maxVertexCount=e._maxVertexCount,this._maxIndexCount=e._maxIndexCount,this._geometryInitialized=e._geometryInitialized,this._multiDrawCounts=e._multiDrawCounts.slice(),this._multiDrawStarts=e._multiDrawStarts.slice(),this._multiDrawBytesPerElement=e._multiDrawBytesPerElement,this._mergedDrawCounts=e._mergedDrawCounts.slice(),this._mergedDrawStarts=e._mergedDrawStarts.slice(),this._mergedDrawInstanceCounts=e._mergedDrawInstanceCounts.slice(),this._indirectTexture=e._indirectTexture.clone(),this._indirectTexture.image.data=this._indirectTexture.image.data.slice(),this._matricesTexture=e._matricesTexture.clone(),this._matricesTexture.image.data=this._matricesTexture.image.data.slice(),e._colorsTexture!==null?(this._colorsTexture=e._colorsTexture.clone(),this._colorsTexture.image.data=this._colorsTexture.image.data.slice()):this._colorsTexture=null,this}dispose(){super.dispose(),this.geometry.dispose(),this._matricesTexture.dispose(),this._matricesTexture=null,this._indirectTexture.dispose(),this._indirectTexture=null,this._colorsTexture!==null&&(this._colorsTexture.dispose(),this._colorsTexture=null),this._previousMatricesTexture!==null&&(this._previousMatricesTexture.dispose(),this._previousMatricesTexture=null)}_updateDrawParameters(e,t,n,s="multiDraw"){if(!this._visibilityChanged&&!this.perObjectFrustumCulled&&!this.sortObjects)return;let r=t.getIndex(),o=r===null?1:r.array.BYTES_PER_ELEMENT,a=1;n.wireframe&&(a=2,o=t.attributes.position.count>65535?4:2);let l=this._instanceInfo,c=this._multiDrawStarts,h=this._multiDrawCounts,u=this._mergedDrawStarts,d=this._mergedDrawCounts,f=this._mergedDrawInstanceCounts,p=this._geometryInfo,v=this.perObjectFrustumCulled,g=this._indirectTexture,m=g.image.data,y=e.isArrayCamera?SE:ME;v&&(e.isArrayCamera?y.setFromArrayCamera(e):(fi.multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse).multiply(this.matrixWorld),y.setFromProjectionMatrix(fi,e.coordinateSystem,e.reversedDepth)));let b=0,x=0;if(this.sortObjects){fi.copy(this.matrixWorld).invert(),Wg.setFromMatrixPosition(e.matrixWorld).applyMatrix4(fi),Xg.set(0,0,-1).transformDirection(e.matrixWorld).transformDirection(fi);for(let _=0,w=l.length;_<w;_++)if(l[_].visible&&l[_].active){let N=l[_].geometryIndex;this.getMatrixAt(_,fi),this.getBoundingSphereAt(N,Lr).applyMatrix4(fi);let P=!1;if(v&&(P=!y.intersectsSphere(Lr)),!P){let I=p[N],U=TE.subVectors(Lr.center,Wg).dot(Xg);bf.push(I.start,I.count,U,_)}}let T=bf.list,M=this.customSort;M===null?T.sort(n.transparent?EE:bE):M.call(this,T,e);for(let _=0,w=T.length;_<w;_++){let N=T[_],P=N.start*o*a,I=N.count*a;s==="merged"?x>0&&u[x-1]===P&&d[x-1]===I?f[x-1]++:(u[x]=P,d[x]=I,f[x]=1,x++):(c[b]=P,h[b]=I),m[b]=N.index,b++}bf.reset()}else for(let T=0,M=l.length;T<M;T++)if(l[T].visible&&l[T].active){let _=l[T].geometryIndex,w=!1;if(v&&(this.getMatrixAt(T,fi),this.getBoundingSphereAt(_,Lr).applyMatrix4(fi),w=!y.intersectsSphere(Lr)),!w){let N=p[_],P=N.start*o*a,I=N.count*a;s==="merged"?x>0&&u[x-1]===P&&d[x-1]===I?f[x-1]++:(u[x]=P,d[x]=I,f[x]=1,x++):(c[b]=P,h[b]=I),m[b]=T,b++}}g.needsUpdate=!0,this._multiDrawCount=b,this._mergedDrawCount=x,this._multiDrawBytesPerElement=o,this._visibilityChanged=!1}onBeforeRender(e,t,n,s,r){e.isWebGPURenderer===!0?(this._visibilityChanged||this.perObjectFrustumCulled||this.sortObjects)&&(this._indirectTexture.needsUpdate=!0):this._updateDrawParameters(n,s,r)}onBeforeShadow(e,t,n,s,r,o){e.isWebGPURenderer!==!0&&this._updateDrawParameters(s,r,o)}},Zn=class extends Ki{constructor(e){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new et(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.linewidth=e.linewidth,this.linecap=e.linecap,this.linejoin=e.linejoin,this.fog=e.fog,this}},Qc=new S,eh=new S,qg=new Qe,Ta=new cr,Ac=new Vn,Ef=new S,Yg=new S,ms=class extends cn{constructor(e=new St,t=new Zn){super(),this.isLine=!0,this.type="Line",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,n=[0];for(let s=1,r=t.count;s<r;s++)Qc.fromBufferAttribute(t,s-1),eh.fromBufferAttribute(t,s),n[s]=n[s-1],n[s]+=Qc.distanceTo(eh);e.setAttribute("lineDistance",new ot(n,1))}else it("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,s=this.matrixWorld,r=e.params.Line.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),Ac.copy(n.boundingSphere),Ac.applyMatrix4(s),Ac.radius+=r,e.ray.intersectsSphere(Ac)===!1)return;qg.copy(s).invert(),Ta.copy(e.ray).applyMatrix4(qg);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,h=n.index,d=n.attributes.position;if(h!==null){let f=Math.max(0,o.start),p=Math.min(h.count,o.start+o.count);for(let v=f,g=p-1;v<g;v+=c){let m=h.getX(v),y=h.getX(v+1),b=Rc(this,e,Ta,l,m,y,v);b&&t.push(b)}if(this.isLineLoop){let v=h.getX(p-1),g=h.getX(f),m=Rc(this,e,Ta,l,v,g,p-1);m&&t.push(m)}}else{let f=Math.max(0,o.start),p=Math.min(d.count,o.start+o.count);for(let v=f,g=p-1;v<g;v+=c){let m=Rc(this,e,Ta,l,v,v+1,v);m&&t.push(m)}if(this.isLineLoop){let v=Rc(this,e,Ta,l,p-1,f,p-1);v&&t.push(v)}}}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let s=t[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function Rc(i,e,t,n,s,r,o){let a=i.geometry.attributes.position;if(Qc.fromBufferAttribute(a,s),eh.fromBufferAttribute(a,r),t.distanceSqToSegment(Qc,eh,Ef,Yg)>n)return;Ef.applyMatrix4(i.matrixWorld);let c=e.ray.origin.distanceTo(Ef);if(!(c<e.near||c>e.far))return{distance:c,point:Yg.clone().applyMatrix4(i.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:i}}var $g=new S,jg=new S,Hs=class extends ms{constructor(e,t){super(e,t),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,n=[];for(let s=0,r=t.count;s<r;s+=2)$g.fromBufferAttribute(t,s),jg.fromBufferAttribute(t,s+1),n[s]=s===0?0:n[s-1],n[s+1]=n[s]+$g.distanceTo(jg);e.setAttribute("lineDistance",new ot(n,1))}else it("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var Wa=class extends mi{constructor(e=[],t=kr,n,s,r,o,a,l,c,h){super(e,t,n,s,r,o,a,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(e){this.image=e}};var zs=class extends mi{constructor(e,t,n=zi,s,r,o,a=Bn,l=Bn,c,h=ks,u=1){if(h!==ks&&h!==qs)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let d={width:e,height:t,depth:u};super(d,s,r,o,a,l,h,n,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(e){return super.copy(e),this.source=new Lo(Object.assign({},e.image)),this.compareFunction=e.compareFunction,this}toJSON(e){let t=super.toJSON(e);return t.compareFunction=this.compareFunction,t}},Xa=class extends zs{constructor(e,t=zi,n=kr,s,r,o=Bn,a=Bn,l,c=ks){let h={width:e,height:e,depth:1},u=[h,h,h,h,h,h];super(e,e,t,n,s,r,o,a,l,c),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(e){this.image=e}},qa=class extends mi{constructor(e=null){super(),this.sourceTexture=e,this.isExternalTexture=!0}copy(e){return super.copy(e),this.sourceTexture=e.sourceTexture,this}},pn=class i extends St{constructor(e=1,t=1,n=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:e,height:t,depth:n,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],h=[],u=[],d=0,f=0;p("z","y","x",-1,-1,n,t,e,o,r,0),p("z","y","x",1,-1,n,t,-e,o,r,1),p("x","z","y",1,1,e,n,t,s,o,2),p("x","z","y",1,-1,e,n,-t,s,o,3),p("x","y","z",1,-1,e,t,n,s,r,4),p("x","y","z",-1,-1,e,t,-n,s,r,5),this.setIndex(l),this.setAttribute("position",new ot(c,3)),this.setAttribute("normal",new ot(h,3)),this.setAttribute("uv",new ot(u,2));function p(v,g,m,y,b,x,T,M,_,w,N){let P=x/_,I=T/w,U=x/2,H=T/2,L=M/2,k=_+1,q=w+1,V=0,ce=0,Z=new S;for(let Q=0;Q<q;Q++){let te=Q*I-H;for(let pe=0;pe<k;pe++){let he=pe*P-U;Z[v]=he*y,Z[g]=te*b,Z[m]=L,c.push(Z.x,Z.y,Z.z),Z[v]=0,Z[g]=0,Z[m]=M>0?1:-1,h.push(Z.x,Z.y,Z.z),u.push(pe/_),u.push(1-Q/w),V+=1}}for(let Q=0;Q<w;Q++)for(let te=0;te<_;te++){let pe=d+te+k*Q,he=d+te+k*(Q+1),ee=d+(te+1)+k*(Q+1),ye=d+(te+1)+k*Q;l.push(pe,he,ye),l.push(he,ee,ye),ce+=6}a.addGroup(f,ce,N),f+=ce,d+=V}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.width,e.height,e.depth,e.widthSegments,e.heightSegments,e.depthSegments)}},Ya=class i extends St{constructor(e=1,t=1,n=4,s=8,r=1){super(),this.type="CapsuleGeometry",this.parameters={radius:e,height:t,capSegments:n,radialSegments:s,heightSegments:r},t=Math.max(0,t),n=Math.max(1,Math.floor(n)),s=Math.max(3,Math.floor(s)),r=Math.max(1,Math.floor(r));let o=[],a=[],l=[],c=[],h=t/2,u=Math.PI/2*e,d=t,f=2*u+d,p=n*2+r,v=s+1,g=new S,m=new S;for(let y=0;y<=p;y++){let b=0,x=0,T=0,M=0;if(y<=n){let N=y/n,P=N*Math.PI/2;x=-h-e*Math.cos(P),T=e*Math.sin(P),M=-e*Math.cos(P),b=N*u}else if(y<=n+r){let N=(y-n)/r;x=-h+N*t,T=e,M=0,b=u+N*d}else{let N=(y-n-r)/n,P=N*Math.PI/2;x=h+e*Math.sin(P),T=e*Math.cos(P),M=e*Math.sin(P),b=u+d+N*u}let _=Math.max(0,Math.min(1,b/f)),w=0;y===0?w=.5/s:y===p&&(w=-.5/s);for(let N=0;N<=s;N++){let P=N/s,I=P*Math.PI*2,U=Math.sin(I),H=Math.cos(I);m.x=-T*H,m.y=x,m.z=T*U,a.push(m.x,m.y,m.z),g.set(-T*H,M,T*U),g.normalize(),l.push(g.x,g.y,g.z),c.push(P+w,_)}if(y>0){let N=(y-1)*v;for(let P=0;P<s;P++){let I=N+P,U=N+P+1,H=y*v+P,L=y*v+P+1;o.push(I,U,H),o.push(U,L,H)}}}this.setIndex(o),this.setAttribute("position",new ot(a,3)),this.setAttribute("normal",new ot(l,3)),this.setAttribute("uv",new ot(c,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.radius,e.height,e.capSegments,e.radialSegments,e.heightSegments)}};var Jt=class i extends St{constructor(e=1,t=1,n=1,s=32,r=1,o=!1,a=0,l=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:e,radiusBottom:t,height:n,radialSegments:s,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:l};let c=this;s=Math.floor(s),r=Math.floor(r);let h=[],u=[],d=[],f=[],p=0,v=[],g=n/2,m=0;y(),o===!1&&(e>0&&b(!0),t>0&&b(!1)),this.setIndex(h),this.setAttribute("position",new ot(u,3)),this.setAttribute("normal",new ot(d,3)),this.setAttribute("uv",new ot(f,2));function y(){let x=new S,T=new S,M=0,_=(t-e)/n;for(let w=0;w<=r;w++){let N=[],P=w/r,I=P*(t-e)+e;for(let U=0;U<=s;U++){let H=U/s,L=H*l+a,k=Math.sin(L),q=Math.cos(L);T.x=I*k,T.y=-P*n+g,T.z=I*q,u.push(T.x,T.y,T.z),x.set(k,_,q).normalize(),d.push(x.x,x.y,x.z),f.push(H,1-P),N.push(p++)}v.push(N)}for(let w=0;w<s;w++)for(let N=0;N<r;N++){let P=v[N][w],I=v[N+1][w],U=v[N+1][w+1],H=v[N][w+1];(e>0||N!==0)&&(h.push(P,I,H),M+=3),(t>0||N!==r-1)&&(h.push(I,U,H),M+=3)}c.addGroup(m,M,0),m+=M}function b(x){let T=p,M=new ue,_=new S,w=0,N=x===!0?e:t,P=x===!0?1:-1;for(let U=1;U<=s;U++)u.push(0,g*P,0),d.push(0,P,0),f.push(.5,.5),p++;let I=p;for(let U=0;U<=s;U++){let L=U/s*l+a,k=Math.cos(L),q=Math.sin(L);_.x=N*q,_.y=g*P,_.z=N*k,u.push(_.x,_.y,_.z),d.push(0,P,0),M.x=k*.5+.5,M.y=q*.5*P+.5,f.push(M.x,M.y),p++}for(let U=0;U<s;U++){let H=T+U,L=I+U;x===!0?h.push(L,L+1,H):h.push(L+1,L,H),w+=3}c.addGroup(m,w,x===!0?1:2),m+=w}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.radiusTop,e.radiusBottom,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}},gi=class i extends Jt{constructor(e=1,t=1,n=32,s=1,r=!1,o=0,a=Math.PI*2){super(0,e,t,n,s,r,o,a),this.type="ConeGeometry",this.parameters={radius:e,height:t,radialSegments:n,heightSegments:s,openEnded:r,thetaStart:o,thetaLength:a}}static fromJSON(e){return new i(e.radius,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}},th=class i extends St{constructor(e=[],t=[],n=1,s=0){super(),this.type="PolyhedronGeometry",this.parameters={vertices:e,indices:t,radius:n,detail:s};let r=[],o=[];a(s),c(n),h(),this.setAttribute("position",new ot(r,3)),this.setAttribute("normal",new ot(r.slice(),3)),this.setAttribute("uv",new ot(o,2)),s===0?this.computeVertexNormals():this.normalizeNormals();function a(y){let b=new S,x=new S,T=new S;for(let M=0;M<t.length;M+=3)f(t[M+0],b),f(t[M+1],x),f(t[M+2],T),l(b,x,T,y)}function l(y,b,x,T){let M=T+1,_=[];for(let w=0;w<=M;w++){_[w]=[];let N=y.clone().lerp(x,w/M),P=b.clone().lerp(x,w/M),I=M-w;for(let U=0;U<=I;U++)U===0&&w===M?_[w][U]=N:_[w][U]=N.clone().lerp(P,U/I)}for(let w=0;w<M;w++)for(let N=0;N<2*(M-w)-1;N++){let P=Math.floor(N/2);N%2===0?(d(_[w][P+1]),d(_[w+1][P]),d(_[w][P])):(d(_[w][P+1]),d(_[w+1][P+1]),d(_[w+1][P]))}}function c(y){let b=new S;for(let x=0;x<r.length;x+=3)b.x=r[x+0],b.y=r[x+1],b.z=r[x+2],b.normalize().multiplyScalar(y),r[x+0]=b.x,r[x+1]=b.y,r[x+2]=b.z}function h(){let y=new S;for(let b=0;b<r.length;b+=3){y.x=r[b+0],y.y=r[b+1],y.z=r[b+2];let x=g(y)/2/Math.PI+.5,T=m(y)/Math.PI+.5;o.push(x,1-T)}p(),u()}function u(){for(let y=0;y<o.length;y+=6){let b=o[y+0],x=o[y+2],T=o[y+4],M=Math.max(b,x,T),_=Math.min(b,x,T);M>.9&&_<.1&&(b<.2&&(o[y+0]+=1),x<.2&&(o[y+2]+=1),T<.2&&(o[y+4]+=1))}}function d(y){r.push(y.x,y.y,y.z)}function f(y,b){let x=y*3;b.x=e[x+0],b.y=e[x+1],b.z=e[x+2]}function p(){let y=new S,b=new S,x=new S,T=new S,M=new ue,_=new ue,w=new ue;for(let N=0,P=0;N<r.length;N+=9,P+=6){y.set(r[N+0],r[N+1],r[N+2]),b.set(r[N+3],r[N+4],r[N+5]),x.set(r[N+6],r[N+7],r[N+8]),M.set(o[P+0],o[P+1]),_.set(o[P+2],o[P+3]),w.set(o[P+4],o[P+5]),T.copy(y).add(b).add(x).divideScalar(3);let I=g(T);v(M,P+0,y,I),v(_,P+2,b,I),v(w,P+4,x,I)}}function v(y,b,x,T){T<0&&y.x===1&&(o[b]=y.x-1),x.x===0&&x.z===0&&(o[b]=T/2/Math.PI+.5)}function g(y){return Math.atan2(y.z,-y.x)}function m(y){return Math.atan2(-y.y,Math.sqrt(y.x*y.x+y.z*y.z))}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.vertices,e.indices,e.radius,e.detail)}};var Cc=new S,Pc=new S,wf=new S,Ic=new Fs,$a=class extends St{constructor(e=null,t=1){if(super(),this.type="EdgesGeometry",this.parameters={geometry:e,thresholdAngle:t},e!==null){let s=Math.pow(10,4),r=Math.cos(To*t),o=e.getIndex(),a=e.getAttribute("position"),l=o?o.count:a.count,c=[0,0,0],h=["a","b","c"],u=new Array(3),d=new Map,f=[];for(let p=0;p<l;p+=3){o?(c[0]=o.getX(p),c[1]=o.getX(p+1),c[2]=o.getX(p+2)):(c[0]=p,c[1]=p+1,c[2]=p+2);let{a:v,b:g,c:m}=Ic;if(v.fromBufferAttribute(a,c[0]),g.fromBufferAttribute(a,c[1]),m.fromBufferAttribute(a,c[2]),Ic.getNormal(wf),u[0]=`${Math.round(v.x*s)},${Math.round(v.y*s)},${Math.round(v.z*s)}`,u[1]=`${Math.round(g.x*s)},${Math.round(g.y*s)},${Math.round(g.z*s)}`,u[2]=`${Math.round(m.x*s)},${Math.round(m.y*s)},${Math.round(m.z*s)}`,!(u[0]===u[1]||u[1]===u[2]||u[2]===u[0]))for(let y=0;y<3;y++){let b=(y+1)%3,x=u[y],T=u[b],M=Ic[h[y]],_=Ic[h[b]],w=`${x}_${T}`,N=`${T}_${x}`,P=d.get(N);P?(wf.dot(P.normal)<=r&&(f.push(M.x,M.y,M.z),f.push(_.x,_.y,_.z)),d.set(N,null)):d.has(w)||d.set(w,{index0:c[y],index1:c[b],normal:wf.clone()})}}for(let p of d.values())if(p){let{index0:v,index1:g}=p;Cc.fromBufferAttribute(a,v),Pc.fromBufferAttribute(a,g),f.push(Cc.x,Cc.y,Cc.z),f.push(Pc.x,Pc.y,Pc.z)}this.setAttribute("position",new ot(f,3))}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}},Ri=class{constructor(){this.type="Curve",this.arcLengthDivisions=200,this.needsUpdate=!1,this.cacheArcLengths=null}getPoint(){it("Curve: .getPoint() not implemented.")}getPointAt(e,t){let n=this.getUtoTmapping(e);return this.getPoint(n,t)}getPoints(e=5){let t=[];for(let n=0;n<=e;n++)t.push(this.getPoint(n/e));return t}getSpacedPoints(e=5){let t=[];for(let n=0;n<=e;n++)t.push(this.getPointAt(n/e));return t}getLength(){let e=this.getLengths();return e[e.length-1]}getLengths(e=this.arcLengthDivisions){if(this.cacheArcLengths&&this.cacheArcLengths.length===e+1&&!this.needsUpdate)return this.cacheArcLengths;this.needsUpdate=!1;let t=[],n,s=this.getPoint(0),r=0;t.push(0);for(let o=1;o<=e;o++)n=this.getPoint(o/e),r+=n.distanceTo(s),t.push(r),s=n;return this.cacheArcLengths=t,t}updateArcLengths(){this.needsUpdate=!0,this.getLengths()}getUtoTmapping(e,t=null){let n=this.getLengths(),s=0,r=n.length,o;t?o=t:o=e*n[r-1];let a=0,l=r-1,c;for(;a<=l;)if(s=Math.floor(a+(l-a)/2),c=n[s]-o,c<0)a=s+1;else if(c>0)l=s-1;else{l=s;break}if(s=l,n[s]===o)return s/(r-1);let h=n[s],d=n[s+1]-h,f=(o-h)/d;return(s+f)/(r-1)}getTangent(e,t){let s=e-1e-4,r=e+1e-4;s<0&&(s=0),r>1&&(r=1);let o=this.getPoint(s),a=this.getPoint(r),l=t||(o.isVector2?new ue:new S);return l.copy(a).sub(o).normalize(),l}getTangentAt(e,t){let n=this.getUtoTmapping(e);return this.getTangent(n,t)}computeFrenetFrames(e,t=!1){let n=new S,s=[],r=[],o=[],a=new S,l=new Qe;for(let f=0;f<=e;f++){let p=f/e;s[f]=this.getTangentAt(p,new S)}r[0]=new S,o[0]=new S;let c=Number.MAX_VALUE,h=Math.abs(s[0].x),u=Math.abs(s[0].y),d=Math.abs(s[0].z);h<=c&&(c=h,n.set(1,0,0)),u<=c&&(c=u,n.set(0,1,0)),d<=c&&n.set(0,0,1),a.crossVectors(s[0],n).normalize(),r[0].crossVectors(s[0],a),o[0].crossVectors(s[0],r[0]);for(let f=1;f<=e;f++){if(r[f]=r[f-1].clone(),o[f]=o[f-1].clone(),a.crossVectors(s[f-1],s[f]),a.length()>Number.EPSILON){a.normalize();let p=Math.acos(mt(s[f-1].dot(s[f]),-1,1));r[f].applyMatrix4(l.makeRotationAxis(a,p))}o[f].crossVectors(s[f],r[f])}if(t===!0){let f=Math.acos(mt(r[0].dot(r[e]),-1,1));f/=e,s[0].dot(a.crossVectors(r[0],r[e]))>0&&(f=-f);for(let p=1;p<=e;p++)r[p].applyMatrix4(l.makeRotationAxis(s[p],f*p)),o[p].crossVectors(s[p],r[p])}return{tangents:s,normals:r,binormals:o}}clone(){return new this.constructor().copy(this)}copy(e){return this.arcLengthDivisions=e.arcLengthDivisions,this.cacheArcLengths=null,this}toJSON(){let e={metadata:{version:4.7,type:"Curve",generator:"Curve.toJSON"}};return e.arcLengthDivisions=this.arcLengthDivisions,e.type=this.type,e}fromJSON(e){return this.arcLengthDivisions=e.arcLengthDivisions,this.cacheArcLengths=null,this}},Oo=class extends Ri{constructor(e=0,t=0,n=1,s=1,r=0,o=Math.PI*2,a=!1,l=0){super(),this.isEllipseCurve=!0,this.type="EllipseCurve",this.aX=e,this.aY=t,this.xRadius=n,this.yRadius=s,this.aStartAngle=r,this.aEndAngle=o,this.aClockwise=a,this.aRotation=l}getPoint(e,t=new ue){let n=t,s=Math.PI*2,r=this.aEndAngle-this.aStartAngle,o=Math.abs(r)<Number.EPSILON;for(;r<0;)r+=s;for(;r>s;)r-=s;r<Number.EPSILON&&(o?r=0:r=s),this.aClockwise===!0&&!o&&(r===s?r=-s:r=r-s);let a=this.aStartAngle+e*r,l=this.aX+this.xRadius*Math.cos(a),c=this.aY+this.yRadius*Math.sin(a);if(this.aRotation!==0){let h=Math.cos(this.aRotation),u=Math.sin(this.aRotation),d=l-this.aX,f=c-this.aY;l=d*h-f*u+this.aX,c=d*u+f*h+this.aY}return n.set(l,c)}copy(e){return super.copy(e),this.aX=e.aX,this.aY=e.aY,this.xRadius=e.xRadius,this.yRadius=e.yRadius,this.aStartAngle=e.aStartAngle,this.aEndAngle=e.aEndAngle,this.aClockwise=e.aClockwise,this.aRotation=e.aRotation,this}toJSON(){let e=super.toJSON();return e.aX=this.aX,e.aY=this.aY,e.xRadius=this.xRadius,e.yRadius=this.yRadius,e.aStartAngle=this.aStartAngle,e.aEndAngle=this.aEndAngle,e.aClockwise=this.aClockwise,e.aRotation=this.aRotation,e}fromJSON(e){return super.fromJSON(e),this.aX=e.aX,this.aY=e.aY,this.xRadius=e.xRadius,this.yRadius=e.yRadius,this.aStartAngle=e.aStartAngle,this.aEndAngle=e.aEndAngle,this.aClockwise=e.aClockwise,this.aRotation=e.aRotation,this}},nh=class extends Oo{constructor(e,t,n,s,r,o){super(e,t,n,n,s,r,o),this.isArcCurve=!0,this.type="ArcCurve"}};function yp(){let i=0,e=0,t=0,n=0;function s(r,o,a,l){i=r,e=a,t=-3*r+3*o-2*a-l,n=2*r-2*o+a+l}return{initCatmullRom:function(r,o,a,l,c){s(o,a,c*(a-r),c*(l-o))},initNonuniformCatmullRom:function(r,o,a,l,c,h,u){let d=(o-r)/c-(a-r)/(c+h)+(a-o)/h,f=(a-o)/h-(l-o)/(h+u)+(l-a)/u;d*=h,f*=h,s(o,a,d,f)},calc:function(r){let o=r*r,a=o*r;return i+e*r+t*o+n*a}}}var Zg=new S,Jg=new S,Mf=new yp,Sf=new yp,Tf=new yp,hr=class extends Ri{constructor(e=[],t=!1,n="centripetal",s=.5){super(),this.isCatmullRomCurve3=!0,this.type="CatmullRomCurve3",this.points=e,this.closed=t,this.curveType=n,this.tension=s}getPoint(e,t=new S){let n=t,s=this.points,r=s.length,o=(r-(this.closed?0:1))*e,a=Math.floor(o),l=o-a;this.closed?a+=a>0?0:(Math.floor(Math.abs(a)/r)+1)*r:l===0&&a===r-1&&(a=r-2,l=1);let c,h;this.closed||a>0?c=s[(a-1)%r]:(Jg.subVectors(s[0],s[1]).add(s[0]),c=Jg);let u=s[a%r],d=s[(a+1)%r];if(this.closed||a+2<r?h=s[(a+2)%r]:(Zg.subVectors(s[r-1],s[r-2]).add(s[r-1]),h=Zg),this.curveType==="centripetal"||this.curveType==="chordal"){let f=this.curveType==="chordal"?.5:.25,p=Math.pow(c.distanceToSquared(u),f),v=Math.pow(u.distanceToSquared(d),f),g=Math.pow(d.distanceToSquared(h),f);v<1e-4&&(v=1),p<1e-4&&(p=v),g<1e-4&&(g=v),Mf.initNonuniformCatmullRom(c.x,u.x,d.x,h.x,p,v,g),Sf.initNonuniformCatmullRom(c.y,u.y,d.y,h.y,p,v,g),Tf.initNonuniformCatmullRom(c.z,u.z,d.z,h.z,p,v,g)}else this.curveType==="catmullrom"&&(Mf.initCatmullRom(c.x,u.x,d.x,h.x,this.tension),Sf.initCatmullRom(c.y,u.y,d.y,h.y,this.tension),Tf.initCatmullRom(c.z,u.z,d.z,h.z,this.tension));return n.set(Mf.calc(l),Sf.calc(l),Tf.calc(l)),n}copy(e){super.copy(e),this.points=[];for(let t=0,n=e.points.length;t<n;t++){let s=e.points[t];this.points.push(s.clone())}return this.closed=e.closed,this.curveType=e.curveType,this.tension=e.tension,this}toJSON(){let e=super.toJSON();e.points=[];for(let t=0,n=this.points.length;t<n;t++){let s=this.points[t];e.points.push(s.toArray())}return e.closed=this.closed,e.curveType=this.curveType,e.tension=this.tension,e}fromJSON(e){super.fromJSON(e),this.points=[];for(let t=0,n=e.points.length;t<n;t++){let s=e.points[t];this.points.push(new S().fromArray(s))}return this.closed=e.closed,this.curveType=e.curveType,this.tension=e.tension,this}};function Kg(i,e,t,n,s){let r=(n-e)*.5,o=(s-t)*.5,a=i*i,l=i*a;return(2*t-2*n+r+o)*l+(-3*t+3*n-2*r-o)*a+r*i+t}function RE(i,e){let t=1-i;return t*t*e}function CE(i,e){return 2*(1-i)*i*e}function PE(i,e){return i*i*e}function Pa(i,e,t,n){return RE(i,e)+CE(i,t)+PE(i,n)}function IE(i,e){let t=1-i;return t*t*t*e}function LE(i,e){let t=1-i;return 3*t*t*i*e}function NE(i,e){return 3*(1-i)*i*i*e}function DE(i,e){return i*i*i*e}function Ia(i,e,t,n,s){return IE(i,e)+LE(i,t)+NE(i,n)+DE(i,s)}var ja=class extends Ri{constructor(e=new ue,t=new ue,n=new ue,s=new ue){super(),this.isCubicBezierCurve=!0,this.type="CubicBezierCurve",this.v0=e,this.v1=t,this.v2=n,this.v3=s}getPoint(e,t=new ue){let n=t,s=this.v0,r=this.v1,o=this.v2,a=this.v3;return n.set(Ia(e,s.x,r.x,o.x,a.x),Ia(e,s.y,r.y,o.y,a.y)),n}copy(e){return super.copy(e),this.v0.copy(e.v0),this.v1.copy(e.v1),this.v2.copy(e.v2),this.v3.copy(e.v3),this}toJSON(){let e=super.toJSON();return e.v0=this.v0.toArray(),e.v1=this.v1.toArray(),e.v2=this.v2.toArray(),e.v3=this.v3.toArray(),e}fromJSON(e){return super.fromJSON(e),this.v0.fromArray(e.v0),this.v1.fromArray(e.v1),this.v2.fromArray(e.v2),this.v3.fromArray(e.v3),this}},ih=class extends Ri{constructor(e=new S,t=new S,n=new S,s=new S){super(),this.isCubicBezierCurve3=!0,this.type="CubicBezierCurve3",this.v0=e,this.v1=t,this.v2=n,this.v3=s}getPoint(e,t=new S){let n=t,s=this.v0,r=this.v1,o=this.v2,a=this.v3;return n.set(Ia(e,s.x,r.x,o.x,a.x),Ia(e,s.y,r.y,o.y,a.y),Ia(e,s.z,r.z,o.z,a.z)),n}copy(e){return super.copy(e),this.v0.copy(e.v0),this.v1.copy(e.v1),this.v2.copy(e.v2),this.v3.copy(e.v3),this}toJSON(){let e=super.toJSON();return e.v0=this.v0.toArray(),e.v1=this.v1.toArray(),e.v2=this.v2.toArray(),e.v3=this.v3.toArray(),e}fromJSON(e){return super.fromJSON(e),this.v0.fromArray(e.v0),this.v1.fromArray(e.v1),this.v2.fromArray(e.v2),this.v3.fromArray(e.v3),this}},Za=class extends Ri{constructor(e=new ue,t=new ue){super(),this.isLineCurve=!0,this.type="LineCurve",this.v1=e,this.v2=t}getPoint(e,t=new ue){let n=t;return e===1?n.copy(this.v2):(n.copy(this.v2).sub(this.v1),n.multiplyScalar(e).add(this.v1)),n}getPointAt(e,t){return this.getPoint(e,t)}getTangent(e,t=new ue){return t.subVectors(this.v2,this.v1).normalize()}getTangentAt(e,t){return this.getTangent(e,t)}copy(e){return super.copy(e),this.v1.copy(e.v1),this.v2.copy(e.v2),this}toJSON(){let e=super.toJSON();return e.v1=this.v1.toArray(),e.v2=this.v2.toArray(),e}fromJSON(e){return super.fromJSON(e),this.v1.fromArray(e.v1),this.v2.fromArray(e.v2),this}},sh=class extends Ri{constructor(e=new S,t=new S){super(),this.isLineCurve3=!0,this.type="LineCurve3",this.v1=e,this.v2=t}getPoint(e,t=new S){let n=t;return e===1?n.copy(this.v2):(n.copy(this.v2).sub(this.v1),n.multiplyScalar(e).add(this.v1)),n}getPointAt(e,t){return this.getPoint(e,t)}getTangent(e,t=new S){return t.subVectors(this.v2,this.v1).normalize()}getTangentAt(e,t){return this.getTangent(e,t)}copy(e){return super.copy(e),this.v1.copy(e.v1),this.v2.copy(e.v2),this}toJSON(){let e=super.toJSON();return e.v1=this.v1.toArray(),e.v2=this.v2.toArray(),e}fromJSON(e){return super.fromJSON(e),this.v1.fromArray(e.v1),this.v2.fromArray(e.v2),this}},Ja=class extends Ri{constructor(e=new ue,t=new ue,n=new ue){super(),this.isQuadraticBezierCurve=!0,this.type="QuadraticBezierCurve",this.v0=e,this.v1=t,this.v2=n}getPoint(e,t=new ue){let n=t,s=this.v0,r=this.v1,o=this.v2;return n.set(Pa(e,s.x,r.x,o.x),Pa(e,s.y,r.y,o.y)),n}copy(e){return super.copy(e),this.v0.copy(e.v0),this.v1.copy(e.v1),this.v2.copy(e.v2),this}toJSON(){let e=super.toJSON();return e.v0=this.v0.toArray(),e.v1=this.v1.toArray(),e.v2=this.v2.toArray(),e}fromJSON(e){return super.fromJSON(e),this.v0.fromArray(e.v0),this.v1.fromArray(e.v1),this.v2.fromArray(e.v2),this}},Ka=class extends Ri{constructor(e=new S,t=new S,n=new S){super(),this.isQuadraticBezierCurve3=!0,this.type="QuadraticBezierCurve3",this.v0=e,this.v1=t,this.v2=n}getPoint(e,t=new S){let n=t,s=this.v0,r=this.v1,o=this.v2;return n.set(Pa(e,s.x,r.x,o.x),Pa(e,s.y,r.y,o.y),Pa(e,s.z,r.z,o.z)),n}copy(e){return super.copy(e),this.v0.copy(e.v0),this.v1.copy(e.v1),this.v2.copy(e.v2),this}toJSON(){let e=super.toJSON();return e.v0=this.v0.toArray(),e.v1=this.v1.toArray(),e.v2=this.v2.toArray(),e}fromJSON(e){return super.fromJSON(e),this.v0.fromArray(e.v0),this.v1.fromArray(e.v1),this.v2.fromArray(e.v2),this}},Qa=class extends Ri{constructor(e=[]){super(),this.isSplineCurve=!0,this.type="SplineCurve",this.points=e}getPoint(e,t=new ue){let n=t,s=this.points,r=(s.length-1)*e,o=Math.floor(r),a=r-o,l=s[o===0?o:o-1],c=s[o],h=s[o>s.length-2?s.length-1:o+1],u=s[o>s.length-3?s.length-1:o+2];return n.set(Kg(a,l.x,c.x,h.x,u.x),Kg(a,l.y,c.y,h.y,u.y)),n}copy(e){super.copy(e),this.points=[];for(let t=0,n=e.points.length;t<n;t++){let s=e.points[t];this.points.push(s.clone())}return this}toJSON(){let e=super.toJSON();e.points=[];for(let t=0,n=this.points.length;t<n;t++){let s=this.points[t];e.points.push(s.toArray())}return e}fromJSON(e){super.fromJSON(e),this.points=[];for(let t=0,n=e.points.length;t<n;t++){let s=e.points[t];this.points.push(new ue().fromArray(s))}return this}},rh=Object.freeze({__proto__:null,ArcCurve:nh,CatmullRomCurve3:hr,CubicBezierCurve:ja,CubicBezierCurve3:ih,EllipseCurve:Oo,LineCurve:Za,LineCurve3:sh,QuadraticBezierCurve:Ja,QuadraticBezierCurve3:Ka,SplineCurve:Qa}),oh=class extends Ri{constructor(){super(),this.type="CurvePath",this.curves=[],this.autoClose=!1,this.cacheLengths=null}add(e){this.curves.push(e)}closePath(){let e=this.curves[0].getPoint(0),t=this.curves[this.curves.length-1].getPoint(1);if(!e.equals(t)){let n=e.isVector2===!0?"LineCurve":"LineCurve3";this.curves.push(new rh[n](t,e))}return this}getPoint(e,t){let n=e*this.getLength(),s=this.getCurveLengths(),r=0;for(;r<s.length;){if(s[r]>=n){let o=s[r]-n,a=this.curves[r],l=a.getLength(),c=l===0?0:1-o/l;return a.getPointAt(c,t)}r++}return null}getLength(){let e=this.getCurveLengths();return e[e.length-1]}updateArcLengths(){this.needsUpdate=!0,this.cacheLengths=null,this.getCurveLengths()}getCurveLengths(){if(this.cacheLengths&&this.cacheLengths.length===this.curves.length)return this.cacheLengths;let e=[],t=0;for(let n=0,s=this.curves.length;n<s;n++)t+=this.curves[n].getLength(),e.push(t);return this.cacheLengths=e,e}getSpacedPoints(e=40){let t=[];for(let n=0;n<=e;n++)t.push(this.getPoint(n/e));return this.autoClose&&t.push(t[0]),t}getPoints(e=12){let t=[],n;for(let s=0,r=this.curves;s<r.length;s++){let o=r[s],a=o.isEllipseCurve?e*2:o.isLineCurve||o.isLineCurve3?1:o.isSplineCurve?e*o.points.length:e,l=o.getPoints(a);for(let c=0;c<l.length;c++){let h=l[c];n&&n.equals(h)||(t.push(h),n=h)}}return this.autoClose&&t.length>1&&!t[t.length-1].equals(t[0])&&t.push(t[0]),t}copy(e){super.copy(e),this.curves=[];for(let t=0,n=e.curves.length;t<n;t++){let s=e.curves[t];this.curves.push(s.clone())}return this.autoClose=e.autoClose,this.cacheLengths=null,this}toJSON(){let e=super.toJSON();e.autoClose=this.autoClose,e.curves=[];for(let t=0,n=this.curves.length;t<n;t++){let s=this.curves[t];e.curves.push(s.toJSON())}return e}fromJSON(e){super.fromJSON(e),this.autoClose=e.autoClose,this.curves=[];for(let t=0,n=e.curves.length;t<n;t++){let s=e.curves[t];this.curves.push(new rh[s.type]().fromJSON(s))}return this.cacheLengths=null,this}},el=class extends oh{constructor(e){super(),this.type="Path",this.currentPoint=new ue,e&&this.setFromPoints(e)}setFromPoints(e){this.moveTo(e[0].x,e[0].y);for(let t=1,n=e.length;t<n;t++)this.lineTo(e[t].x,e[t].y);return this}moveTo(e,t){return this.currentPoint.set(e,t),this}lineTo(e,t){let n=new Za(this.currentPoint.clone(),new ue(e,t));return this.curves.push(n),this.currentPoint.set(e,t),this}quadraticCurveTo(e,t,n,s){let r=new Ja(this.currentPoint.clone(),new ue(e,t),new ue(n,s));return this.curves.push(r),this.currentPoint.set(n,s),this}bezierCurveTo(e,t,n,s,r,o){let a=new ja(this.currentPoint.clone(),new ue(e,t),new ue(n,s),new ue(r,o));return this.curves.push(a),this.currentPoint.set(r,o),this}splineThru(e){let t=[this.currentPoint.clone()].concat(e),n=new Qa(t);return this.curves.push(n),this.currentPoint.copy(e[e.length-1]),this}arc(e,t,n,s,r,o){let a=this.currentPoint.x,l=this.currentPoint.y;return this.absarc(e+a,t+l,n,s,r,o),this}absarc(e,t,n,s,r,o){return this.absellipse(e,t,n,n,s,r,o),this}ellipse(e,t,n,s,r,o,a,l){let c=this.currentPoint.x,h=this.currentPoint.y;return this.absellipse(e+c,t+h,n,s,r,o,a,l),this}absellipse(e,t,n,s,r,o,a,l){let c=new Oo(e,t,n,s,r,o,a,l);if(this.curves.length>0){let u=c.getPoint(0);u.equals(this.currentPoint)||this.lineTo(u.x,u.y)}this.curves.push(c);let h=c.getPoint(1);return this.currentPoint.copy(h),this}copy(e){return super.copy(e),this.currentPoint.copy(e.currentPoint),this}toJSON(){let e=super.toJSON();return e.currentPoint=this.currentPoint.toArray(),e}fromJSON(e){return super.fromJSON(e),this.currentPoint.fromArray(e.currentPoint),this}},Uo=class extends el{constructor(e){super(e),this.uuid=$s(),this.type="Shape",this.holes=[]}getPointsHoles(e){let t=[];for(let n=0,s=this.holes.length;n<s;n++)t[n]=this.holes[n].getPoints(e);return t}extractPoints(e){return{shape:this.getPoints(e),holes:this.getPointsHoles(e)}}copy(e){super.copy(e),this.holes=[];for(let t=0,n=e.holes.length;t<n;t++){let s=e.holes[t];this.holes.push(s.clone())}return this}toJSON(){let e=super.toJSON();e.uuid=this.uuid,e.holes=[];for(let t=0,n=this.holes.length;t<n;t++){let s=this.holes[t];e.holes.push(s.toJSON())}return e}fromJSON(e){super.fromJSON(e),this.uuid=e.uuid,this.holes=[];for(let t=0,n=e.holes.length;t<n;t++){let s=e.holes[t];this.holes.push(new el().fromJSON(s))}return this}};function FE(i,e,t=2){let n=e&&e.length,s=n?e[0]*t:i.length,r=Z0(i,0,s,t,!0),o=[];if(!r||r.next===r.prev)return o;let a,l,c;if(n&&(r=HE(i,e,r,t)),i.length>80*t){a=i[0],l=i[1];let h=a,u=l;for(let d=t;d<s;d+=t){let f=i[d],p=i[d+1];f<a&&(a=f),p<l&&(l=p),f>h&&(h=f),p>u&&(u=p)}c=Math.max(h-a,u-l),c=c!==0?32767/c:0}return tl(r,o,t,a,l,c,0),o}function Z0(i,e,t,n,s){let r;if(s===JE(i,e,t,n)>0)for(let o=e;o<t;o+=n)r=Qg(o/n|0,i[o],i[o+1],r);else for(let o=t-n;o>=e;o-=n)r=Qg(o/n|0,i[o],i[o+1],r);return r&&ko(r,r.next)&&(il(r),r=r.next),r}function Dr(i,e){if(!i)return i;e||(e=i);let t=i,n;do if(n=!1,!t.steiner&&(ko(t,t.next)||ln(t.prev,t,t.next)===0)){if(il(t),t=e=t.prev,t===t.next)break;n=!0}else t=t.next;while(n||t!==e);return e}function tl(i,e,t,n,s,r,o){if(!i)return;!o&&r&&XE(i,n,s,r);let a=i;for(;i.prev!==i.next;){let l=i.prev,c=i.next;if(r?UE(i,n,s,r):OE(i)){e.push(l.i,i.i,c.i),il(i),i=c.next,a=c.next;continue}if(i=c,i===a){o?o===1?(i=kE(Dr(i),e),tl(i,e,t,n,s,r,2)):o===2&&BE(i,e,t,n,s,r):tl(Dr(i),e,t,n,s,r,1);break}}}function OE(i){let e=i.prev,t=i,n=i.next;if(ln(e,t,n)>=0)return!1;let s=e.x,r=t.x,o=n.x,a=e.y,l=t.y,c=n.y,h=Math.min(s,r,o),u=Math.min(a,l,c),d=Math.max(s,r,o),f=Math.max(a,l,c),p=n.next;for(;p!==e;){if(p.x>=h&&p.x<=d&&p.y>=u&&p.y<=f&&Aa(s,a,r,l,o,c,p.x,p.y)&&ln(p.prev,p,p.next)>=0)return!1;p=p.next}return!0}function UE(i,e,t,n){let s=i.prev,r=i,o=i.next;if(ln(s,r,o)>=0)return!1;let a=s.x,l=r.x,c=o.x,h=s.y,u=r.y,d=o.y,f=Math.min(a,l,c),p=Math.min(h,u,d),v=Math.max(a,l,c),g=Math.max(h,u,d),m=Df(f,p,e,t,n),y=Df(v,g,e,t,n),b=i.prevZ,x=i.nextZ;for(;b&&b.z>=m&&x&&x.z<=y;){if(b.x>=f&&b.x<=v&&b.y>=p&&b.y<=g&&b!==s&&b!==o&&Aa(a,h,l,u,c,d,b.x,b.y)&&ln(b.prev,b,b.next)>=0||(b=b.prevZ,x.x>=f&&x.x<=v&&x.y>=p&&x.y<=g&&x!==s&&x!==o&&Aa(a,h,l,u,c,d,x.x,x.y)&&ln(x.prev,x,x.next)>=0))return!1;x=x.nextZ}for(;b&&b.z>=m;){if(b.x>=f&&b.x<=v&&b.y>=p&&b.y<=g&&b!==s&&b!==o&&Aa(a,h,l,u,c,d,b.x,b.y)&&ln(b.prev,b,b.next)>=0)return!1;b=b.prevZ}for(;x&&x.z<=y;){if(x.x>=f&&x.x<=v&&x.y>=p&&x.y<=g&&x!==s&&x!==o&&Aa(a,h,l,u,c,d,x.x,x.y)&&ln(x.prev,x,x.next)>=0)return!1;x=x.nextZ}return!0}function kE(i,e){let t=i;do{let n=t.prev,s=t.next.next;!ko(n,s)&&K0(n,t,t.next,s)&&nl(n,s)&&nl(s,n)&&(e.push(n.i,t.i,s.i),il(t),il(t.next),t=i=s),t=t.next}while(t!==i);return Dr(t)}function BE(i,e,t,n,s,r){let o=i;do{let a=o.next.next;for(;a!==o.prev;){if(o.i!==a.i&&$E(o,a)){let l=Q0(o,a);o=Dr(o,o.next),l=Dr(l,l.next),tl(o,e,t,n,s,r,0),tl(l,e,t,n,s,r,0);return}a=a.next}o=o.next}while(o!==i)}function HE(i,e,t,n){let s=[];for(let r=0,o=e.length;r<o;r++){let a=e[r]*n,l=r<o-1?e[r+1]*n:i.length,c=Z0(i,a,l,n,!1);c===c.next&&(c.steiner=!0),s.push(YE(c))}s.sort(zE);for(let r=0;r<s.length;r++)t=VE(s[r],t);return t}function zE(i,e){let t=i.x-e.x;if(t===0&&(t=i.y-e.y,t===0)){let n=(i.next.y-i.y)/(i.next.x-i.x),s=(e.next.y-e.y)/(e.next.x-e.x);t=n-s}return t}function VE(i,e){let t=GE(i,e);if(!t)return e;let n=Q0(t,i);return Dr(n,n.next),Dr(t,t.next)}function GE(i,e){let t=e,n=i.x,s=i.y,r=-1/0,o;if(ko(i,t))return t;do{if(ko(i,t.next))return t.next;if(s<=t.y&&s>=t.next.y&&t.next.y!==t.y){let u=t.x+(s-t.y)*(t.next.x-t.x)/(t.next.y-t.y);if(u<=n&&u>r&&(r=u,o=t.x<t.next.x?t:t.next,u===n))return o}t=t.next}while(t!==e);if(!o)return null;let a=o,l=o.x,c=o.y,h=1/0;t=o;do{if(n>=t.x&&t.x>=l&&n!==t.x&&J0(s<c?n:r,s,l,c,s<c?r:n,s,t.x,t.y)){let u=Math.abs(s-t.y)/(n-t.x);nl(t,i)&&(u<h||u===h&&(t.x>o.x||t.x===o.x&&WE(o,t)))&&(o=t,h=u)}t=t.next}while(t!==a);return o}function WE(i,e){return ln(i.prev,i,e.prev)<0&&ln(e.next,i,i.next)<0}function XE(i,e,t,n){let s=i;do s.z===0&&(s.z=Df(s.x,s.y,e,t,n)),s.prevZ=s.prev,s.nextZ=s.next,s=s.next;while(s!==i);s.prevZ.nextZ=null,s.prevZ=null,qE(s)}function qE(i){let e,t=1;do{let n=i,s;i=null;let r=null;for(e=0;n;){e++;let o=n,a=0;for(let c=0;c<t&&(a++,o=o.nextZ,!!o);c++);let l=t;for(;a>0||l>0&&o;)a!==0&&(l===0||!o||n.z<=o.z)?(s=n,n=n.nextZ,a--):(s=o,o=o.nextZ,l--),r?r.nextZ=s:i=s,s.prevZ=r,r=s;n=o}r.nextZ=null,t*=2}while(e>1);return i}function Df(i,e,t,n,s){return i=(i-t)*s|0,e=(e-n)*s|0,i=(i|i<<8)&16711935,i=(i|i<<4)&252645135,i=(i|i<<2)&858993459,i=(i|i<<1)&1431655765,e=(e|e<<8)&16711935,e=(e|e<<4)&252645135,e=(e|e<<2)&858993459,e=(e|e<<1)&1431655765,i|e<<1}function YE(i){let e=i,t=i;do(e.x<t.x||e.x===t.x&&e.y<t.y)&&(t=e),e=e.next;while(e!==i);return t}function J0(i,e,t,n,s,r,o,a){return(s-o)*(e-a)>=(i-o)*(r-a)&&(i-o)*(n-a)>=(t-o)*(e-a)&&(t-o)*(r-a)>=(s-o)*(n-a)}function Aa(i,e,t,n,s,r,o,a){return!(i===o&&e===a)&&J0(i,e,t,n,s,r,o,a)}function $E(i,e){return i.next.i!==e.i&&i.prev.i!==e.i&&!jE(i,e)&&(nl(i,e)&&nl(e,i)&&ZE(i,e)&&(ln(i.prev,i,e.prev)||ln(i,e.prev,e))||ko(i,e)&&ln(i.prev,i,i.next)>0&&ln(e.prev,e,e.next)>0)}function ln(i,e,t){return(e.y-i.y)*(t.x-e.x)-(e.x-i.x)*(t.y-e.y)}function ko(i,e){return i.x===e.x&&i.y===e.y}function K0(i,e,t,n){let s=Nc(ln(i,e,t)),r=Nc(ln(i,e,n)),o=Nc(ln(t,n,i)),a=Nc(ln(t,n,e));return!!(s!==r&&o!==a||s===0&&Lc(i,t,e)||r===0&&Lc(i,n,e)||o===0&&Lc(t,i,n)||a===0&&Lc(t,e,n))}function Lc(i,e,t){return e.x<=Math.max(i.x,t.x)&&e.x>=Math.min(i.x,t.x)&&e.y<=Math.max(i.y,t.y)&&e.y>=Math.min(i.y,t.y)}function Nc(i){return i>0?1:i<0?-1:0}function jE(i,e){let t=i;do{if(t.i!==i.i&&t.next.i!==i.i&&t.i!==e.i&&t.next.i!==e.i&&K0(t,t.next,i,e))return!0;t=t.next}while(t!==i);return!1}function nl(i,e){return ln(i.prev,i,i.next)<0?ln(i,e,i.next)>=0&&ln(i,i.prev,e)>=0:ln(i,e,i.prev)<0||ln(i,i.next,e)<0}function ZE(i,e){let t=i,n=!1,s=(i.x+e.x)/2,r=(i.y+e.y)/2;do t.y>r!=t.next.y>r&&t.next.y!==t.y&&s<(t.next.x-t.x)*(r-t.y)/(t.next.y-t.y)+t.x&&(n=!n),t=t.next;while(t!==i);return n}function Q0(i,e){let t=Ff(i.i,i.x,i.y),n=Ff(e.i,e.x,e.y),s=i.next,r=e.prev;return i.next=e,e.prev=i,t.next=s,s.prev=t,n.next=t,t.prev=n,r.next=n,n.prev=r,n}function Qg(i,e,t,n){let s=Ff(i,e,t);return n?(s.next=n.next,s.prev=n,n.next.prev=s,n.next=s):(s.prev=s,s.next=s),s}function il(i){i.next.prev=i.prev,i.prev.next=i.next,i.prevZ&&(i.prevZ.nextZ=i.nextZ),i.nextZ&&(i.nextZ.prevZ=i.prevZ)}function Ff(i,e,t){return{i,x:e,y:t,prev:null,next:null,z:0,prevZ:null,nextZ:null,steiner:!1}}function JE(i,e,t,n){let s=0;for(let r=e,o=t-n;r<t;r+=n)s+=(i[o]-i[r])*(i[r+1]+i[o+1]),o=r;return s}var Of=class{static triangulate(e,t,n=2){return FE(e,t,n)}},Os=class i{static area(e){let t=e.length,n=0;for(let s=t-1,r=0;r<t;s=r++)n+=e[s].x*e[r].y-e[r].x*e[s].y;return n*.5}static isClockWise(e){return i.area(e)<0}static triangulateShape(e,t){let n=[],s=[],r=[];e0(e),t0(n,e);let o=e.length;t.forEach(e0);for(let l=0;l<t.length;l++)s.push(o),o+=t[l].length,t0(n,t[l]);let a=Of.triangulate(n,s);for(let l=0;l<a.length;l+=3)r.push(a.slice(l,l+3));return r}};function e0(i){let e=i.length;e>2&&i[e-1].equals(i[0])&&i.pop()}function t0(i,e){for(let t=0;t<e.length;t++)i.push(e[t].x),i.push(e[t].y)}var sl=class i extends St{constructor(e=new Uo([new ue(.5,.5),new ue(-.5,.5),new ue(-.5,-.5),new ue(.5,-.5)]),t={}){super(),this.type="ExtrudeGeometry",this.parameters={shapes:e,options:t},e=Array.isArray(e)?e:[e];let n=this,s=[],r=[];for(let a=0,l=e.length;a<l;a++){let c=e[a];o(c)}this.setAttribute("position",new ot(s,3)),this.setAttribute("uv",new ot(r,2)),this.computeVertexNormals();function o(a){let l=[],c=t.curveSegments!==void 0?t.curveSegments:12,h=t.steps!==void 0?t.steps:1,u=t.depth!==void 0?t.depth:1,d=t.bevelEnabled!==void 0?t.bevelEnabled:!0,f=t.bevelThickness!==void 0?t.bevelThickness:.2,p=t.bevelSize!==void 0?t.bevelSize:f-.1,v=t.bevelOffset!==void 0?t.bevelOffset:0,g=t.bevelSegments!==void 0?t.bevelSegments:3,m=t.extrudePath,y=t.UVGenerator!==void 0?t.UVGenerator:KE,b,x=!1,T,M,_,w;if(m){b=m.getSpacedPoints(h),x=!0,d=!1;let oe=m.isCatmullRomCurve3?m.closed:!1;T=m.computeFrenetFrames(h,oe),M=new S,_=new S,w=new S}d||(g=0,f=0,p=0,v=0);let N=a.extractPoints(c),P=N.shape,I=N.holes;if(!Os.isClockWise(P)){P=P.reverse();for(let oe=0,_e=I.length;oe<_e;oe++){let ve=I[oe];Os.isClockWise(ve)&&(I[oe]=ve.reverse())}}function H(oe){let ve=10000000000000001e-36,ke=oe[0];for(let Ne=1;Ne<=oe.length;Ne++){let st=Ne%oe.length,Be=oe[st],xt=Be.x-ke.x,gt=Be.y-ke.y,bt=xt*xt+gt*gt,B=Math.max(Math.abs(Be.x),Math.abs(Be.y),Math.abs(ke.x),Math.abs(ke.y)),Ee=ve*B*B;if(bt<=Ee){oe.splice(st,1),Ne--;continue}ke=Be}}H(P),I.forEach(H);let L=I.length,k=P;for(let oe=0;oe<L;oe++){let _e=I[oe];P=P.concat(_e)}function q(oe,_e,ve){return _e||ht("ExtrudeGeometry: vec does not exist"),oe.clone().addScaledVector(_e,ve)}let V=P.length;function ce(oe,_e,ve){let ke,Ne,st,Be=oe.x-_e.x,xt=oe.y-_e.y,gt=ve.x-oe.x,bt=ve.y-oe.y,B=Be*Be+xt*xt,Ee=Be*bt-xt*gt;if(Math.abs(Ee)>Number.EPSILON){let Xe=Math.sqrt(B),ft=Math.sqrt(gt*gt+bt*bt),Se=_e.x-xt/Xe,zt=_e.y+Be/Xe,$e=ve.x-bt/ft,tt=ve.y+gt/ft,D=(($e-Se)*bt-(tt-zt)*gt)/(Be*bt-xt*gt);ke=Se+Be*D-oe.x,Ne=zt+xt*D-oe.y;let A=ke*ke+Ne*Ne;if(A<=2)return new ue(ke,Ne);st=Math.sqrt(A/2)}else{let Xe=!1;Be>Number.EPSILON?gt>Number.EPSILON&&(Xe=!0):Be<-Number.EPSILON?gt<-Number.EPSILON&&(Xe=!0):Math.sign(xt)===Math.sign(bt)&&(Xe=!0),Xe?(ke=-xt,Ne=Be,st=Math.sqrt(B)):(ke=Be,Ne=xt,st=Math.sqrt(B/2))}return new ue(ke/st,Ne/st)}let Z=[];for(let oe=0,_e=k.length,ve=_e-1,ke=oe+1;oe<_e;oe++,ve++,ke++)ve===_e&&(ve=0),ke===_e&&(ke=0),Z[oe]=ce(k[oe],k[ve],k[ke]);let Q=[],te,pe=Z.concat();for(let oe=0,_e=L;oe<_e;oe++){let ve=I[oe];te=[];for(let ke=0,Ne=ve.length,st=Ne-1,Be=ke+1;ke<Ne;ke++,st++,Be++)st===Ne&&(st=0),Be===Ne&&(Be=0),te[ke]=ce(ve[ke],ve[st],ve[Be]);Q.push(te),pe=pe.concat(te)}let he;if(g===0)he=Os.triangulateShape(k,I);else{let oe=[],_e=[];for(let ve=0;ve<g;ve++){let ke=ve/g,Ne=f*Math.cos(ke*Math.PI/2),st=p*Math.sin(ke*Math.PI/2)+v;for(let Be=0,xt=k.length;Be<xt;Be++){let gt=q(k[Be],Z[Be],st);Ve(gt.x,gt.y,-Ne),ke===0&&oe.push(gt)}for(let Be=0,xt=L;Be<xt;Be++){let gt=I[Be];te=Q[Be];let bt=[];for(let B=0,Ee=gt.length;B<Ee;B++){let Xe=q(gt[B],te[B],st);Ve(Xe.x,Xe.y,-Ne),ke===0&&bt.push(Xe)}ke===0&&_e.push(bt)}}he=Os.triangulateShape(oe,_e)}let ee=he.length,ye=p+v;for(let oe=0;oe<V;oe++){let _e=d?q(P[oe],pe[oe],ye):P[oe];x?(_.copy(T.normals[0]).multiplyScalar(_e.x),M.copy(T.binormals[0]).multiplyScalar(_e.y),w.copy(b[0]).add(_).add(M),Ve(w.x,w.y,w.z)):Ve(_e.x,_e.y,0)}for(let oe=1;oe<=h;oe++)for(let _e=0;_e<V;_e++){let ve=d?q(P[_e],pe[_e],ye):P[_e];x?(_.copy(T.normals[oe]).multiplyScalar(ve.x),M.copy(T.binormals[oe]).multiplyScalar(ve.y),w.copy(b[oe]).add(_).add(M),Ve(w.x,w.y,w.z)):Ve(ve.x,ve.y,u/h*oe)}for(let oe=g-1;oe>=0;oe--){let _e=oe/g,ve=f*Math.cos(_e*Math.PI/2),ke=p*Math.sin(_e*Math.PI/2)+v;for(let Ne=0,st=k.length;Ne<st;Ne++){let Be=q(k[Ne],Z[Ne],ke);Ve(Be.x,Be.y,u+ve)}for(let Ne=0,st=I.length;Ne<st;Ne++){let Be=I[Ne];te=Q[Ne];for(let xt=0,gt=Be.length;xt<gt;xt++){let bt=q(Be[xt],te[xt],ke);x?Ve(bt.x,bt.y+b[h-1].y,b[h-1].x+ve):Ve(bt.x,bt.y,u+ve)}}}xe(),Le();function xe(){let oe=s.length/3;if(d){let _e=0,ve=V*_e;for(let ke=0;ke<ee;ke++){let Ne=he[ke];at(Ne[2]+ve,Ne[1]+ve,Ne[0]+ve)}_e=h+g*2,ve=V*_e;for(let ke=0;ke<ee;ke++){let Ne=he[ke];at(Ne[0]+ve,Ne[1]+ve,Ne[2]+ve)}}else{for(let _e=0;_e<ee;_e++){let ve=he[_e];at(ve[2],ve[1],ve[0])}for(let _e=0;_e<ee;_e++){let ve=he[_e];at(ve[0]+V*h,ve[1]+V*h,ve[2]+V*h)}}n.addGroup(oe,s.length/3-oe,0)}function Le(){let oe=s.length/3,_e=0;Me(k,_e),_e+=k.length;for(let ve=0,ke=I.length;ve<ke;ve++){let Ne=I[ve];Me(Ne,_e),_e+=Ne.length}n.addGroup(oe,s.length/3-oe,1)}function Me(oe,_e){let ve=oe.length;for(;--ve>=0;){let ke=ve,Ne=ve-1;Ne<0&&(Ne=oe.length-1);for(let st=0,Be=h+g*2;st<Be;st++){let xt=V*st,gt=V*(st+1),bt=_e+ke+xt,B=_e+Ne+xt,Ee=_e+Ne+gt,Xe=_e+ke+gt;Ze(bt,B,Ee,Xe)}}}function Ve(oe,_e,ve){l.push(oe),l.push(_e),l.push(ve)}function at(oe,_e,ve){lt(oe),lt(_e),lt(ve);let ke=s.length/3,Ne=y.generateTopUV(n,s,ke-3,ke-2,ke-1);rt(Ne[0]),rt(Ne[1]),rt(Ne[2])}function Ze(oe,_e,ve,ke){lt(oe),lt(_e),lt(ke),lt(_e),lt(ve),lt(ke);let Ne=s.length/3,st=y.generateSideWallUV(n,s,Ne-6,Ne-3,Ne-2,Ne-1);rt(st[0]),rt(st[1]),rt(st[3]),rt(st[1]),rt(st[2]),rt(st[3])}function lt(oe){s.push(l[oe*3+0]),s.push(l[oe*3+1]),s.push(l[oe*3+2])}function rt(oe){r.push(oe.x),r.push(oe.y)}}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}toJSON(){let e=super.toJSON(),t=this.parameters.shapes,n=this.parameters.options;return QE(t,n,e)}static fromJSON(e,t){let n=[];for(let r=0,o=e.shapes.length;r<o;r++){let a=t[e.shapes[r]];n.push(a)}let s=e.options.extrudePath;return s!==void 0&&(e.options.extrudePath=new rh[s.type]().fromJSON(s)),new i(n,e.options)}},KE={generateTopUV:function(i,e,t,n,s){let r=e[t*3],o=e[t*3+1],a=e[n*3],l=e[n*3+1],c=e[s*3],h=e[s*3+1];return[new ue(r,o),new ue(a,l),new ue(c,h)]},generateSideWallUV:function(i,e,t,n,s,r){let o=e[t*3],a=e[t*3+1],l=e[t*3+2],c=e[n*3],h=e[n*3+1],u=e[n*3+2],d=e[s*3],f=e[s*3+1],p=e[s*3+2],v=e[r*3],g=e[r*3+1],m=e[r*3+2];return Math.abs(a-h)<Math.abs(o-c)?[new ue(o,1-l),new ue(c,1-u),new ue(d,1-p),new ue(v,1-m)]:[new ue(a,1-l),new ue(h,1-u),new ue(f,1-p),new ue(g,1-m)]}};function QE(i,e,t){if(t.shapes=[],Array.isArray(i))for(let n=0,s=i.length;n<s;n++){let r=i[n];t.shapes.push(r.uuid)}else t.shapes.push(i.uuid);return t.options=Object.assign({},e),e.extrudePath!==void 0&&(t.options.extrudePath=e.extrudePath.toJSON()),t}var rl=class i extends St{constructor(e=[new ue(0,-.5),new ue(.5,0),new ue(0,.5)],t=12,n=0,s=Math.PI*2){super(),this.type="LatheGeometry",this.parameters={points:e,segments:t,phiStart:n,phiLength:s},t=Math.floor(t),s=mt(s,0,Math.PI*2);let r=[],o=[],a=[],l=[],c=[],h=1/t,u=new S,d=new ue,f=new S,p=new S,v=new S,g=0,m=0;for(let y=0;y<=e.length-1;y++)switch(y){case 0:g=e[y+1].x-e[y].x,m=e[y+1].y-e[y].y,f.x=m*1,f.y=-g,f.z=m*0,v.copy(f),f.normalize(),l.push(f.x,f.y,f.z);break;case e.length-1:v.normalize(),l.push(v.x,v.y,v.z);break;default:g=e[y+1].x-e[y].x,m=e[y+1].y-e[y].y,f.x=m*1,f.y=-g,f.z=m*0,p.copy(f),f.x+=v.x,f.y+=v.y,f.z+=v.z,f.normalize(),l.push(f.x,f.y,f.z),v.copy(p)}for(let y=0;y<=t;y++){let b=n+y*h*s,x=Math.sin(b),T=Math.cos(b);for(let M=0;M<=e.length-1;M++){u.x=e[M].x*x,u.y=e[M].y,u.z=e[M].x*T,o.push(u.x,u.y,u.z),d.x=y/t,d.y=M/(e.length-1),a.push(d.x,d.y);let _=l[3*M+0]*x,w=l[3*M+1],N=l[3*M+0]*T;c.push(_,w,N)}}for(let y=0;y<t;y++)for(let b=0;b<e.length-1;b++){let x=b+y*e.length,T=x,M=x+e.length,_=x+e.length+1,w=x+1;r.push(T,M,w),r.push(_,w,M)}this.setIndex(r),this.setAttribute("position",new ot(o,3)),this.setAttribute("uv",new ot(a,2)),this.setAttribute("normal",new ot(c,3))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.points,e.segments,e.phiStart,e.phiLength)}},ol=class i extends th{constructor(e=1,t=0){let n=[1,0,0,-1,0,0,0,1,0,0,-1,0,0,0,1,0,0,-1],s=[0,2,4,0,4,3,0,3,5,0,5,2,1,2,5,1,5,3,1,3,4,1,4,2];super(n,s,e,t),this.type="OctahedronGeometry",this.parameters={radius:e,detail:t}}static fromJSON(e){return new i(e.radius,e.detail)}},Vs=class i extends St{constructor(e=1,t=1,n=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:e,height:t,widthSegments:n,heightSegments:s};let r=e/2,o=t/2,a=Math.floor(n),l=Math.floor(s),c=a+1,h=l+1,u=e/a,d=t/l,f=[],p=[],v=[],g=[];for(let m=0;m<h;m++){let y=m*d-o;for(let b=0;b<c;b++){let x=b*u-r;p.push(x,-y,0),v.push(0,0,1),g.push(b/a),g.push(1-m/l)}}for(let m=0;m<l;m++)for(let y=0;y<a;y++){let b=y+c*m,x=y+c*(m+1),T=y+1+c*(m+1),M=y+1+c*m;f.push(b,x,M),f.push(x,T,M)}this.setIndex(f),this.setAttribute("position",new ot(p,3)),this.setAttribute("normal",new ot(v,3)),this.setAttribute("uv",new ot(g,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.width,e.height,e.widthSegments,e.heightSegments)}};var on=class i extends St{constructor(e=1,t=32,n=16,s=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:e,widthSegments:t,heightSegments:n,phiStart:s,phiLength:r,thetaStart:o,thetaLength:a},t=Math.max(3,Math.floor(t)),n=Math.max(2,Math.floor(n));let l=Math.min(o+a,Math.PI),c=0,h=[],u=new S,d=new S,f=[],p=[],v=[],g=[];for(let m=0;m<=n;m++){let y=[],b=m/n,x=o+b*a,T=e*Math.cos(x),M=Math.sqrt(e*e-T*T),_=0;m===0&&o===0?_=.5/t:m===n&&l===Math.PI&&(_=-.5/t);for(let w=0;w<=t;w++){let N=w/t,P=s+N*r;u.x=-M*Math.cos(P),u.y=T,u.z=M*Math.sin(P),p.push(u.x,u.y,u.z),d.copy(u).normalize(),v.push(d.x,d.y,d.z),g.push(N+_,1-b),y.push(c++)}h.push(y)}for(let m=0;m<n;m++)for(let y=0;y<t;y++){let b=h[m][y+1],x=h[m][y],T=h[m+1][y],M=h[m+1][y+1];(m!==0||o>0)&&f.push(b,x,M),(m!==n-1||l<Math.PI)&&f.push(x,T,M)}this.setIndex(f),this.setAttribute("position",new ot(p,3)),this.setAttribute("normal",new ot(v,3)),this.setAttribute("uv",new ot(g,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.radius,e.widthSegments,e.heightSegments,e.phiStart,e.phiLength,e.thetaStart,e.thetaLength)}};var Ci=class i extends St{constructor(e=1,t=.4,n=12,s=48,r=Math.PI*2,o=0,a=Math.PI*2){super(),this.type="TorusGeometry",this.parameters={radius:e,tube:t,radialSegments:n,tubularSegments:s,arc:r,thetaStart:o,thetaLength:a},n=Math.floor(n),s=Math.floor(s);let l=[],c=[],h=[],u=[],d=new S,f=new S,p=new S;for(let v=0;v<=n;v++){let g=o+v/n*a;for(let m=0;m<=s;m++){let y=m/s*r;f.x=(e+t*Math.cos(g))*Math.cos(y),f.y=(e+t*Math.cos(g))*Math.sin(y),f.z=t*Math.sin(g),c.push(f.x,f.y,f.z),d.x=e*Math.cos(y),d.y=e*Math.sin(y),p.subVectors(f,d).normalize(),h.push(p.x,p.y,p.z),u.push(m/s),u.push(v/n)}}for(let v=1;v<=n;v++)for(let g=1;g<=s;g++){let m=(s+1)*v+g-1,y=(s+1)*(v-1)+g-1,b=(s+1)*(v-1)+g,x=(s+1)*v+g;l.push(m,y,x),l.push(y,b,x)}this.setIndex(l),this.setAttribute("position",new ot(c,3)),this.setAttribute("normal",new ot(h,3)),this.setAttribute("uv",new ot(u,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.radius,e.tube,e.radialSegments,e.tubularSegments,e.arc,e.thetaStart,e.thetaLength)}};var Fr=class i extends St{constructor(e=new Ka(new S(-1,-1,0),new S(-1,1,0),new S(1,1,0)),t=64,n=1,s=8,r=!1){super(),this.type="TubeGeometry",this.parameters={path:e,tubularSegments:t,radius:n,radialSegments:s,closed:r};let o=e.computeFrenetFrames(t,r);this.tangents=o.tangents,this.normals=o.normals,this.binormals=o.binormals;let a=new S,l=new S,c=new ue,h=new S,u=[],d=[],f=[],p=[];v(),this.setIndex(p),this.setAttribute("position",new ot(u,3)),this.setAttribute("normal",new ot(d,3)),this.setAttribute("uv",new ot(f,2));function v(){for(let b=0;b<t;b++)g(b);g(r===!1?t:0),y(),m()}function g(b){h=e.getPointAt(b/t,h);let x=o.normals[b],T=o.binormals[b];for(let M=0;M<=s;M++){let _=M/s*Math.PI*2,w=Math.sin(_),N=-Math.cos(_);l.x=N*x.x+w*T.x,l.y=N*x.y+w*T.y,l.z=N*x.z+w*T.z,l.normalize(),d.push(l.x,l.y,l.z),a.x=h.x+n*l.x,a.y=h.y+n*l.y,a.z=h.z+n*l.z,u.push(a.x,a.y,a.z)}}function m(){for(let b=1;b<=t;b++)for(let x=1;x<=s;x++){let T=(s+1)*(b-1)+(x-1),M=(s+1)*b+(x-1),_=(s+1)*b+x,w=(s+1)*(b-1)+x;p.push(T,M,w),p.push(M,_,w)}}function y(){for(let b=0;b<=t;b++)for(let x=0;x<=s;x++)c.x=b/t,c.y=x/s,f.push(c.x,c.y)}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}toJSON(){let e=super.toJSON();return e.path=this.parameters.path.toJSON(),e}static fromJSON(e){return new i(new rh[e.path.type]().fromJSON(e.path),e.tubularSegments,e.radius,e.radialSegments,e.closed)}},al=class extends St{constructor(e=null){if(super(),this.type="WireframeGeometry",this.parameters={geometry:e},e!==null){let t=[],n=new Set,s=new S,r=new S;if(e.index!==null){let o=e.attributes.position,a=e.index,l=e.groups;l.length===0&&(l=[{start:0,count:a.count,materialIndex:0}]);for(let c=0,h=l.length;c<h;++c){let u=l[c],d=u.start,f=u.count;for(let p=d,v=d+f;p<v;p+=3)for(let g=0;g<3;g++){let m=a.getX(p+g),y=a.getX(p+(g+1)%3);s.fromBufferAttribute(o,m),r.fromBufferAttribute(o,y),n0(s,r,n)===!0&&(t.push(s.x,s.y,s.z),t.push(r.x,r.y,r.z))}}}else{let o=e.attributes.position;for(let a=0,l=o.count/3;a<l;a++)for(let c=0;c<3;c++){let h=3*a+c,u=3*a+(c+1)%3;s.fromBufferAttribute(o,h),r.fromBufferAttribute(o,u),n0(s,r,n)===!0&&(t.push(s.x,s.y,s.z),t.push(r.x,r.y,r.z))}}this.setAttribute("position",new ot(t,3))}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}};function n0(i,e,t){let n=`${i.x},${i.y},${i.z}-${e.x},${e.y},${e.z}`,s=`${e.x},${e.y},${e.z}-${i.x},${i.y},${i.z}`;return t.has(n)===!0||t.has(s)===!0?!1:(t.add(n),t.add(s),!0)}var ll=class extends Ki{constructor(e){super(),this.isShadowMaterial=!0,this.type="ShadowMaterial",this.color=new et(0),this.transparent=!0,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.fog=e.fog,this}};function Hr(i){let e={};for(let t in i){e[t]={};for(let n in i[t]){let s=i[t][n];if(i0(s))s.isRenderTargetTexture?(it("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),e[t][n]=null):e[t][n]=s.clone();else if(Array.isArray(s))if(i0(s[0])){let r=[];for(let o=0,a=s.length;o<a;o++)r[o]=s[o].clone();e[t][n]=r}else e[t][n]=s.slice();else e[t][n]=s}}return e}function Jn(i){let e={};for(let t=0;t<i.length;t++){let n=Hr(i[t]);for(let s in n)e[s]=n[s]}return e}function i0(i){return i&&(i.isColor||i.isMatrix3||i.isMatrix4||i.isVector2||i.isVector3||i.isVector4||i.isTexture||i.isQuaternion)}function ew(i){let e=[];for(let t=0;t<i.length;t++)e.push(i[t].clone());return e}function vp(i){let e=i.getRenderTarget();return e===null?i.outputColorSpace:e.isXRRenderTarget===!0?e.texture.colorSpace:Ct.workingColorSpace}var Rl={clone:Hr,merge:Jn},tw=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,nw=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,Bi=class extends Ki{constructor(e){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=tw,this.fragmentShader=nw,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,e!==void 0&&this.setValues(e)}copy(e){return super.copy(e),this.fragmentShader=e.fragmentShader,this.vertexShader=e.vertexShader,this.uniforms=Hr(e.uniforms),this.uniformsGroups=ew(e.uniformsGroups),this.defines=Object.assign({},e.defines),this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.fog=e.fog,this.lights=e.lights,this.clipping=e.clipping,this.extensions=Object.assign({},e.extensions),this.glslVersion=e.glslVersion,this.defaultAttributeValues=Object.assign({},e.defaultAttributeValues),this.index0AttributeName=e.index0AttributeName,this.uniformsNeedUpdate=e.uniformsNeedUpdate,this}toJSON(e){let t=super.toJSON(e);t.glslVersion=this.glslVersion,t.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?t.uniforms[s]={type:"t",value:o.toJSON(e).uuid}:o&&o.isColor?t.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?t.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?t.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?t.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?t.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?t.uniforms[s]={type:"m4",value:o.toArray()}:t.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(t.defines=this.defines),t.vertexShader=this.vertexShader,t.fragmentShader=this.fragmentShader,t.lights=this.lights,t.clipping=this.clipping;let n={};for(let s in this.extensions)this.extensions[s]===!0&&(n[s]=!0);return Object.keys(n).length>0&&(t.extensions=n),t}fromJSON(e,t){if(super.fromJSON(e,t),e.uniforms!==void 0)for(let n in e.uniforms){let s=e.uniforms[n];switch(this.uniforms[n]={},s.type){case"t":this.uniforms[n].value=t[s.value]||null;break;case"c":this.uniforms[n].value=new et().setHex(s.value);break;case"v2":this.uniforms[n].value=new ue().fromArray(s.value);break;case"v3":this.uniforms[n].value=new S().fromArray(s.value);break;case"v4":this.uniforms[n].value=new Gt().fromArray(s.value);break;case"m3":this.uniforms[n].value=new yt().fromArray(s.value);break;case"m4":this.uniforms[n].value=new Qe().fromArray(s.value);break;default:this.uniforms[n].value=s.value}}if(e.defines!==void 0&&(this.defines=e.defines),e.vertexShader!==void 0&&(this.vertexShader=e.vertexShader),e.fragmentShader!==void 0&&(this.fragmentShader=e.fragmentShader),e.glslVersion!==void 0&&(this.glslVersion=e.glslVersion),e.extensions!==void 0)for(let n in e.extensions)this.extensions[n]=e.extensions[n];return e.lights!==void 0&&(this.lights=e.lights),e.clipping!==void 0&&(this.clipping=e.clipping),this}},ah=class extends Bi{constructor(e){super(e),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var Gs=class extends Ki{constructor(e){super(),this.isMeshPhongMaterial=!0,this.type="MeshPhongMaterial",this.color=new et(16777215),this.specular=new et(1118481),this.shininess=30,this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new et(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=Al,this.normalScale=new ue(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new ps,this.combine=vl,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.specular.copy(e.specular),this.shininess=e.shininess,this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.emissive.copy(e.emissive),this.emissiveMap=e.emissiveMap,this.emissiveIntensity=e.emissiveIntensity,this.bumpMap=e.bumpMap,this.bumpScale=e.bumpScale,this.normalMap=e.normalMap,this.normalMapType=e.normalMapType,this.normalScale.copy(e.normalScale),this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.envMapIntensity=e.envMapIntensity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.flatShading=e.flatShading,this.fog=e.fog,this}};var ai=class extends Ki{constructor(e){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new et(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new et(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=Al,this.normalScale=new ue(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new ps,this.combine=vl,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.emissive.copy(e.emissive),this.emissiveMap=e.emissiveMap,this.emissiveIntensity=e.emissiveIntensity,this.bumpMap=e.bumpMap,this.bumpScale=e.bumpScale,this.normalMap=e.normalMap,this.normalMapType=e.normalMapType,this.normalScale.copy(e.normalScale),this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.envMapIntensity=e.envMapIntensity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.flatShading=e.flatShading,this.fog=e.fog,this}},lh=class extends Ki{constructor(e){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=U0,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(e)}copy(e){return super.copy(e),this.depthPacking=e.depthPacking,this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this}},ch=class extends Ki{constructor(e){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(e)}copy(e){return super.copy(e),this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this}};function bo(i,e){return!i||i.constructor===e?i:typeof e.BYTES_PER_ELEMENT=="number"?new e(i):Array.prototype.slice.call(i)}function Dc(i){return i!==void 0&&i.inTangents!==void 0&&i.outTangents!==void 0}var ur=class{constructor(e,t,n,s){this.parameterPositions=e,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new t.constructor(n),this.sampleValues=t,this.valueSize=n,this.settings=null,this.DefaultSettings_={}}evaluate(e){let t=this.parameterPositions,n=this._cachedIndex,s=t[n],r=t[n-1];n:{e:{let o;t:{i:if(!(e<s)){for(let a=n+2;;){if(s===void 0){if(e<r)break i;return n=t.length,this._cachedIndex=n,this.copySampleValue_(n-1)}if(n===a)break;if(r=s,s=t[++n],e<s)break e}o=t.length;break t}if(!(e>=r)){let a=t[1];e<a&&(n=2,r=a);for(let l=n-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(n===l)break;if(s=r,r=t[--n-1],e>=r)break e}o=n,n=0;break t}break n}for(;n<o;){let a=n+o>>>1;e<t[a]?o=a:n=a+1}if(s=t[n],r=t[n-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return n=t.length,this._cachedIndex=n,this.copySampleValue_(n-1)}this._cachedIndex=n,this.intervalChanged_(n,r,s)}return this.interpolate_(n,r,e,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(e){let t=this.resultBuffer,n=this.sampleValues,s=this.valueSize,r=e*s;for(let o=0;o!==s;++o)t[o]=n[r+o];return t}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},hh=class extends ur{constructor(e,t,n,s){super(e,t,n,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:Pf,endingEnd:Pf}}intervalChanged_(e,t,n){let s=this.parameterPositions,r=e-2,o=e+1,a=s[r],l=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case If:r=e,a=2*t-n;break;case Lf:r=s.length-2,a=t+s[r]-s[r+1];break;default:r=e,a=n}if(l===void 0)switch(this.getSettings_().endingEnd){case If:o=e,l=2*n-t;break;case Lf:o=1,l=n+s[1]-s[0];break;default:o=e-1,l=t}let c=(n-t)*.5,h=this.valueSize;this._weightPrev=c/(t-a),this._weightNext=c/(l-n),this._offsetPrev=r*h,this._offsetNext=o*h}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=this._offsetPrev,u=this._offsetNext,d=this._weightPrev,f=this._weightNext,p=(n-t)/(s-t),v=p*p,g=v*p,m=-d*g+2*d*v-d*p,y=(1+d)*g+(-1.5-2*d)*v+(-.5+d)*p+1,b=(-1-f)*g+(1.5+f)*v+.5*p,x=f*g-f*v;for(let T=0;T!==a;++T)r[T]=m*o[h+T]+y*o[c+T]+b*o[l+T]+x*o[u+T];return r}},uh=class extends ur{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=(n-t)/(s-t),u=1-h;for(let d=0;d!==a;++d)r[d]=o[c+d]*u+o[l+d]*h;return r}},dh=class extends ur{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e){return this.copySampleValue_(e-1)}},fh=class extends ur{interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=this.inTangents,u=this.outTangents;if(!h||!u){let p=(n-t)/(s-t),v=1-p;for(let g=0;g!==a;++g)r[g]=o[c+g]*v+o[l+g]*p;return r}let d=a*2,f=e-1;for(let p=0;p!==a;++p){let v=o[c+p],g=o[l+p],m=f*d+p*2,y=u[m],b=u[m+1],x=e*d+p*2,T=h[x],M=h[x+1],_=sw(n,t,y,T,s);r[p]=ey(_,v,b,M,g)}return r}};function ey(i,e,t,n,s){let r=1-i;return r*r*r*e+3*r*r*i*t+3*r*i*i*n+i*i*i*s}function iw(i,e,t,n,s){let r=1-i;return 3*r*r*(t-e)+6*r*i*(n-t)+3*i*i*(s-n)}function sw(i,e,t,n,s){let r=(i-e)/(s-e);for(let o=0;o<8;o++){let a=ey(r,e,t,n,s)-i;if(Math.abs(a)<1e-10)break;let l=iw(r,e,t,n,s);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-a/l))}return r}var Pi=class{constructor(e,t,n,s){if(e===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(t===void 0||t.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+e);this.name=e,this.times=bo(t,this.TimeBufferType),this.values=bo(n,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(e){let t=e.constructor,n;if(t.toJSON!==this.toJSON)n=t.toJSON(e);else{n={name:e.name,times:bo(e.times,Array),values:bo(e.values,Array)};let s=e.getInterpolation();s!==e.DefaultInterpolation&&(n.interpolation=s),Dc(e.settings)&&(n.settings={inTangents:bo(e.settings.inTangents,Array),outTangents:bo(e.settings.outTangents,Array)})}return n.type=e.ValueTypeName,n}InterpolantFactoryMethodDiscrete(e){return new dh(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodLinear(e){return new uh(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodSmooth(e){return new hh(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodBezier(e){let t=new fh(this.times,this.values,this.getValueSize(),e);return this.settings&&(t.inTangents=this.settings.inTangents,t.outTangents=this.settings.outTangents),t}setInterpolation(e){let t;switch(e){case La:t=this.InterpolantFactoryMethodDiscrete;break;case jc:t=this.InterpolantFactoryMethodLinear;break;case kc:t=this.InterpolantFactoryMethodSmooth;break;case Cf:t=this.InterpolantFactoryMethodBezier;break}if(t===void 0){let n="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(e!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(n);return it("KeyframeTrack:",n),this}return this.createInterpolant=t,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return La;case this.InterpolantFactoryMethodLinear:return jc;case this.InterpolantFactoryMethodSmooth:return kc;case this.InterpolantFactoryMethodBezier:return Cf}}getValueSize(){return this.values.length/this.times.length}shift(e){if(e!==0){let t=this.times;for(let n=0,s=t.length;n!==s;++n)t[n]+=e;Dc(this.settings)&&(s0(this.settings.inTangents,e),s0(this.settings.outTangents,e))}return this}scale(e){if(e!==1){let t=this.times;for(let n=0,s=t.length;n!==s;++n)t[n]*=e;Dc(this.settings)&&(r0(this.settings.inTangents,e),r0(this.settings.outTangents,e))}return this}trim(e,t){let n=this.times,s=n.length,r=0,o=s-1;for(;r!==s&&n[r]<e;)++r;for(;o!==-1&&n[o]>t;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=n.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let e=!0,t=this.getValueSize();t-Math.floor(t)!==0&&(ht("KeyframeTrack: Invalid value size in track.",this),e=!1);let n=this.times,s=this.values,r=n.length;r===0&&(ht("KeyframeTrack: Track is empty.",this),e=!1);let o=null;for(let a=0;a!==r;a++){let l=n[a];if(typeof l=="number"&&isNaN(l)){ht("KeyframeTrack: Time is not a valid number.",this,a,l),e=!1;break}if(o!==null&&o>l){ht("KeyframeTrack: Out of order keys.",this,a,l,o),e=!1;break}o=l}if(s!==void 0&&Hb(s))for(let a=0,l=s.length;a!==l;++a){let c=s[a];if(isNaN(c)){ht("KeyframeTrack: Value is not a valid number.",this,a,c),e=!1;break}}return e}optimize(){let e=this.times.slice(),t=this.values.slice(),n=this.getValueSize(),s=this.getInterpolation()===kc,r=e.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=e[a],h=e[a+1];if(c!==h&&(a!==1||c!==e[0]))if(s)l=!0;else{let u=a*n,d=u-n,f=u+n;for(let p=0;p!==n;++p){let v=t[u+p];if(v!==t[d+p]||v!==t[f+p]){l=!0;break}}}if(l){if(a!==o){e[o]=e[a];let u=a*n,d=o*n;for(let f=0;f!==n;++f)t[d+f]=t[u+f]}++o}}if(r>0){e[o]=e[r];for(let a=r*n,l=o*n,c=0;c!==n;++c)t[l+c]=t[a+c];++o}return o!==e.length?(this.times=e.slice(0,o),this.values=t.slice(0,o*n)):(this.times=e,this.values=t),this}clone(){let e=this.times.slice(),t=this.values.slice(),n=this.constructor,s=new n(this.name,e,t);return s.createInterpolant=this.createInterpolant,Dc(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function s0(i,e){for(let t=0,n=i.length;t!==n;t+=2)i[t]+=e}function r0(i,e){for(let t=0,n=i.length;t!==n;t+=2)i[t]*=e}Pi.prototype.ValueTypeName="";Pi.prototype.TimeBufferType=Float32Array;Pi.prototype.ValueBufferType=Float32Array;Pi.prototype.DefaultInterpolation=jc;var dr=class extends Pi{constructor(e,t,n){super(e,t,n)}};dr.prototype.ValueTypeName="bool";dr.prototype.ValueBufferType=Array;dr.prototype.DefaultInterpolation=La;dr.prototype.InterpolantFactoryMethodLinear=void 0;dr.prototype.InterpolantFactoryMethodSmooth=void 0;var ph=class extends Pi{constructor(e,t,n,s){super(e,t,n,s)}};ph.prototype.ValueTypeName="color";var mh=class extends Pi{constructor(e,t,n,s){super(e,t,n,s)}};mh.prototype.ValueTypeName="number";var gh=class extends ur{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(n-t)/(s-t),c=e*a;for(let h=c+a;c!==h;c+=4)nt.slerpFlat(r,0,o,c-a,o,c,l);return r}},cl=class extends Pi{constructor(e,t,n,s){super(e,t,n,s)}InterpolantFactoryMethodLinear(e){return new gh(this.times,this.values,this.getValueSize(),e)}};cl.prototype.ValueTypeName="quaternion";cl.prototype.InterpolantFactoryMethodSmooth=void 0;var fr=class extends Pi{constructor(e,t,n){super(e,t,n)}};fr.prototype.ValueTypeName="string";fr.prototype.ValueBufferType=Array;fr.prototype.DefaultInterpolation=La;fr.prototype.InterpolantFactoryMethodLinear=void 0;fr.prototype.InterpolantFactoryMethodSmooth=void 0;var yh=class extends Pi{constructor(e,t,n,s){super(e,t,n,s)}};yh.prototype.ValueTypeName="vector";var vh=class{constructor(e,t,n){let s=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=e,this.onProgress=t,this.onError=n,this._abortController=null,this.itemStart=function(h){a++,r===!1&&s.onStart!==void 0&&s.onStart(h,o,a),r=!0},this.itemEnd=function(h){o++,s.onProgress!==void 0&&s.onProgress(h,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(h){s.onError!==void 0&&s.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),l?l(h):h},this.setURLModifier=function(h){return l=h,this},this.addHandler=function(h,u){return c.push(h,u),this},this.removeHandler=function(h){let u=c.indexOf(h);return u!==-1&&c.splice(u,2),this},this.getHandler=function(h){for(let u=0,d=c.length;u<d;u+=2){let f=c[u],p=c[u+1];if(f.global&&(f.lastIndex=0),f.test(h))return p}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},ty=new vh,xh=class{constructor(e){this.manager=e!==void 0?e:ty,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(e,t){let n=this;return new Promise(function(s,r){n.load(e,s,t,r)})}parse(){}setCrossOrigin(e){return this.crossOrigin=e,this}setWithCredentials(e){return this.withCredentials=e,this}setPath(e){return this.path=e,this}setResourcePath(e){return this.resourcePath=e,this}setRequestHeader(e){return this.requestHeader=e,this}setPriority(e){return this.priority=e,this}setCache(e){return this.cache=e,this}abort(){return this}};xh.DEFAULT_MATERIAL_NAME="__DEFAULT";var hl=class extends cn{static registerNode(e){this.prototype._lightNode=e}constructor(e,t=1){super(),this.isLight=!0,this.type="Light",this.color=new et(e),this.intensity=t}copy(e,t){return super.copy(e,t),this.color.copy(e.color),this.intensity=e.intensity,this}toJSON(e){let t=super.toJSON(e);return t.object.color=this.color.getHex(),t.object.intensity=this.intensity,t}},ul=class extends hl{constructor(e,t,n){super(e,n),this.isHemisphereLight=!0,this.type="HemisphereLight",this.position.copy(cn.DEFAULT_UP),this.updateMatrix(),this.groundColor=new et(t)}copy(e,t){return super.copy(e,t),this.groundColor.copy(e.groundColor),this}toJSON(e){let t=super.toJSON(e);return t.object.groundColor=this.groundColor.getHex(),t}},Af=new Qe,o0=new S,a0=new S,_h=class{constructor(e){this.camera=e,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new ue(512,512),this.mapType=yi,this.map=null,this.mapPass=null,this.matrix=new Qe,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new Bs,this._frameExtents=new ue(1,1),this._viewportCount=1,this._viewports=[new Gt(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(e){let t=this.camera;o0.setFromMatrixPosition(e.matrixWorld),t.position.copy(o0),a0.setFromMatrixPosition(e.target.matrixWorld),t.lookAt(a0),t.updateMatrixWorld(),this._updateMatrix(t,this.matrix,this._frustum)}_updateMatrix(e,t,n,s){Af.multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse),n.setFromProjectionMatrix(Af,e.coordinateSystem,e.reversedDepth);let r=this._frameExtents,o=s?s.z/r.x:1,a=s?s.w/r.y:1,l=s?s.x/r.x:0,c=s?s.y/r.y:0;e.coordinateSystem===Co||e.reversedDepth?t.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,1,0,0,0,0,1):t.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,.5,.5,0,0,0,1),t.multiply(Af)}getViewport(e){return this._viewports[e]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(e){return this.camera=e.camera.clone(),this.intensity=e.intensity,this.bias=e.bias,this.radius=e.radius,this.autoUpdate=e.autoUpdate,this.needsUpdate=e.needsUpdate,this.normalBias=e.normalBias,this.blurSamples=e.blurSamples,this.mapSize.copy(e.mapSize),this.mapType=e.mapType,this.biasNode=e.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let e={};return e.intensity=this.intensity,e.bias=this.bias,e.normalBias=this.normalBias,e.radius=this.radius,e.blurSamples=this.blurSamples,e.mapSize=this.mapSize.toArray(),e.mapType=this.mapType,e.camera=this.camera.toJSON(!1).object,delete e.camera.matrix,e}},Fc=new S,Oc=new nt,ds=new S,dl=class extends cn{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new Qe,this.projectionMatrix=new Qe,this.projectionMatrixInverse=new Qe,this.coordinateSystem=Ui,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(e,t){return super.copy(e,t),this.matrixWorldInverse.copy(e.matrixWorldInverse),this.projectionMatrix.copy(e.projectionMatrix),this.projectionMatrixInverse.copy(e.projectionMatrixInverse),this.coordinateSystem=e.coordinateSystem,this}getWorldDirection(e){return super.getWorldDirection(e).negate()}updateMatrixWorld(e){super.updateMatrixWorld(e),this.matrixWorld.decompose(Fc,Oc,ds),ds.x===1&&ds.y===1&&ds.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Fc,Oc,ds.set(1,1,1)).invert()}updateWorldMatrix(e,t,n=!1){super.updateWorldMatrix(e,t,n),this.matrixWorld.decompose(Fc,Oc,ds),ds.x===1&&ds.y===1&&ds.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Fc,Oc,ds.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},ar=new S,l0=new ue,c0=new ue,ri=class extends dl{constructor(e=50,t=1,n=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=e,this.zoom=1,this.near=n,this.far=s,this.focus=10,this.aspect=t,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.fov=e.fov,this.zoom=e.zoom,this.near=e.near,this.far=e.far,this.focus=e.focus,this.aspect=e.aspect,this.view=e.view===null?null:Object.assign({},e.view),this.filmGauge=e.filmGauge,this.filmOffset=e.filmOffset,this}setFocalLength(e){let t=.5*this.getFilmHeight()/e;this.fov=Io*2*Math.atan(t),this.updateProjectionMatrix()}getFocalLength(){let e=Math.tan(To*.5*this.fov);return .5*this.getFilmHeight()/e}getEffectiveFOV(){return Io*2*Math.atan(Math.tan(To*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(e,t,n){ar.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),t.set(ar.x,ar.y).multiplyScalar(-e/ar.z),ar.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(ar.x,ar.y).multiplyScalar(-e/ar.z)}getViewSize(e,t){return this.getViewBounds(e,l0,c0),t.subVectors(c0,l0)}setViewOffset(e,t,n,s,r,o){this.aspect=e/t,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=this.near,t=e*Math.tan(To*.5*this.fov)/this.zoom,n=2*t,s=this.aspect*n,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*s/l,t-=o.offsetY*n/c,s*=o.width/l,n*=o.height/c}let a=this.filmOffset;a!==0&&(r+=e*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,t,t-n,e,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.fov=this.fov,t.object.zoom=this.zoom,t.object.near=this.near,t.object.far=this.far,t.object.focus=this.focus,t.object.aspect=this.aspect,this.view!==null&&(t.object.view=Object.assign({},this.view)),t.object.filmGauge=this.filmGauge,t.object.filmOffset=this.filmOffset,t}};var fl=class extends dl{constructor(e=-1,t=1,n=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=e,this.right=t,this.top=n,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.left=e.left,this.right=e.right,this.top=e.top,this.bottom=e.bottom,this.near=e.near,this.far=e.far,this.zoom=e.zoom,this.view=e.view===null?null:Object.assign({},e.view),this}setViewOffset(e,t,n,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=(this.right-this.left)/(2*this.zoom),t=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=n-e,o=n+e,a=s+t,l=s-t;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=h*this.view.offsetY,l=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.zoom=this.zoom,t.object.left=this.left,t.object.right=this.right,t.object.top=this.top,t.object.bottom=this.bottom,t.object.near=this.near,t.object.far=this.far,this.view!==null&&(t.object.view=Object.assign({},this.view)),t}},Uf=class extends _h{constructor(){super(new fl(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},pl=class extends hl{constructor(e,t){super(e,t),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(cn.DEFAULT_UP),this.updateMatrix(),this.target=new cn,this.shadow=new Uf}dispose(){super.dispose(),this.shadow.dispose()}copy(e){return super.copy(e),this.target=e.target.clone(),this.shadow=e.shadow.clone(),this}toJSON(e){let t=super.toJSON(e);return t.object.shadow=this.shadow.toJSON(),t.object.target=this.target.uuid,t}};var ml=class extends St{constructor(){super(),this.isInstancedBufferGeometry=!0,this.type="InstancedBufferGeometry",this.instanceCount=1/0}copy(e){return super.copy(e),this.instanceCount=e.instanceCount,this}toJSON(){let e=super.toJSON();return e.instanceCount=this.instanceCount,e.isInstancedBufferGeometry=!0,e}};var Eo=-90,wo=1,Bo=class extends cn{constructor(e,t,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new ri(Eo,wo,e,t);s.layers=this.layers,this.add(s);let r=new ri(Eo,wo,e,t);r.layers=this.layers,this.add(r);let o=new ri(Eo,wo,e,t);o.layers=this.layers,this.add(o);let a=new ri(Eo,wo,e,t);a.layers=this.layers,this.add(a);let l=new ri(Eo,wo,e,t);l.layers=this.layers,this.add(l);let c=new ri(Eo,wo,e,t);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let e=this.coordinateSystem,t=this.children.concat(),[n,s,r,o,a,l]=t;for(let c of t)this.remove(c);if(e===Ui)n.up.set(0,1,0),n.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(e===Co)n.up.set(0,-1,0),n.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+e);for(let c of t)this.add(c),c.updateMatrixWorld()}update(e,t){this.parent===null&&this.updateMatrixWorld();let{renderTarget:n,activeMipmapLevel:s}=this;this.coordinateSystem!==e.coordinateSystem&&(this.coordinateSystem=e.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,h]=this.children,u=e.getRenderTarget(),d=e.getActiveCubeFace(),f=e.getActiveMipmapLevel(),p=e.xr.enabled;e.xr.enabled=!1;let v=n.texture.mipmapsAutoUpdate;n.texture.mipmapsAutoUpdate=!1;let g=!1;e.isWebGLRenderer===!0?g=e.state.buffers.depth.getReversed():g=e.reversedDepthBuffer,e.setRenderTarget(n,0,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,r),e.setRenderTarget(n,1,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,o),e.setRenderTarget(n,2,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,a),e.setRenderTarget(n,3,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,l),e.setRenderTarget(n,4,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,c),n.texture.mipmapsAutoUpdate=v,e.setRenderTarget(n,5,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,h),e.setRenderTarget(u,d,f),e.xr.enabled=p,n.texture.needsPMREMUpdate=!0}},bh=class extends ri{constructor(e=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=e,this.perCameraFrustumCulled=!1}};var xp="\\[\\]\\.:\\/",rw=new RegExp("["+xp+"]","g"),_p="[^"+xp+"]",ow="[^"+xp.replace("\\.","")+"]",aw=/((?:WC+[\/:])*)/.source.replace("WC",_p),lw=/(WCOD+)?/.source.replace("WCOD",ow),cw=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",_p),hw=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",_p),uw=new RegExp("^"+aw+lw+cw+hw+"$"),dw=["material","materials","bones","map"],kf=class{constructor(e,t,n){let s=n||nn.parseTrackName(t);this._targetGroup=e,this._bindings=e.subscribe_(t,s)}getValue(e,t){this.bind();let n=this._targetGroup.nCachedObjects_,s=this._bindings[n];s!==void 0&&s.getValue(e,t)}setValue(e,t){let n=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=n.length;s!==r;++s)n[s].setValue(e,t)}bind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,n=e.length;t!==n;++t)e[t].bind()}unbind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,n=e.length;t!==n;++t)e[t].unbind()}},nn=class i{constructor(e,t,n){this.path=t,this.parsedPath=n||i.parseTrackName(t),this.node=i.findNode(e,this.parsedPath.nodeName),this.rootNode=e,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(e,t,n){return e&&e.isAnimationObjectGroup?new i.Composite(e,t,n):new i(e,t,n)}static sanitizeNodeName(e){return e.replace(/\s/g,"_").replace(rw,"")}static parseTrackName(e){let t=uw.exec(e);if(t===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+e);let n={nodeName:t[2],objectName:t[3],objectIndex:t[4],propertyName:t[5],propertyIndex:t[6]},s=n.nodeName&&n.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=n.nodeName.substring(s+1);dw.indexOf(r)!==-1&&(n.nodeName=n.nodeName.substring(0,s),n.objectName=r)}if(n.propertyName===null||n.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+e);return n}static findNode(e,t){if(t===void 0||t===""||t==="."||t===-1||t===e.name||t===e.uuid)return e;if(e.skeleton){let n=e.skeleton.getBoneByName(t);if(n!==void 0)return n}if(e.children){let n=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===t||a.uuid===t)return a;let l=n(a.children);if(l)return l}return null},s=n(e.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(e,t){e[t]=this.targetObject[this.propertyName]}_getValue_array(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)e[t++]=n[s]}_getValue_arrayElement(e,t){e[t]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(e,t){this.resolvedProperty.toArray(e,t)}_setValue_direct(e,t){this.targetObject[this.propertyName]=e[t]}_setValue_direct_setNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++]}_setValue_array_setNeedsUpdate(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(e,t){this.resolvedProperty[this.propertyIndex]=e[t]}_setValue_arrayElement_setNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(e,t){this.resolvedProperty.fromArray(e,t)}_setValue_fromArray_setNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(e,t){this.bind(),this.getValue(e,t)}_setValue_unbound(e,t){this.bind(),this.setValue(e,t)}bind(){let e=this.node,t=this.parsedPath,n=t.objectName,s=t.propertyName,r=t.propertyIndex;if(e||(e=i.findNode(this.rootNode,t.nodeName),this.node=e),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!e){it("PropertyBinding: No target node found for track: "+this.path+".");return}if(n){let c=t.objectIndex;switch(n){case"materials":if(!e.material){ht("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.materials){ht("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}e=e.material.materials;break;case"bones":if(!e.skeleton){ht("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}e=e.skeleton.bones;for(let h=0;h<e.length;h++)if(e[h].name===c){c=h;break}break;case"map":if("map"in e){e=e.map;break}if(!e.material){ht("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.map){ht("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}e=e.material.map;break;default:if(e[n]===void 0){ht("PropertyBinding: Can not bind to objectName of node undefined.",this);return}e=e[n]}if(c!==void 0){if(e[c]===void 0){ht("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,e);return}e=e[c]}}let o=e[s];if(o===void 0){let c=t.nodeName;ht("PropertyBinding: Trying to update property for track: "+c+"."+s+" but it wasn't found.",e);return}let a=this.Versioning.None;this.targetObject=e,e.isMaterial===!0?a=this.Versioning.NeedsUpdate:e.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!e.geometry){ht("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!e.geometry.morphAttributes){ht("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}e.morphTargetDictionary[r]!==void 0&&(r=e.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};nn.Composite=kf;nn.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};nn.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};nn.prototype.GetterByBindingType=[nn.prototype._getValue_direct,nn.prototype._getValue_array,nn.prototype._getValue_arrayElement,nn.prototype._getValue_toArray];nn.prototype.SetterByBindingTypeAndVersioning=[[nn.prototype._setValue_direct,nn.prototype._setValue_direct_setNeedsUpdate,nn.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[nn.prototype._setValue_array,nn.prototype._setValue_array_setNeedsUpdate,nn.prototype._setValue_array_setMatrixWorldNeedsUpdate],[nn.prototype._setValue_arrayElement,nn.prototype._setValue_arrayElement_setNeedsUpdate,nn.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[nn.prototype._setValue_fromArray,nn.prototype._setValue_fromArray_setNeedsUpdate,nn.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var YL=new Float32Array(1);var pr=class extends za{constructor(e,t,n=1){super(e,t),this.isInstancedInterleavedBuffer=!0,this.meshPerAttribute=n}copy(e){return super.copy(e),this.meshPerAttribute=e.meshPerAttribute,this}clone(e){let t=super.clone(e);return t.meshPerAttribute=this.meshPerAttribute,t}toJSON(e){let t=super.toJSON(e);return t.isInstancedInterleavedBuffer=!0,t.meshPerAttribute=this.meshPerAttribute,t}};var h0=new Qe,Ws=class{constructor(e,t,n=0,s=1/0){this.ray=new cr(e,t),this.near=n,this.far=s,this.camera=null,this.layers=new No,this.params={Mesh:{},Line:{threshold:1},LOD:{},Points:{threshold:1},Sprite:{}}}set(e,t){this.ray.set(e,t)}setFromCamera(e,t){t.isPerspectiveCamera?(this.ray.origin.setFromMatrixPosition(t.matrixWorld),this.ray.direction.set(e.x,e.y,.5).unproject(t).sub(this.ray.origin).normalize(),this.camera=t):t.isOrthographicCamera?(this.ray.origin.set(e.x,e.y,t.projectionMatrix.elements[14]).unproject(t),this.ray.direction.set(0,0,-1).transformDirection(t.matrixWorld),this.camera=t):ht("Raycaster: Unsupported camera type: "+t.type)}setFromXRController(e){return h0.identity().extractRotation(e.matrixWorld),this.ray.origin.setFromMatrixPosition(e.matrixWorld),this.ray.direction.set(0,0,-1).applyMatrix4(h0),this}intersectObject(e,t=!0,n=[]){return Bf(e,this,n,t),n.sort(u0),n}intersectObjects(e,t=!0,n=[]){for(let s=0,r=e.length;s<r;s++)Bf(e[s],this,n,t);return n.sort(u0),n}};function u0(i,e){return i.distance-e.distance}function Bf(i,e,t,n){let s=!0;if(i.layers.test(e.layers)&&i.raycast(e,t)===!1&&(s=!1),s===!0&&n===!0){let r=i.children;for(let o=0,a=r.length;o<a;o++)Bf(r[o],e,t,!0)}}var Ho=class{constructor(e=1,t=0,n=0){this.radius=e,this.phi=t,this.theta=n}set(e,t,n){return this.radius=e,this.phi=t,this.theta=n,this}copy(e){return this.radius=e.radius,this.phi=e.phi,this.theta=e.theta,this}makeSafe(){return this.phi=mt(this.phi,1e-6,Math.PI-1e-6),this}setFromVector3(e){return this.setFromCartesianCoords(e.x,e.y,e.z)}setFromCartesianCoords(e,t,n){return this.radius=Math.sqrt(e*e+t*t+n*n),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(e,n),this.phi=Math.acos(mt(t/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var Hf=class{static{this.prototype.isMatrix2=!0}constructor(e,t,n,s){this.elements=[1,0,0,1],e!==void 0&&this.set(e,t,n,s)}identity(){return this.set(1,0,0,1),this}fromArray(e,t=0){for(let n=0;n<4;n++)this.elements[n]=e[n+t];return this}set(e,t,n,s){let r=this.elements;return r[0]=e,r[2]=t,r[1]=n,r[3]=s,this}};var d0=new S,Uc=new S,Mo=new S,So=new S,Rf=new S,fw=new S,pw=new S,gl=class{constructor(e=new S,t=new S){this.start=e,this.end=t}set(e,t){return this.start.copy(e),this.end.copy(t),this}copy(e){return this.start.copy(e.start),this.end.copy(e.end),this}getCenter(e){return e.addVectors(this.start,this.end).multiplyScalar(.5)}delta(e){return e.subVectors(this.end,this.start)}distanceSq(){return this.start.distanceToSquared(this.end)}distance(){return this.start.distanceTo(this.end)}at(e,t){return this.delta(t).multiplyScalar(e).add(this.start)}closestPointToPointParameter(e,t){d0.subVectors(e,this.start),Uc.subVectors(this.end,this.start);let n=Uc.dot(Uc);if(n===0)return 0;let r=Uc.dot(d0)/n;return t&&(r=mt(r,0,1)),r}closestPointToPoint(e,t,n){let s=this.closestPointToPointParameter(e,t);return this.delta(n).multiplyScalar(s).add(this.start)}distanceSqToLine3(e,t=fw,n=pw){let s=10000000000000001e-32,r,o,a=this.start,l=e.start,c=this.end,h=e.end;Mo.subVectors(c,a),So.subVectors(h,l),Rf.subVectors(a,l);let u=Mo.dot(Mo),d=So.dot(So),f=So.dot(Rf);if(u<=s&&d<=s)return t.copy(a),n.copy(l),t.distanceToSquared(n);if(u<=s)r=0,o=f/d,o=mt(o,0,1);else{let p=Mo.dot(Rf);if(d<=s)o=0,r=mt(-p/u,0,1);else{let v=Mo.dot(So),g=u*d-v*v;g!==0?r=mt((v*f-p*d)/g,0,1):r=0,o=(v*r+f)/d,o<0?(o=0,r=mt(-p/u,0,1)):o>1&&(o=1,r=mt((v-p)/u,0,1))}}return t.copy(a).addScaledVector(Mo,r),n.copy(l).addScaledVector(So,o),t.distanceToSquared(n)}applyMatrix4(e){return this.start.applyMatrix4(e),this.end.applyMatrix4(e),this}equals(e){return e.start.equals(this.start)&&e.end.equals(this.end)}clone(){return new this.constructor().copy(this)}};var yl=class extends Ji{constructor(e,t=null){super(),this.object=e,this.domElement=t,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(e){this.domElement!==null&&this.disconnect(),this.domElement=e}disconnect(){}dispose(){}update(){}};function bp(i,e,t,n){let s=mw(n);switch(t){case op:return i*e;case Rh:return i*e/s.components*s.byteLength;case _l:return i*e/s.components*s.byteLength;case xr:return i*e*2/s.components*s.byteLength;case Ch:return i*e*2/s.components*s.byteLength;case ap:return i*e*3/s.components*s.byteLength;case Ti:return i*e*4/s.components*s.byteLength;case Ph:return i*e*4/s.components*s.byteLength;case bl:case El:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*8;case wl:case Ml:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case Lh:case Dh:return Math.max(i,16)*Math.max(e,8)/4;case Ih:case Nh:return Math.max(i,8)*Math.max(e,8)/2;case Fh:case Oh:case kh:case Bh:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*8;case Uh:case Sl:case Hh:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case zh:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case Vh:return Math.floor((i+4)/5)*Math.floor((e+3)/4)*16;case Gh:return Math.floor((i+4)/5)*Math.floor((e+4)/5)*16;case Wh:return Math.floor((i+5)/6)*Math.floor((e+4)/5)*16;case Xh:return Math.floor((i+5)/6)*Math.floor((e+5)/6)*16;case qh:return Math.floor((i+7)/8)*Math.floor((e+4)/5)*16;case Yh:return Math.floor((i+7)/8)*Math.floor((e+5)/6)*16;case $h:return Math.floor((i+7)/8)*Math.floor((e+7)/8)*16;case jh:return Math.floor((i+9)/10)*Math.floor((e+4)/5)*16;case Zh:return Math.floor((i+9)/10)*Math.floor((e+5)/6)*16;case Jh:return Math.floor((i+9)/10)*Math.floor((e+7)/8)*16;case Kh:return Math.floor((i+9)/10)*Math.floor((e+9)/10)*16;case Qh:return Math.floor((i+11)/12)*Math.floor((e+9)/10)*16;case eu:return Math.floor((i+11)/12)*Math.floor((e+11)/12)*16;case tu:case nu:case iu:return Math.ceil(i/4)*Math.ceil(e/4)*16;case su:case ru:return Math.ceil(i/4)*Math.ceil(e/4)*8;case Tl:case ou:return Math.ceil(i/4)*Math.ceil(e/4)*16}throw new Error(`Unable to determine texture byte length for ${t} format.`)}function mw(i){switch(i){case yi:case np:return{byteLength:1,components:1};case Wo:case ip:case Qi:return{byteLength:2,components:1};case Th:case Ah:return{byteLength:2,components:4};case zi:case Sh:case pi:return{byteLength:4,components:1};case sp:case rp:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${i}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?it("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function wy(){let i=null,e=!1,t=null,n=null;function s(r,o){n=i.requestAnimationFrame(s),t(r,o)}return{start:function(){e!==!0&&t!==null&&i!==null&&(n=i.requestAnimationFrame(s),e=!0)},stop:function(){i!==null&&i.cancelAnimationFrame(n),e=!1},setAnimationLoop:function(r){t=r},setContext:function(r){i=r}}}function _w(i){let e=new WeakMap;function t(a,l){let c=a.array,h=a.usage,u=c.byteLength,d=i.createBuffer();i.bindBuffer(l,d),i.bufferData(l,c,h),a.onUploadCallback();let f;if(c instanceof Float32Array)f=i.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)f=i.HALF_FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?f=i.HALF_FLOAT:f=i.UNSIGNED_SHORT;else if(c instanceof Int16Array)f=i.SHORT;else if(c instanceof Uint32Array)f=i.UNSIGNED_INT;else if(c instanceof Int32Array)f=i.INT;else if(c instanceof Int8Array)f=i.BYTE;else if(c instanceof Uint8Array)f=i.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)f=i.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:d,type:f,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:u}}function n(a,l,c){let h=l.array,u=l.updateRanges;if(i.bindBuffer(c,a),u.length===0)i.bufferSubData(c,0,h);else{u.sort((f,p)=>f.start-p.start);let d=0;for(let f=1;f<u.length;f++){let p=u[d],v=u[f];v.start<=p.start+p.count+1?p.count=Math.max(p.count,v.start+v.count-p.start):(++d,u[d]=v)}u.length=d+1;for(let f=0,p=u.length;f<p;f++){let v=u[f];i.bufferSubData(c,v.start*h.BYTES_PER_ELEMENT,h,v.start,v.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),e.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=e.get(a);l&&(i.deleteBuffer(l.buffer),e.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let h=e.get(a);(!h||h.version<a.version)&&e.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let c=e.get(a);if(c===void 0)e.set(a,t(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(c.buffer,a,l),c.version=a.version}}return{get:s,remove:r,update:o}}var bw=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,Ew=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,ww=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,Mw=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,Sw=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,Tw=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,Aw=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,Rw=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,Cw=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,Pw=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,Iw=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,Lw=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,Nw=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,Dw=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,Fw=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,Ow=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,Uw=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,kw=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,Bw=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,Hw=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,zw=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,Vw=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,Gw=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,Ww=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,Xw=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,qw=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,Yw=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,$w=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,jw=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,Zw="gl_FragColor = linearToOutputTexel( gl_FragColor );",Jw=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,Kw=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,Qw=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,eM=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,tM=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,nM=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,iM=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,sM=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,rM=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,oM=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,aM=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,lM=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,cM=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,hM=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,uM=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,dM=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,fM=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,pM=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,mM=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,gM=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,yM=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,vM=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,xM=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,_M=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,bM=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,EM=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,wM=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,MM=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,SM=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,TM=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,AM=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,RM=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,CM=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,PM=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,IM=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,LM=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,NM=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,DM=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,FM=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,OM=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,UM=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,kM=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,BM=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,HM=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,zM=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,VM=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,GM=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,WM=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,XM=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,qM=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,YM=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,$M=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,jM=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,ZM=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,JM=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,KM=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,QM=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,eS=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,tS=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,nS=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,iS=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,sS=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,rS=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,oS=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,aS=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,lS=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,cS=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,hS=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,uS=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,dS=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,fS=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,pS=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,mS=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,gS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,yS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,vS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,xS=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,_S=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,bS=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,ES=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,wS=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,MS=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,SS=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,TS=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,AS=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,RS=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,CS=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,PS=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,IS=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,LS=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,NS=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,DS=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,FS=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,OS=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,US=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,kS=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,BS=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,HS=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,zS=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,VS=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,GS=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,WS=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,XS=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,qS=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,YS=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,$S=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,jS=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,ZS=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,JS=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,KS=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,QS=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,Mt={alphahash_fragment:bw,alphahash_pars_fragment:Ew,alphamap_fragment:ww,alphamap_pars_fragment:Mw,alphatest_fragment:Sw,alphatest_pars_fragment:Tw,aomap_fragment:Aw,aomap_pars_fragment:Rw,batching_pars_vertex:Cw,batching_vertex:Pw,begin_vertex:Iw,beginnormal_vertex:Lw,bsdfs:Nw,iridescence_fragment:Dw,bumpmap_pars_fragment:Fw,clipping_planes_fragment:Ow,clipping_planes_pars_fragment:Uw,clipping_planes_pars_vertex:kw,clipping_planes_vertex:Bw,color_fragment:Hw,color_pars_fragment:zw,color_pars_vertex:Vw,color_vertex:Gw,common:Ww,defaultnormal_vertex:Xw,displacementmap_pars_vertex:qw,displacementmap_vertex:Yw,emissivemap_fragment:$w,emissivemap_pars_fragment:jw,colorspace_fragment:Zw,colorspace_pars_fragment:Jw,envmap_fragment:Kw,envmap_common_pars_fragment:Qw,envmap_pars_fragment:eM,envmap_pars_vertex:tM,envmap_physical_pars_fragment:dM,envmap_vertex:nM,fog_vertex:iM,fog_pars_vertex:sM,fog_fragment:rM,fog_pars_fragment:oM,gradientmap_pars_fragment:aM,lightmap_pars_fragment:lM,lights_lambert_fragment:cM,lights_lambert_pars_fragment:hM,lights_pars_begin:uM,lights_toon_fragment:fM,lights_toon_pars_fragment:pM,lights_phong_fragment:mM,lights_phong_pars_fragment:gM,lights_physical_fragment:yM,lights_physical_pars_fragment:vM,lights_fragment_begin:xM,lights_fragment_maps:_M,lights_fragment_end:bM,lightprobes_pars_fragment:EM,logdepthbuf_fragment:wM,logdepthbuf_pars_fragment:MM,logdepthbuf_pars_vertex:SM,logdepthbuf_vertex:TM,map_fragment:AM,map_pars_fragment:RM,map_particle_fragment:CM,map_particle_pars_fragment:PM,metalnessmap_fragment:IM,metalnessmap_pars_fragment:LM,morphinstance_vertex:NM,morphcolor_vertex:DM,morphnormal_vertex:FM,morphtarget_pars_vertex:OM,morphtarget_vertex:UM,normal_fragment_begin:kM,normal_fragment_maps:BM,normal_pars_fragment:HM,normal_pars_vertex:zM,normal_vertex:VM,normalmap_pars_fragment:GM,clearcoat_normal_fragment_begin:WM,clearcoat_normal_fragment_maps:XM,clearcoat_pars_fragment:qM,iridescence_pars_fragment:YM,opaque_fragment:$M,packing:jM,premultiplied_alpha_fragment:ZM,project_vertex:JM,dithering_fragment:KM,dithering_pars_fragment:QM,roughnessmap_fragment:eS,roughnessmap_pars_fragment:tS,shadowmap_pars_fragment:nS,shadowmap_pars_vertex:iS,shadowmap_vertex:sS,shadowmask_pars_fragment:rS,skinbase_vertex:oS,skinning_pars_vertex:aS,skinning_vertex:lS,skinnormal_vertex:cS,specularmap_fragment:hS,specularmap_pars_fragment:uS,tonemapping_fragment:dS,tonemapping_pars_fragment:fS,transmission_fragment:pS,transmission_pars_fragment:mS,uv_pars_fragment:gS,uv_pars_vertex:yS,uv_vertex:vS,worldpos_vertex:xS,background_vert:_S,background_frag:bS,backgroundCube_vert:ES,backgroundCube_frag:wS,cube_vert:MS,cube_frag:SS,depth_vert:TS,depth_frag:AS,distance_vert:RS,distance_frag:CS,equirect_vert:PS,equirect_frag:IS,linedashed_vert:LS,linedashed_frag:NS,meshbasic_vert:DS,meshbasic_frag:FS,meshlambert_vert:OS,meshlambert_frag:US,meshmatcap_vert:kS,meshmatcap_frag:BS,meshnormal_vert:HS,meshnormal_frag:zS,meshphong_vert:VS,meshphong_frag:GS,meshphysical_vert:WS,meshphysical_frag:XS,meshtoon_vert:qS,meshtoon_frag:YS,points_vert:$S,points_frag:jS,shadow_vert:ZS,shadow_frag:JS,sprite_vert:KS,sprite_frag:QS},Fe={common:{diffuse:{value:new et(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new yt},alphaMap:{value:null},alphaMapTransform:{value:new yt},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new yt}},envmap:{envMap:{value:null},envMapRotation:{value:new yt},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new yt}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new yt}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new yt},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new yt},normalScale:{value:new ue(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new yt},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new yt}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new yt}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new yt}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new et(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new et(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new yt},alphaTest:{value:0},uvTransform:{value:new yt}},sprite:{diffuse:{value:new et(16777215)},opacity:{value:1},center:{value:new ue(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new yt},alphaMap:{value:null},alphaMapTransform:{value:new yt},alphaTest:{value:0}}},hi={basic:{uniforms:Jn([Fe.common,Fe.specularmap,Fe.envmap,Fe.aomap,Fe.lightmap,Fe.fog]),vertexShader:Mt.meshbasic_vert,fragmentShader:Mt.meshbasic_frag},lambert:{uniforms:Jn([Fe.common,Fe.specularmap,Fe.envmap,Fe.aomap,Fe.lightmap,Fe.emissivemap,Fe.bumpmap,Fe.normalmap,Fe.displacementmap,Fe.fog,Fe.lights,{emissive:{value:new et(0)},envMapIntensity:{value:1}}]),vertexShader:Mt.meshlambert_vert,fragmentShader:Mt.meshlambert_frag},phong:{uniforms:Jn([Fe.common,Fe.specularmap,Fe.envmap,Fe.aomap,Fe.lightmap,Fe.emissivemap,Fe.bumpmap,Fe.normalmap,Fe.displacementmap,Fe.fog,Fe.lights,{emissive:{value:new et(0)},specular:{value:new et(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:Mt.meshphong_vert,fragmentShader:Mt.meshphong_frag},standard:{uniforms:Jn([Fe.common,Fe.envmap,Fe.aomap,Fe.lightmap,Fe.emissivemap,Fe.bumpmap,Fe.normalmap,Fe.displacementmap,Fe.roughnessmap,Fe.metalnessmap,Fe.fog,Fe.lights,{emissive:{value:new et(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:Mt.meshphysical_vert,fragmentShader:Mt.meshphysical_frag},toon:{uniforms:Jn([Fe.common,Fe.aomap,Fe.lightmap,Fe.emissivemap,Fe.bumpmap,Fe.normalmap,Fe.displacementmap,Fe.gradientmap,Fe.fog,Fe.lights,{emissive:{value:new et(0)}}]),vertexShader:Mt.meshtoon_vert,fragmentShader:Mt.meshtoon_frag},matcap:{uniforms:Jn([Fe.common,Fe.bumpmap,Fe.normalmap,Fe.displacementmap,Fe.fog,{matcap:{value:null}}]),vertexShader:Mt.meshmatcap_vert,fragmentShader:Mt.meshmatcap_frag},points:{uniforms:Jn([Fe.points,Fe.fog]),vertexShader:Mt.points_vert,fragmentShader:Mt.points_frag},dashed:{uniforms:Jn([Fe.common,Fe.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:Mt.linedashed_vert,fragmentShader:Mt.linedashed_frag},depth:{uniforms:Jn([Fe.common,Fe.displacementmap]),vertexShader:Mt.depth_vert,fragmentShader:Mt.depth_frag},normal:{uniforms:Jn([Fe.common,Fe.bumpmap,Fe.normalmap,Fe.displacementmap,{opacity:{value:1}}]),vertexShader:Mt.meshnormal_vert,fragmentShader:Mt.meshnormal_frag},sprite:{uniforms:Jn([Fe.sprite,Fe.fog]),vertexShader:Mt.sprite_vert,fragmentShader:Mt.sprite_frag},background:{uniforms:{uvTransform:{value:new yt},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:Mt.background_vert,fragmentShader:Mt.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new yt}},vertexShader:Mt.backgroundCube_vert,fragmentShader:Mt.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:Mt.cube_vert,fragmentShader:Mt.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:Mt.equirect_vert,fragmentShader:Mt.equirect_frag},distance:{uniforms:Jn([Fe.common,Fe.displacementmap,{referencePosition:{value:new S},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:Mt.distance_vert,fragmentShader:Mt.distance_frag},shadow:{uniforms:Jn([Fe.lights,Fe.fog,{color:{value:new et(0)},opacity:{value:1}}]),vertexShader:Mt.shadow_vert,fragmentShader:Mt.shadow_frag}};hi.physical={uniforms:Jn([hi.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new yt},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new yt},clearcoatNormalScale:{value:new ue(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new yt},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new yt},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new yt},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new yt},sheen:{value:0},sheenColor:{value:new et(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new yt},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new yt},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new yt},transmissionSamplerSize:{value:new ue},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new yt},attenuationDistance:{value:0},attenuationColor:{value:new et(0)},specularColor:{value:new et(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new yt},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new yt},anisotropyVector:{value:new ue},anisotropyMap:{value:null},anisotropyMapTransform:{value:new yt}}]),vertexShader:Mt.meshphysical_vert,fragmentShader:Mt.meshphysical_frag};var lu={r:0,b:0,g:0},eT=new Qe,My=new yt;My.set(-1,0,0,0,1,0,0,0,1);function tT(i,e,t,n,s,r){let o=new et(0),a=s===!0?0:1,l,c,h=null,u=0,d=null;function f(y){let b=y.isScene===!0?y.background:null;if(b&&b.isTexture){let x=y.backgroundBlurriness>0;b=e.get(b,x)}return b}function p(y){let b=!1,x=f(y);x===null?g(o,a):x&&x.isColor&&(g(x,1),b=!0);let T=i.xr.getEnvironmentBlendMode();T==="additive"?t.buffers.color.setClear(0,0,0,1,r):T==="alpha-blend"&&t.buffers.color.setClear(0,0,0,0,r),(i.autoClear||b)&&(t.buffers.depth.setTest(!0),t.buffers.depth.setMask(!0),t.buffers.color.setMask(!0),i.clear(i.autoClearColor,i.autoClearDepth,i.autoClearStencil))}function v(y,b){let x=f(b);x&&x.isCubeTexture?(c===void 0&&(c=new wt(new pn(1,1,1),new Bi({name:"BackgroundCubeMaterial",uniforms:Hr(hi.backgroundCube.uniforms),vertexShader:hi.backgroundCube.vertexShader,fragmentShader:hi.backgroundCube.fragmentShader,side:li,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(T,M,_){this.matrixWorld.copyPosition(_.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),n.update(c)),c.material.uniforms.envMap.value=x,c.material.uniforms.backgroundBlurriness.value=b.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=b.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(eT.makeRotationFromEuler(b.backgroundRotation)).transpose(),x.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(My),c.material.toneMapped=Ct.getTransfer(x.colorSpace)!==Vt,(h!==x||u!==x.version||d!==i.toneMapping)&&(c.material.needsUpdate=!0,h=x,u=x.version,d=i.toneMapping),c.layers.enableAll(),y.unshift(c,c.geometry,c.material,0,0,null)):x&&x.isTexture&&(l===void 0&&(l=new wt(new Vs(2,2),new Bi({name:"BackgroundMaterial",uniforms:Hr(hi.background.uniforms),vertexShader:hi.background.vertexShader,fragmentShader:hi.background.fragmentShader,side:vr,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),n.update(l)),l.material.uniforms.t2D.value=x,l.material.uniforms.backgroundIntensity.value=b.backgroundIntensity,l.material.toneMapped=Ct.getTransfer(x.colorSpace)!==Vt,x.matrixAutoUpdate===!0&&x.updateMatrix(),l.material.uniforms.uvTransform.value.copy(x.matrix),(h!==x||u!==x.version||d!==i.toneMapping)&&(l.material.needsUpdate=!0,h=x,u=x.version,d=i.toneMapping),l.layers.enableAll(),y.unshift(l,l.geometry,l.material,0,0,null))}function g(y,b){y.getRGB(lu,vp(i)),t.buffers.color.setClear(lu.r,lu.g,lu.b,b,r)}function m(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return o},setClearColor:function(y,b=1){o.set(y),a=b,g(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(y){a=y,g(o,a)},render:p,addToRenderList:v,dispose:m}}function nT(i,e){let t=i.getParameter(i.MAX_VERTEX_ATTRIBS),n={},s=d(null),r=s,o=!1;function a(I,U,H,L,k){let q=!1,V=u(I,L,H,U);r!==V&&(r=V,c(r.object)),q=f(I,L,H,k),q&&p(I,L,H,k),k!==null&&e.update(k,i.ELEMENT_ARRAY_BUFFER),(q||o)&&(o=!1,x(I,U,H,L),k!==null&&i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,e.get(k).buffer))}function l(){return i.createVertexArray()}function c(I){return i.bindVertexArray(I)}function h(I){return i.deleteVertexArray(I)}function u(I,U,H,L){let k=L.wireframe===!0,q=n[U.id];q===void 0&&(q={},n[U.id]=q);let V=I.isInstancedMesh===!0?I.id:0,ce=q[V];ce===void 0&&(ce={},q[V]=ce);let Z=ce[H.id];Z===void 0&&(Z={},ce[H.id]=Z);let Q=Z[k];return Q===void 0&&(Q=d(l()),Z[k]=Q),Q}function d(I){let U=[],H=[],L=[];for(let k=0;k<t;k++)U[k]=0,H[k]=0,L[k]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:U,enabledAttributes:H,attributeDivisors:L,object:I,attributes:{},index:null}}function f(I,U,H,L){let k=r.attributes,q=U.attributes,V=0,ce=H.getAttributes();for(let Z in ce)if(ce[Z].location>=0){let te=k[Z],pe=q[Z];if(pe===void 0&&(Z==="instanceMatrix"&&I.instanceMatrix&&(pe=I.instanceMatrix),Z==="instanceColor"&&I.instanceColor&&(pe=I.instanceColor)),te===void 0||te.attribute!==pe||pe&&te.data!==pe.data)return!0;V++}return r.attributesNum!==V||r.index!==L}function p(I,U,H,L){let k={},q=U.attributes,V=0,ce=H.getAttributes();for(let Z in ce)if(ce[Z].location>=0){let te=q[Z];te===void 0&&(Z==="instanceMatrix"&&I.instanceMatrix&&(te=I.instanceMatrix),Z==="instanceColor"&&I.instanceColor&&(te=I.instanceColor));let pe={};pe.attribute=te,te&&te.data&&(pe.data=te.data),k[Z]=pe,V++}r.attributes=k,r.attributesNum=V,r.index=L}function v(){let I=r.newAttributes;for(let U=0,H=I.length;U<H;U++)I[U]=0}function g(I){m(I,0)}function m(I,U){let H=r.newAttributes,L=r.enabledAttributes,k=r.attributeDivisors;H[I]=1,L[I]===0&&(i.enableVertexAttribArray(I),L[I]=1),k[I]!==U&&(i.vertexAttribDivisor(I,U),k[I]=U)}function y(){let I=r.newAttributes,U=r.enabledAttributes;for(let H=0,L=U.length;H<L;H++)U[H]!==I[H]&&(i.disableVertexAttribArray(H),U[H]=0)}function b(I,U,H,L,k,q,V){V===!0?i.vertexAttribIPointer(I,U,H,k,q):i.vertexAttribPointer(I,U,H,L,k,q)}function x(I,U,H,L){v();let k=L.attributes,q=H.getAttributes(),V=U.defaultAttributeValues;for(let ce in q){let Z=q[ce];if(Z.location>=0){let Q=k[ce];if(Q===void 0&&(ce==="instanceMatrix"&&I.instanceMatrix&&(Q=I.instanceMatrix),ce==="instanceColor"&&I.instanceColor&&(Q=I.instanceColor)),Q!==void 0){let te=Q.normalized,pe=Q.itemSize,he=e.get(Q);if(he===void 0)continue;let ee=he.buffer,ye=he.type,xe=he.bytesPerElement,Le=ye===i.INT||ye===i.UNSIGNED_INT||Q.gpuType===Sh;if(Q.isInterleavedBufferAttribute){let Me=Q.data,Ve=Me.isInterleavedBuffer===!0?Me.stride:Me.itemSize,at=Q.offset;if(Me.isInstancedInterleavedBuffer||Me.isInstancedBufferAttribute){for(let Ze=0;Ze<Z.locationSize;Ze++)m(Z.location+Ze,Me.meshPerAttribute);I.isInstancedMesh!==!0&&L._maxInstanceCount===void 0&&(L._maxInstanceCount=Me.meshPerAttribute*Me.count)}else for(let Ze=0;Ze<Z.locationSize;Ze++)g(Z.location+Ze);i.bindBuffer(i.ARRAY_BUFFER,ee);for(let Ze=0;Ze<Z.locationSize;Ze++)b(Z.location+Ze,pe/Z.locationSize,ye,te,Ve*xe,(at+pe/Z.locationSize*Ze)*xe,Le)}else{if(Q.isInstancedBufferAttribute){for(let Me=0;Me<Z.locationSize;Me++)m(Z.location+Me,Q.meshPerAttribute);I.isInstancedMesh!==!0&&L._maxInstanceCount===void 0&&(L._maxInstanceCount=Q.meshPerAttribute*Q.count)}else for(let Me=0;Me<Z.locationSize;Me++)g(Z.location+Me);i.bindBuffer(i.ARRAY_BUFFER,ee);for(let Me=0;Me<Z.locationSize;Me++)b(Z.location+Me,pe/Z.locationSize,ye,te,pe*xe,pe/Z.locationSize*Me*xe,Le)}}else if(V!==void 0){let te=V[ce];if(te!==void 0)switch(te.length){case 2:i.vertexAttrib2fv(Z.location,te);break;case 3:i.vertexAttrib3fv(Z.location,te);break;case 4:i.vertexAttrib4fv(Z.location,te);break;default:i.vertexAttrib1fv(Z.location,te)}}}}y()}function T(){N();for(let I in n){let U=n[I];for(let H in U){let L=U[H];for(let k in L){let q=L[k];for(let V in q)h(q[V].object),delete q[V];delete L[k]}}delete n[I]}}function M(I){if(n[I.id]===void 0)return;let U=n[I.id];for(let H in U){let L=U[H];for(let k in L){let q=L[k];for(let V in q)h(q[V].object),delete q[V];delete L[k]}}delete n[I.id]}function _(I){for(let U in n){let H=n[U];for(let L in H){let k=H[L];if(k[I.id]===void 0)continue;let q=k[I.id];for(let V in q)h(q[V].object),delete q[V];delete k[I.id]}}}function w(I){for(let U in n){let H=n[U],L=I.isInstancedMesh===!0?I.id:0,k=H[L];if(k!==void 0){for(let q in k){let V=k[q];for(let ce in V)h(V[ce].object),delete V[ce];delete k[q]}delete H[L],Object.keys(H).length===0&&delete n[U]}}}function N(){P(),o=!0,r!==s&&(r=s,c(r.object))}function P(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:N,resetDefaultState:P,dispose:T,releaseStatesOfGeometry:M,releaseStatesOfObject:w,releaseStatesOfProgram:_,initAttributes:v,enableAttribute:g,disableUnusedAttributes:y}}function iT(i,e,t){let n;function s(l){n=l}function r(l,c){i.drawArrays(n,l,c),t.update(c,n,1)}function o(l,c,h){h!==0&&(i.drawArraysInstanced(n,l,c,h),t.update(c,n,h))}function a(l,c,h){if(h===0)return;e.get("WEBGL_multi_draw").multiDrawArraysWEBGL(n,l,0,c,0,h);let d=0;for(let f=0;f<h;f++)d+=c[f];t.update(d,n,1)}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function sT(i,e,t,n){let s;function r(){if(s!==void 0)return s;if(e.has("EXT_texture_filter_anisotropic")===!0){let _=e.get("EXT_texture_filter_anisotropic");s=i.getParameter(_.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(_){return!(_!==Ti&&n.convert(_)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(_){let w=_===Qi&&(e.has("EXT_color_buffer_half_float")||e.has("EXT_color_buffer_float"));return!(_!==yi&&_!==pi&&!w&&n.convert(_)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_TYPE))}function l(_){if(_==="highp"){if(i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.HIGH_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.HIGH_FLOAT).precision>0)return"highp";_="mediump"}return _==="mediump"&&i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.MEDIUM_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=t.precision!==void 0?t.precision:"highp",h=l(c);h!==c&&(it("WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);let u=t.reversedDepthBuffer===!0&&e.has("EXT_clip_control"),d=t.logarithmicDepthBuffer===!0&&u===!1;t.reversedDepthBuffer===!0&&u===!1&&it("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),t.logarithmicDepthBuffer===!0&&u===!0&&it("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let f=i.getParameter(i.MAX_TEXTURE_IMAGE_UNITS),p=i.getParameter(i.MAX_VERTEX_TEXTURE_IMAGE_UNITS),v=i.getParameter(i.MAX_TEXTURE_SIZE),g=i.getParameter(i.MAX_CUBE_MAP_TEXTURE_SIZE),m=i.getParameter(i.MAX_VERTEX_ATTRIBS),y=i.getParameter(i.MAX_VERTEX_UNIFORM_VECTORS),b=i.getParameter(i.MAX_VARYING_VECTORS),x=i.getParameter(i.MAX_FRAGMENT_UNIFORM_VECTORS),T=i.getParameter(i.MAX_SAMPLES),M=i.getParameter(i.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:d,reversedDepthBuffer:u,maxTextures:f,maxVertexTextures:p,maxTextureSize:v,maxCubemapSize:g,maxAttributes:m,maxVertexUniforms:y,maxVaryings:b,maxFragmentUniforms:x,maxSamples:T,samples:M}}function rT(i){let e=this,t=null,n=0,s=!1,r=!1,o=new si,a=new yt,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,d){let f=u.length!==0||d||n!==0||s;return s=d,n=u.length,f},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,d){t=h(u,d,0)},this.setState=function(u,d,f){let p=u.clippingPlanes,v=u.clipIntersection,g=u.clipShadows,m=i.get(u);if(!s||p===null||p.length===0||r&&!g)r?h(null):c();else{let y=r?0:n,b=y*4,x=m.clippingState||null;l.value=x,x=h(p,d,b,f);for(let T=0;T!==b;++T)x[T]=t[T];m.clippingState=x,this.numIntersection=v?this.numPlanes:0,this.numPlanes+=y}};function c(){l.value!==t&&(l.value=t,l.needsUpdate=n>0),e.numPlanes=n,e.numIntersection=0}function h(u,d,f,p){let v=u!==null?u.length:0,g=null;if(v!==0){if(g=l.value,p!==!0||g===null){let m=f+v*4,y=d.matrixWorldInverse;a.getNormalMatrix(y),(g===null||g.length<m)&&(g=new Float32Array(m));for(let b=0,x=f;b!==v;++b,x+=4)o.copy(u[b]).applyMatrix4(y,a),o.normal.toArray(g,x),g[x+3]=o.constant}l.value=g,l.needsUpdate=!0}return e.numPlanes=v,e.numIntersection=0,g}}var Il=class extends Ai{constructor(e=1,t={}){super(e,e,t),this.isWebGLCubeRenderTarget=!0;let n={width:e,height:e,depth:1},s=[n,n,n,n,n,n];this.texture=new Wa(s),this._setTextureOptions(t),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(e,t){this.texture.type=t.type,this.texture.colorSpace=t.colorSpace,this.texture.generateMipmaps=t.generateMipmaps,this.texture.minFilter=t.minFilter,this.texture.magFilter=t.magFilter;let n={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new pn(5,5,5),r=new Bi({name:"CubemapFromEquirect",uniforms:Hr(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:li,blending:Or});r.uniforms.tEquirect.value=t;let o=new wt(s,r),a=t.minFilter;return t.minFilter===Xs&&(t.minFilter=oi),new Bo(1,10,this).update(e,o),t.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(e,t=!0,n=!0,s=!0){let r=e.getRenderTarget();for(let o=0;o<6;o++)e.setRenderTarget(this,o),e.clear(t,n,s);e.setRenderTarget(r)}},ny=256,oT=3,aT=20,Sy=256,Ty=16,lT=3,cT=new S,hT=new et,hu=class i{constructor(e){this._renderer=e,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new Bo(1,10,null),this._boxMesh=new wt(new pn(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(e,t=0,n=.1,s=100,r={}){let{size:o=256,position:a=cT}=r,l=this._renderer;this._setSize(o);let c=this._allocateTarget(),h=this._getSourceTarget(!0);t>0&&(h.texture.mipmapsAutoUpdate=!1);let u=l.autoClear,d=l.autoClearColor,f=l.autoClearDepth,p=l.autoClearStencil,v=e.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,v===null&&(e.background=l.getClearColor(hT));let g=new Bo(n,s,h);return g.position.copy(a),g.update(l,e),l.autoClear=u,l.autoClearColor=d,l.autoClearDepth=f,l.autoClearStencil=p,e.background=v,t>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(c,t)),this._applyPMREM(c),c}fromEquirectangular(e,t=null){return this._fromTexture(e,t)}fromCubemap(e,t=null){return this._fromTexture(e,t)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=ry(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=sy(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(e,t){return t>0?1-Math.sqrt(1-e/t):0}_setSize(e){this._cubeSize=Math.max(ny,pp(e))}_fromTexture(e,t){e.mapping===kr||e.mapping===Go?this._setSize(e.image.length===0?ny:e.image[0].width||e.image[0].image.width):this._setSize(e.image.width/4);let n=t||this._allocateTarget();return this._textureToCubemap(e),this._applyPMREM(n),n}_allocateTarget(){let e=this._cubeSize,t=iy(e,!1,!1),n=Math.log2(e)-oT;for(let s=0;s<=n;s++)t.texture.mipmaps.push({width:e>>s,height:e>>s});return t.texture.name="PMREM",t.texture.isPMREMTexture=!0,t}_getSourceTarget(e=!1){let t=this._cubeSize,n=this._sourceTarget;return(n===null||n.width!==t||e&&n.depthBuffer===!1)&&(n!==null&&n.dispose(),this._sourceTarget=iy(t,!0,e)),this._sourceTarget}_compileMaterial(e){this._boxMesh.material=e,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(e,t,n){let s=this._boxMesh,r=this._cubeCamera;s.material=n,r.renderTarget=e,r.activeMipmapLevel=t;let o=e.width>>t;e.viewport.set(0,0,o,o),r.update(this._renderer,s),e.viewport.set(0,0,e.width,e.height)}_textureToCubemap(e){let t;e.mapping===kr||e.mapping===Go?(this._cubemapMaterial===null&&(this._cubemapMaterial=ry()),t=this._cubemapMaterial,t.uniforms.flipEnvMap.value=e.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=sy()),t=this._equirectMaterial),t.uniforms.envMap.value=e,this._renderCube(this._getSourceTarget(),0,t)}_applyPMREM(e){this._ggxMaterial===null&&(this._ggxMaterial=uT(),this._integrationMaterial=dT());let t=this._cubeSize,n=e.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(t/Ty);for(let o=0;o<=n;o++){let a=i.lodToRoughness(o,n);if(o>n-lT)r.roughness.value=a,this._renderCube(e,o,this._integrationMaterial);else{let l=a>0?Math.log2(t)+.5*Math.log2(6/(Sy*Math.pow(a,4)))+.5:0;s.roughness.value=a,s.lodBias.value=l,this._renderCube(e,o,this._ggxMaterial)}}}_blur(e,t){this._blurMaterial===null&&(this._blurMaterial=fT());let n=this._blurMaterial,s=n.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(t,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(e,0,n),s.envMap.value=e.texture,this._renderCube(r,0,n)}};function iy(i,e,t){return new Il(i,{minFilter:Xs,generateMipmaps:e,type:Qi,colorSpace:Na,depthBuffer:t})}function Ll(i,e,t){return new Bi({name:i,uniforms:e,vertexShader:Mt.cube_vert,fragmentShader:t,side:li,blending:Or,depthTest:!1,depthWrite:!1})}function uT(){return Ll("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${Sy}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function dT(){return Ll("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:Ty}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function fT(){return Ll("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${aT}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function sy(){return Ll("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function ry(){return Ll("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function pT(i){let e=new WeakMap,t=new WeakMap,n=null;function s(d,f=!1){return d==null?null:f?o(d):r(d)}function r(d){if(d&&d.isTexture){let f=d.mapping;if(f===Eh||f===wh)if(e.has(d)){let p=e.get(d).texture;return a(p,d.mapping)}else{let p=d.image;if(p&&p.height>0){let v=new Il(p.height);return v.fromEquirectangularTexture(i,d),e.set(d,v),d.addEventListener("dispose",c),a(v.texture,d.mapping)}else return null}}return d}function o(d){if(d&&d.isTexture&&d.isPMREMTexture!==!0){let f=d.mapping,p=f===Eh||f===wh,v=f===kr||f===Go;if(p||v){let g=t.get(d),m=g!==void 0?g.texture.pmremVersion:0;if(d.isRenderTargetTexture&&d.pmremVersion!==m)return n===null&&(n=new hu(i)),g=p?n.fromEquirectangular(d,g):n.fromCubemap(d,g),g.texture.pmremVersion=d.pmremVersion,t.set(d,g),g.texture;if(g!==void 0)return g.texture;{let y=d.image;return p&&y&&y.height>0||v&&y&&l(y)?(n===null&&(n=new hu(i)),g=p?n.fromEquirectangular(d):n.fromCubemap(d),g.texture.pmremVersion=d.pmremVersion,t.set(d,g),d.addEventListener("dispose",h),g.texture):null}}}return d}function a(d,f){return f===Eh?d.mapping=kr:f===wh&&(d.mapping=Go),d}function l(d){let f=0,p=6;for(let v=0;v<p;v++)d[v]!==void 0&&f++;return f===p}function c(d){let f=d.target;f.removeEventListener("dispose",c);let p=e.get(f);p!==void 0&&(e.delete(f),p.dispose())}function h(d){let f=d.target;f.removeEventListener("dispose",h);let p=t.get(f);p!==void 0&&(t.delete(f),p.dispose())}function u(){e=new WeakMap,t=new WeakMap,n!==null&&(n.dispose(),n=null)}return{get:s,dispose:u}}function mT(i){let e={};function t(n){if(e[n]!==void 0)return e[n];let s=i.getExtension(n);return e[n]=s,s}return{has:function(n){return t(n)!==null},init:function(){t("EXT_color_buffer_float"),t("WEBGL_clip_cull_distance"),t("OES_texture_float_linear"),t("EXT_color_buffer_half_float"),t("WEBGL_multisampled_render_to_texture"),t("WEBGL_render_shared_exponent")},get:function(n){let s=t(n);return s===null&&Ra("WebGLRenderer: "+n+" extension not supported."),s}}}function gT(i,e,t,n){let s={},r=new WeakMap,o=new FinalizationRegistry(p=>delete s[p]);function a(p){l(p.target)}function l(p){p.index!==null&&e.remove(p.index);for(let g in p.attributes)e.remove(p.attributes[g]);p.removeEventListener("dispose",a),delete s[p.id],o.unregister(p);let v=r.get(p);v&&(e.remove(v),r.delete(p)),n.releaseStatesOfGeometry(p),p.isInstancedBufferGeometry===!0&&delete p._maxInstanceCount,t.memory.geometries--}function c(p,v){return s[v.id]!==void 0||(v.addEventListener("dispose",a),s[v.id]=new WeakRef(v),o.register(v,v.id,v),t.memory.geometries++),v}function h(p){let v=p.attributes;for(let g in v)e.update(v[g],i.ARRAY_BUFFER)}function u(p){let v=p.index,g=p.attributes.position,m=0;if(g===void 0)return;let y=v!==null?v.array.length:g.array.length/3-1,b=g.count>=65535?Ha:Ba,x=new b(Math.ceil(y/3)*6,1),T=x.array;if(v!==null){let _=v.array;m=v.version;for(let w=0,N=0;w<y;w+=3){let P=_[w+0],I=_[w+1],U=_[w+2];T[N++]=P,T[N++]=I,T[N++]=I,T[N++]=U,T[N++]=U,T[N++]=P}}else{m=g.version;for(let _=0,w=0;_<y;_+=3){let N=_+0,P=_+1,I=_+2;T[w++]=N,T[w++]=P,T[w++]=P,T[w++]=I,T[w++]=I,T[w++]=N}}x.version=m;let M=r.get(p);M&&e.remove(M),r.set(p,x)}function d(p){let v=r.get(p);if(v){let g=p.index;g!==null&&v.version<g.version&&u(p)}else u(p);return r.get(p)}function f(){for(let p in s){let v=s[p].deref();v!==void 0&&l(v)}}return{get:c,update:h,getWireframeAttribute:d,dispose:f}}function yT(i,e,t){let n;function s(u){n=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function l(u,d){i.drawElements(n,d,r,u*o),t.update(d,n,1)}function c(u,d,f){f!==0&&(i.drawElementsInstanced(n,d,r,u*o,f),t.update(d,n,f))}function h(u,d,f){if(f===0)return;e.get("WEBGL_multi_draw").multiDrawElementsWEBGL(n,d,0,r,u,0,f);let v=0;for(let g=0;g<f;g++)v+=d[g];t.update(v,n,1)}this.setMode=s,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=h}function vT(i){let e={geometries:0,textures:0},t={frame:0,calls:0,triangles:0,points:0,lines:0};function n(r,o,a){switch(t.calls++,o){case i.TRIANGLES:t.triangles+=a*(r/3);break;case i.LINES:t.lines+=a*(r/2);break;case i.LINE_STRIP:t.lines+=a*(r-1);break;case i.LINE_LOOP:t.lines+=a*r;break;case i.POINTS:t.points+=a*r;break;default:ht("WebGLInfo: Unknown draw mode:",o);break}}function s(){t.calls=0,t.triangles=0,t.points=0,t.lines=0}return{memory:e,render:t,programs:null,autoReset:!0,reset:s,update:n}}function xT(i,e,t){let n=new WeakMap,s=new Gt;function r(o,a,l){let c=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=h!==void 0?h.length:0,d=n.get(a);if(d===void 0||d.count!==u){let N=function(){_.dispose(),n.delete(a),a.removeEventListener("dispose",N)};d!==void 0&&d.texture.dispose();let f=a.morphAttributes.position!==void 0,p=a.morphAttributes.normal!==void 0,v=a.morphAttributes.color!==void 0,g=a.morphAttributes.position||[],m=a.morphAttributes.normal||[],y=a.morphAttributes.color||[],b=0;f===!0&&(b=1),p===!0&&(b=2),v===!0&&(b=3);let x=a.attributes.position.count*b,T=1;x>e.maxTextureSize&&(T=Math.ceil(x/e.maxTextureSize),x=e.maxTextureSize);let M=new Float32Array(x*T*4*u),_=new Ua(M,x,T,u);_.type=pi,_.needsUpdate=!0;let w=b*4;for(let P=0;P<u;P++){let I=g[P],U=m[P],H=y[P],L=x*T*4*P;for(let k=0;k<I.count;k++){let q=k*w;f===!0&&(s.fromBufferAttribute(I,k),M[L+q+0]=s.x,M[L+q+1]=s.y,M[L+q+2]=s.z,M[L+q+3]=0),p===!0&&(s.fromBufferAttribute(U,k),M[L+q+4]=s.x,M[L+q+5]=s.y,M[L+q+6]=s.z,M[L+q+7]=0),v===!0&&(s.fromBufferAttribute(H,k),M[L+q+8]=s.x,M[L+q+9]=s.y,M[L+q+10]=s.z,M[L+q+11]=H.itemSize===4?s.w:1)}}d={count:u,texture:_,size:new ue(x,T)},n.set(a,d),a.addEventListener("dispose",N)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(i,"morphTexture",o.morphTexture,t);else{let f=0;for(let v=0;v<c.length;v++)f+=c[v];let p=a.morphTargetsRelative?1:1-f;l.getUniforms().setValue(i,"morphTargetBaseInfluence",p),l.getUniforms().setValue(i,"morphTargetInfluences",c)}l.getUniforms().setValue(i,"morphTargetsTexture",d.texture,t),l.getUniforms().setValue(i,"morphTargetsTextureSize",d.size)}return{update:r}}function _T(i,e,t,n,s){let r=new WeakMap;function o(c){let h=s.render.frame,u=c.geometry,d=e.get(c,u);if(r.get(d)!==h&&(e.update(d),r.set(d,h)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==h&&(t.update(c.instanceMatrix,i.ARRAY_BUFFER),c.instanceColor!==null&&t.update(c.instanceColor,i.ARRAY_BUFFER),r.set(c,h))),c.isSkinnedMesh){let f=c.skeleton;r.get(f)!==h&&(f.update(),r.set(f,h))}return d}function a(){r=new WeakMap}function l(c){let h=c.target;h.removeEventListener("dispose",l),n.releaseStatesOfObject(h),t.remove(h.instanceMatrix),h.instanceColor!==null&&t.remove(h.instanceColor)}return{update:o,dispose:a}}var bT={[$f]:"LINEAR_TONE_MAPPING",[jf]:"REINHARD_TONE_MAPPING",[Zf]:"CINEON_TONE_MAPPING",[Jf]:"ACES_FILMIC_TONE_MAPPING",[Qf]:"AGX_TONE_MAPPING",[ep]:"NEUTRAL_TONE_MAPPING",[Kf]:"CUSTOM_TONE_MAPPING"};function ET(i,e,t,n,s,r){let o=new Ai(e,t,{type:i,depthBuffer:s,stencilBuffer:r,samples:n?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,l=null,c=null,h=new St;h.setAttribute("position",new ot([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new ot([0,2,0,0,2,0],2));let u=new ah({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),d=new wt(h,u),f=new fl(-1,1,1,-1,0,1),p=null,v=null,g=!1,m,y=null,b=[],x=!1;this.setSize=function(T,M){o.setSize(T,M),a!==null&&a.setSize(T,M),l!==null&&l.setSize(T,M);for(let _=0;_<b.length;_++){let w=b[_];w.setSize&&w.setSize(T,M)}},this.setEffects=function(T){b=T,x=b.length>0&&b[0].isRenderPass===!0;let M=o.width,_=o.height;b.length>0&&a===null&&(a=new Ai(M,_,{type:Qi,depthBuffer:!1,stencilBuffer:!1}),l=new Ai(M,_,{type:Qi,depthBuffer:!1,stencilBuffer:!1}));let w=s===!0&&b.some(N=>N.needsDepthTexture===!0);w!==(o.depthTexture!==null)&&(w===!0&&c===null&&(c=new zs(M,_),r===!0&&(c.format=qs,c.type=Br)),o.dispose(),o.depthTexture=w?c:null,o.resolveDepthBuffer=w,o.storeMultisampledDepthBuffer=w);for(let N=0;N<b.length;N++){let P=b[N];P.setSize&&P.setSize(M,_),w&&P.needsDepthTexture===!0&&P.setDepthTexture&&P.setDepthTexture(c)}},this.begin=function(T,M){if(g||T.toneMapping===Hi&&b.length===0)return!1;if(y=M,M!==null){let _=M.width,w=M.height;(o.width!==_||o.height!==w)&&this.setSize(_,w)}return x===!1&&T.setRenderTarget(o),m=T.toneMapping,T.toneMapping=Hi,!0},this.hasRenderPass=function(){return x},this.end=function(T,M){T.toneMapping=m,g=!0;let _=o,w=a;for(let N=0;N<b.length;N++){let P=b[N];P.enabled!==!1&&(P.render(T,w,_,M),P.needsSwap!==!1&&(_=w,w=w===a?l:a))}if(p!==T.outputColorSpace||v!==T.toneMapping){p=T.outputColorSpace,v=T.toneMapping,u.defines={},Ct.getTransfer(p)===Vt&&(u.defines.SRGB_TRANSFER="");let N=bT[v];N&&(u.defines[N]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=_.texture,T.setRenderTarget(y),T.render(d,f),y=null,g=!1},this.isCompositing=function(){return g},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),l!==null&&l.dispose(),h.dispose(),u.dispose()}}var Ay=new mi,Ry=new zs(1,1),Cy=new Xa(1),Py=new Ua,Iy=new Kc,Ly=new Wa,oy=[],ay=[],ly=new Float32Array(16),cy=new Float32Array(9),hy=new Float32Array(4);function qo(i,e,t){let n=i[0];if(n<=0||n>0)return i;let s=e*t,r=oy[s];if(r===void 0&&(r=new Float32Array(s),oy[s]=r),e!==0){n.toArray(r,0);for(let o=1,a=0;o!==e;++o)a+=t,i[o].toArray(r,a)}return r}function Cn(i,e){if(i.length!==e.length)return!1;for(let t=0,n=i.length;t<n;t++)if(i[t]!==e[t])return!1;return!0}function Pn(i,e){for(let t=0,n=e.length;t<n;t++)i[t]=e[t]}function du(i,e){let t=ay[e];t===void 0&&(t=new Int32Array(e),ay[e]=t);for(let n=0;n!==e;++n)t[n]=i.allocateTextureUnit();return t}function wT(i,e){let t=this.cache;t[0]!==e&&(i.uniform1f(this.addr,e),t[0]=e)}function MT(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2f(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(Cn(t,e))return;i.uniform2fv(this.addr,e),Pn(t,e)}}function ST(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3f(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else if(e.r!==void 0)(t[0]!==e.r||t[1]!==e.g||t[2]!==e.b)&&(i.uniform3f(this.addr,e.r,e.g,e.b),t[0]=e.r,t[1]=e.g,t[2]=e.b);else{if(Cn(t,e))return;i.uniform3fv(this.addr,e),Pn(t,e)}}function TT(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4f(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(Cn(t,e))return;i.uniform4fv(this.addr,e),Pn(t,e)}}function AT(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(Cn(t,e))return;i.uniformMatrix2fv(this.addr,!1,e),Pn(t,e)}else{if(Cn(t,n))return;hy.set(n),i.uniformMatrix2fv(this.addr,!1,hy),Pn(t,n)}}function RT(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(Cn(t,e))return;i.uniformMatrix3fv(this.addr,!1,e),Pn(t,e)}else{if(Cn(t,n))return;cy.set(n),i.uniformMatrix3fv(this.addr,!1,cy),Pn(t,n)}}function CT(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(Cn(t,e))return;i.uniformMatrix4fv(this.addr,!1,e),Pn(t,e)}else{if(Cn(t,n))return;ly.set(n),i.uniformMatrix4fv(this.addr,!1,ly),Pn(t,n)}}function PT(i,e){let t=this.cache;t[0]!==e&&(i.uniform1i(this.addr,e),t[0]=e)}function IT(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2i(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(Cn(t,e))return;i.uniform2iv(this.addr,e),Pn(t,e)}}function LT(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3i(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(Cn(t,e))return;i.uniform3iv(this.addr,e),Pn(t,e)}}function NT(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4i(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(Cn(t,e))return;i.uniform4iv(this.addr,e),Pn(t,e)}}function DT(i,e){let t=this.cache;t[0]!==e&&(i.uniform1ui(this.addr,e),t[0]=e)}function FT(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2ui(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(Cn(t,e))return;i.uniform2uiv(this.addr,e),Pn(t,e)}}function OT(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3ui(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(Cn(t,e))return;i.uniform3uiv(this.addr,e),Pn(t,e)}}function UT(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4ui(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(Cn(t,e))return;i.uniform4uiv(this.addr,e),Pn(t,e)}}function fu(i){return i.version===0&&(i.compareFunction=hp,i.needsUpdate=!0),i}function kT(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_2D_SHADOW?r=fu(Ry):r=Ay,t.setTexture2D(e||r,s)}function BT(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),t.setTexture3D(e||Iy,s)}function HT(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_CUBE_SHADOW?r=fu(Cy):r=Ly,t.setTextureCube(e||r,s)}function zT(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),t.setTexture2DArray(e||Py,s)}function VT(i){switch(i){case 5126:return wT;case 35664:return MT;case 35665:return ST;case 35666:return TT;case 35674:return AT;case 35675:return RT;case 35676:return CT;case 5124:case 35670:return PT;case 35667:case 35671:return IT;case 35668:case 35672:return LT;case 35669:case 35673:return NT;case 5125:return DT;case 36294:return FT;case 36295:return OT;case 36296:return UT;case 35678:case 36198:case 36298:case 36306:case 35682:return kT;case 35679:case 36299:case 36307:return BT;case 35680:case 36300:case 36308:case 36293:return HT;case 36289:case 36303:case 36311:case 36292:return zT}}function GT(i,e){i.uniform1fv(this.addr,e)}function WT(i,e){let t=qo(e,this.size,2);i.uniform2fv(this.addr,t)}function XT(i,e){let t=qo(e,this.size,3);i.uniform3fv(this.addr,t)}function qT(i,e){let t=qo(e,this.size,4);i.uniform4fv(this.addr,t)}function YT(i,e){let t=qo(e,this.size,4);i.uniformMatrix2fv(this.addr,!1,t)}function $T(i,e){let t=qo(e,this.size,9);i.uniformMatrix3fv(this.addr,!1,t)}function jT(i,e){let t=qo(e,this.size,16);i.uniformMatrix4fv(this.addr,!1,t)}function ZT(i,e){i.uniform1iv(this.addr,e)}function JT(i,e){i.uniform2iv(this.addr,e)}function KT(i,e){i.uniform3iv(this.addr,e)}function QT(i,e){i.uniform4iv(this.addr,e)}function e1(i,e){i.uniform1uiv(this.addr,e)}function t1(i,e){i.uniform2uiv(this.addr,e)}function n1(i,e){i.uniform3uiv(this.addr,e)}function i1(i,e){i.uniform4uiv(this.addr,e)}function s1(i,e,t){let n=this.cache,s=e.length,r=du(t,s);Cn(n,r)||(i.uniform1iv(this.addr,r),Pn(n,r));let o;this.type===i.SAMPLER_2D_SHADOW?o=fu(Ry):o=Ay;for(let a=0;a!==s;++a)t.setTexture2D(e[a]||o,r[a])}function r1(i,e,t){let n=this.cache,s=e.length,r=du(t,s);Cn(n,r)||(i.uniform1iv(this.addr,r),Pn(n,r));for(let o=0;o!==s;++o)t.setTexture3D(e[o]||Iy,r[o])}function o1(i,e,t){let n=this.cache,s=e.length,r=du(t,s);Cn(n,r)||(i.uniform1iv(this.addr,r),Pn(n,r));let o;this.type===i.SAMPLER_CUBE_SHADOW?o=fu(Cy):o=Ly;for(let a=0;a!==s;++a)t.setTextureCube(e[a]||o,r[a])}function a1(i,e,t){let n=this.cache,s=e.length,r=du(t,s);Cn(n,r)||(i.uniform1iv(this.addr,r),Pn(n,r));for(let o=0;o!==s;++o)t.setTexture2DArray(e[o]||Py,r[o])}function l1(i){switch(i){case 5126:return GT;case 35664:return WT;case 35665:return XT;case 35666:return qT;case 35674:return YT;case 35675:return $T;case 35676:return jT;case 5124:case 35670:return ZT;case 35667:case 35671:return JT;case 35668:case 35672:return KT;case 35669:case 35673:return QT;case 5125:return e1;case 36294:return t1;case 36295:return n1;case 36296:return i1;case 35678:case 36198:case 36298:case 36306:case 35682:return s1;case 35679:case 36299:case 36307:return r1;case 35680:case 36300:case 36308:case 36293:return o1;case 36289:case 36303:case 36311:case 36292:return a1}}var Mp=class{constructor(e,t,n){this.id=e,this.addr=n,this.cache=[],this.type=t.type,this.setValue=VT(t.type)}},Sp=class{constructor(e,t,n){this.id=e,this.addr=n,this.cache=[],this.type=t.type,this.size=t.size,this.setValue=l1(t.type)}},Tp=class{constructor(e){this.id=e,this.seq=[],this.map={}}setValue(e,t,n){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(e,t[a.id],n)}}},Ep=/(\w+)(\])?(\[|\.)?/g;function uy(i,e){i.seq.push(e),i.map[e.id]=e}function c1(i,e,t){let n=i.name,s=n.length;for(Ep.lastIndex=0;;){let r=Ep.exec(n),o=Ep.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===s){uy(t,c===void 0?new Mp(a,i,e):new Sp(a,i,e));break}else{let u=t.map[a];u===void 0&&(u=new Tp(a),uy(t,u)),t=u}}}var Xo=class{constructor(e,t){this.seq=[],this.map={};let n=e.getProgramParameter(t,e.ACTIVE_UNIFORMS);for(let o=0;o<n;++o){let a=e.getActiveUniform(t,o),l=e.getUniformLocation(t,a.name);c1(a,l,this)}let s=[],r=[];for(let o of this.seq)o.type===e.SAMPLER_2D_SHADOW||o.type===e.SAMPLER_CUBE_SHADOW||o.type===e.SAMPLER_2D_ARRAY_SHADOW?s.push(o):r.push(o);s.length>0&&(this.seq=s.concat(r))}setValue(e,t,n,s){let r=this.map[t];r!==void 0&&r.setValue(e,n,s)}setOptional(e,t,n){let s=t[n];s!==void 0&&this.setValue(e,n,s)}static upload(e,t,n,s){for(let r=0,o=t.length;r!==o;++r){let a=t[r],l=n[a.id];l.needsUpdate!==!1&&a.setValue(e,l.value,s)}}static seqWithValue(e,t){let n=[];for(let s=0,r=e.length;s!==r;++s){let o=e[s];o.id in t&&n.push(o)}return n}};function dy(i,e,t){let n=i.createShader(e);return i.shaderSource(n,t),i.compileShader(n),n}var h1=37297,u1=0;function d1(i,e){let t=i.split(`
`),n=[],s=Math.max(e-6,0),r=Math.min(e+6,t.length);for(let o=s;o<r;o++){let a=o+1;n.push(`${a===e?">":" "} ${a}: ${t[o]}`)}return n.join(`
`)}var fy=new yt;function f1(i){Ct._getMatrix(fy,Ct.workingColorSpace,i);let e=`mat3( ${fy.elements.map(t=>t.toFixed(4))} )`;switch(Ct.getTransfer(i)){case Da:return[e,"LinearTransferOETF"];case Vt:return[e,"sRGBTransferOETF"];default:return it("WebGLProgram: Unsupported color space: ",i),[e,"LinearTransferOETF"]}}function py(i,e,t){let n=i.getShaderParameter(e,i.COMPILE_STATUS),r=(i.getShaderInfoLog(e)||"").trim();if(n&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return t.toUpperCase()+`

`+r+`

`+d1(i.getShaderSource(e),a)}else return r}function p1(i,e){let t=f1(e);return[`vec4 ${i}( vec4 value ) {`,`	return ${t[1]}( vec4( ${t[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var m1={[$f]:"Linear",[jf]:"Reinhard",[Zf]:"Cineon",[Jf]:"ACESFilmic",[Qf]:"AgX",[ep]:"Neutral",[Kf]:"Custom"};function g1(i,e){let t=m1[e];return t===void 0?(it("WebGLProgram: Unsupported toneMapping:",e),"vec3 "+i+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+i+"( vec3 color ) { return "+t+"ToneMapping( color ); }"}var cu=new S;function y1(){Ct.getLuminanceCoefficients(cu);let i=cu.x.toFixed(4),e=cu.y.toFixed(4),t=cu.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${i}, ${e}, ${t} );`,"	return dot( weights, rgb );","}"].join(`
`)}function v1(i){return[i.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",i.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(Pl).join(`
`)}function x1(i){let e=[];for(let t in i){let n=i[t];n!==!1&&e.push("#define "+t+" "+n)}return e.join(`
`)}function _1(i,e){let t={},n=i.getProgramParameter(e,i.ACTIVE_ATTRIBUTES);for(let s=0;s<n;s++){let r=i.getActiveAttrib(e,s),o=r.name,a=1;r.type===i.FLOAT_MAT2&&(a=2),r.type===i.FLOAT_MAT3&&(a=3),r.type===i.FLOAT_MAT4&&(a=4),t[o]={type:r.type,location:i.getAttribLocation(e,o),locationSize:a}}return t}function Pl(i){return i!==""}function my(i,e){let t=e.numSpotLightShadows+e.numSpotLightMaps-e.numSpotLightShadowsWithMaps;return i.replace(/NUM_SUN_LIGHTS/g,e.numSunLights).replace(/NUM_DIR_LIGHTS/g,e.numDirLights).replace(/NUM_SPOT_LIGHTS/g,e.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,e.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,t).replace(/NUM_RECT_AREA_LIGHTS/g,e.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,e.numPointLights).replace(/NUM_HEMI_LIGHTS/g,e.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,e.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,e.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,e.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,e.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,e.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,e.numLightProbeGrids)}function gy(i,e){return i.replace(/NUM_CLIPPING_PLANES/g,e.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,e.numClippingPlanes-e.numClipIntersection)}var b1=/^[ \t]*#include +<([\w\d./]+)>/gm;function Ap(i){return i.replace(b1,E1)}function E1(i,e){let t=Mt[e];if(t===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+e+">");return Ap(t)}var w1=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function yy(i){return i.replace(w1,M1)}function M1(i,e,t,n){let s="";for(let r=parseInt(e);r<parseInt(t);r++)s+=n.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function vy(i){let e=`precision ${i.precision} float;
	precision ${i.precision} int;
	precision ${i.precision} sampler2D;
	precision ${i.precision} samplerCube;
	precision ${i.precision} sampler3D;
	precision ${i.precision} sampler2DArray;
	precision ${i.precision} sampler2DShadow;
	precision ${i.precision} samplerCubeShadow;
	precision ${i.precision} sampler2DArrayShadow;
	precision ${i.precision} isampler2D;
	precision ${i.precision} isampler3D;
	precision ${i.precision} isamplerCube;
	precision ${i.precision} isampler2DArray;
	precision ${i.precision} usampler2D;
	precision ${i.precision} usampler3D;
	precision ${i.precision} usamplerCube;
	precision ${i.precision} usampler2DArray;
	`;return i.precision==="highp"?e+=`
#define HIGH_PRECISION`:i.precision==="mediump"?e+=`
#define MEDIUM_PRECISION`:i.precision==="lowp"&&(e+=`
#define LOW_PRECISION`),e}var S1={[yr]:"SHADOWMAP_TYPE_PCF",[zo]:"SHADOWMAP_TYPE_VSM"};function T1(i){return S1[i.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var A1={[Go]:"ENVMAP_MODE_REFRACTION"};function R1(i){return i.envMap===!1?"ENVMAP_MODE_REFLECTION":A1[i.envMapMode]||"ENVMAP_MODE_REFLECTION"}var C1={[vl]:"ENVMAP_BLENDING_MULTIPLY",[D0]:"ENVMAP_BLENDING_MIX",[F0]:"ENVMAP_BLENDING_ADD"};function P1(i){return i.envMap===!1?"ENVMAP_BLENDING_NONE":C1[i.combine]||"ENVMAP_BLENDING_NONE"}function I1(i,e,t,n){let s=i.getContext(),r=t.defines,o=t.vertexShader,a=t.fragmentShader,l=T1(t),c=t.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=R1(t),u=P1(t),d=v1(t),f=x1(r),p=s.createProgram(),v,g,m=t.glslVersion?"#version "+t.glslVersion+`
`:"";t.isRawShaderMaterial?(v=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f].filter(Pl).join(`
`),v.length>0&&(v+=`
`),g=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f].filter(Pl).join(`
`),g.length>0&&(g+=`
`)):(v=[vy(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f,t.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",t.batching?"#define USE_BATCHING":"",t.batchingColor?"#define USE_BATCHING_COLOR":"",t.instancing?"#define USE_INSTANCING":"",t.instancingColor?"#define USE_INSTANCING_COLOR":"",t.instancingMorph?"#define USE_INSTANCING_MORPH":"",t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.map?"#define USE_MAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+h:"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.displacementMap?"#define USE_DISPLACEMENTMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.mapUv?"#define MAP_UV "+t.mapUv:"",t.alphaMapUv?"#define ALPHAMAP_UV "+t.alphaMapUv:"",t.lightMapUv?"#define LIGHTMAP_UV "+t.lightMapUv:"",t.aoMapUv?"#define AOMAP_UV "+t.aoMapUv:"",t.emissiveMapUv?"#define EMISSIVEMAP_UV "+t.emissiveMapUv:"",t.bumpMapUv?"#define BUMPMAP_UV "+t.bumpMapUv:"",t.normalMapUv?"#define NORMALMAP_UV "+t.normalMapUv:"",t.displacementMapUv?"#define DISPLACEMENTMAP_UV "+t.displacementMapUv:"",t.metalnessMapUv?"#define METALNESSMAP_UV "+t.metalnessMapUv:"",t.roughnessMapUv?"#define ROUGHNESSMAP_UV "+t.roughnessMapUv:"",t.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+t.anisotropyMapUv:"",t.clearcoatMapUv?"#define CLEARCOATMAP_UV "+t.clearcoatMapUv:"",t.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+t.clearcoatNormalMapUv:"",t.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+t.clearcoatRoughnessMapUv:"",t.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+t.diffuseRoughnessMapUv:"",t.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+t.iridescenceMapUv:"",t.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+t.iridescenceThicknessMapUv:"",t.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+t.sheenColorMapUv:"",t.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+t.sheenRoughnessMapUv:"",t.specularMapUv?"#define SPECULARMAP_UV "+t.specularMapUv:"",t.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+t.specularColorMapUv:"",t.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+t.specularIntensityMapUv:"",t.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+t.transmissionMapUv:"",t.thicknessMapUv?"#define THICKNESSMAP_UV "+t.thicknessMapUv:"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexNormals?"#define HAS_NORMAL":"",t.vertexColors?"#define USE_COLOR":"",t.vertexAlphas?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.flatShading?"#define FLAT_SHADED":"",t.skinning?"#define USE_SKINNING":"",t.morphTargets?"#define USE_MORPHTARGETS":"",t.morphNormals&&t.flatShading===!1?"#define USE_MORPHNORMALS":"",t.morphColors?"#define USE_MORPHCOLORS":"",t.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+t.morphTextureStride:"",t.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+t.morphTargetsCount:"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.sizeAttenuation?"#define USE_SIZEATTENUATION":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(Pl).join(`
`),g=[vy(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f,t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",t.map?"#define USE_MAP":"",t.matcap?"#define USE_MATCAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+c:"",t.envMap?"#define "+h:"",t.envMap?"#define "+u:"",t.envMapPMREM?"#define ENVMAP_MAX_LOD "+t.envMapMaxLod+".0":"",t.envMapPMREM?"#define ENVMAP_SIZE "+t.envMapSize+".0":"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoat?"#define USE_CLEARCOAT":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.dispersion?"#define USE_DISPERSION":"",t.retroreflection?"#define USE_RETROREFLECTION":"",t.iridescence?"#define USE_IRIDESCENCE":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaTest?"#define USE_ALPHATEST":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.sheen?"#define USE_SHEEN":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexColors||t.instancingColor?"#define USE_COLOR":"",t.vertexAlphas||t.batchingColor?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.gradientMap?"#define USE_GRADIENTMAP":"",t.flatShading?"#define FLAT_SHADED":"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",t.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",t.toneMapping!==Hi?"#define TONE_MAPPING":"",t.toneMapping!==Hi?Mt.tonemapping_pars_fragment:"",t.toneMapping!==Hi?g1("toneMapping",t.toneMapping):"",t.dithering?"#define DITHERING":"",t.opaque?"#define OPAQUE":"",Mt.colorspace_pars_fragment,p1("linearToOutputTexel",t.outputColorSpace),y1(),t.useDepthPacking?"#define DEPTH_PACKING "+t.depthPacking:"",`
`].filter(Pl).join(`
`)),o=Ap(o),o=my(o,t),o=gy(o,t),a=Ap(a),a=my(a,t),a=gy(a,t),o=yy(o),a=yy(a),t.isRawShaderMaterial!==!0&&(m=`#version 300 es
`,v=[d,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+v,g=["#define varying in",t.glslVersion===dp?"":"layout(location = 0) out highp vec4 pc_fragColor;",t.glslVersion===dp?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+g);let y=m+v+o,b=m+g+a,x=dy(s,s.VERTEX_SHADER,y),T=dy(s,s.FRAGMENT_SHADER,b);s.attachShader(p,x),s.attachShader(p,T),t.index0AttributeName!==void 0?s.bindAttribLocation(p,0,t.index0AttributeName):t.hasPositionAttribute===!0&&s.bindAttribLocation(p,0,"position"),s.linkProgram(p);function M(P){if(i.debug.checkShaderErrors){let I=s.getProgramInfoLog(p)||"",U=s.getShaderInfoLog(x)||"",H=s.getShaderInfoLog(T)||"",L=I.trim(),k=U.trim(),q=H.trim(),V=!0,ce=!0;if(s.getProgramParameter(p,s.LINK_STATUS)===!1)if(V=!1,typeof i.debug.onShaderError=="function")i.debug.onShaderError(s,p,x,T);else{let Z=py(s,x,"vertex"),Q=py(s,T,"fragment");ht("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(p,s.VALIDATE_STATUS)+`

Material Name: `+P.name+`
Material Type: `+P.type+`

Program Info Log: `+L+`
`+Z+`
`+Q)}else L!==""?it("WebGLProgram: Program Info Log:",L):(k===""||q==="")&&(ce=!1);ce&&(P.diagnostics={runnable:V,programLog:L,vertexShader:{log:k,prefix:v},fragmentShader:{log:q,prefix:g}})}s.deleteShader(x),s.deleteShader(T),_=new Xo(s,p),w=_1(s,p)}let _;this.getUniforms=function(){return _===void 0&&M(this),_};let w;this.getAttributes=function(){return w===void 0&&M(this),w};let N=t.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return N===!1&&(N=s.getProgramParameter(p,h1)),N},this.destroy=function(){n.releaseStatesOfProgram(this),s.deleteProgram(p),this.program=void 0},this.type=t.shaderType,this.name=t.shaderName,this.id=u1++,this.cacheKey=e,this.usedTimes=1,this.program=p,this.vertexShader=x,this.fragmentShader=T,this}var L1=0,Rp=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(e,t,n){let s=this._getShaderCacheForMaterial(e);return s.has(t)===!1&&(s.add(t),t.usedTimes++),s.has(n)===!1&&(s.add(n),n.usedTimes++),this}remove(e){let t=this.materialCache.get(e);for(let n of t)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(e),this}getVertexShaderStage(e){return this._getShaderStage(e.vertexShader)}getFragmentShaderStage(e){return this._getShaderStage(e.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(e){let t=this.materialCache,n=t.get(e);return n===void 0&&(n=new Set,t.set(e,n)),n}_getShaderStage(e){let t=this.shaderCache,n=t.get(e);return n===void 0&&(n=new Cp(e),t.set(e,n)),n}},Cp=class{constructor(e){this.id=L1++,this.code=e,this.usedTimes=0}};function N1(i){return i===xr||i===Sl||i===Tl}function D1(i,e,t,n,s,r){let o=new No,a=new Rp,l=new Set,c=[],h=new Map,u=n.logarithmicDepthBuffer,d={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function f(_){return l.add(_),_===0?"uv":`uv${_}`}function p(_,w,N,P,I,U){let H=P.fog,L=I.geometry,k=_.isMeshStandardMaterial||_.isMeshLambertMaterial||_.isMeshPhongMaterial?P.environment:null,q=_.isMeshStandardMaterial||_.isMeshLambertMaterial&&!_.envMap||_.isMeshPhongMaterial&&!_.envMap,V=e.get(_.envMap||k,q),ce=d[_.type],Z=n.precision;_.precision!==null&&(Z=n.getMaxPrecision(_.precision),Z!==_.precision&&it("WebGLProgram.getParameters:",_.precision,"not supported, using",Z,"instead."));let Q=L.morphAttributes.position||L.morphAttributes.normal||L.morphAttributes.color,te=Q!==void 0?Q.length:0,pe=0;L.morphAttributes.position!==void 0&&(pe=1),L.morphAttributes.normal!==void 0&&(pe=2),L.morphAttributes.color!==void 0&&(pe=3);let he,ee,ye,xe;if(ce){let De=hi[ce];he=De.vertexShader,ee=De.fragmentShader}else{he=_.vertexShader,ee=_.fragmentShader;let De=a.getVertexShaderStage(_),_t=a.getFragmentShaderStage(_);a.update(_,De,_t),ye=De.id,xe=_t.id}let Le=i.getRenderTarget(),Me=i.state.buffers.depth.getReversed(),Ve=I.isInstancedMesh===!0,at=I.isBatchedMesh===!0,Ze=!!_.map,lt=!!_.matcap,rt=!!V,oe=rt&&V.isPMREMTexture===!0,_e=!!_.aoMap,ve=!!_.lightMap,ke=!!_.bumpMap&&_.wireframe===!1,Ne=!!_.normalMap,st=!!_.displacementMap,Be=!!_.emissiveMap,xt=!!_.metalnessMap,gt=!!_.roughnessMap,bt=_.anisotropy>0,B=_.clearcoat>0,Ee=_.diffuseRoughness>0,Xe=_.dispersion>0,ft=_.retroreflectivity>0,Se=_.iridescence>0,zt=_.sheen>0,$e=_.transmission>0,tt=bt&&!!_.anisotropyMap,D=B&&!!_.clearcoatMap,A=B&&!!_.clearcoatNormalMap,Y=B&&!!_.clearcoatRoughnessMap,fe=Ee&&!!_.diffuseRoughnessMap,ae=Se&&!!_.iridescenceMap,we=Se&&!!_.iridescenceThicknessMap,Te=zt&&!!_.sheenColorMap,ne=zt&&!!_.sheenRoughnessMap,se=!!_.specularMap,ge=!!_.specularColorMap,z=!!_.specularIntensityMap,re=$e&&!!_.transmissionMap,ie=$e&&!!_.thicknessMap,Ce=!!_.gradientMap,be=!!_.alphaMap,Re=_.alphaTest>0,Je=!!_.alphaHash,ut=!!_.extensions,de=Hi;_.toneMapped&&(Le===null||Le.isXRRenderTarget===!0)&&(de=i.toneMapping);let qe=oe?V.isCompressedCubeTexture?V.image[0].mipmaps:V.mipmaps:null,dt={shaderID:ce,shaderType:_.type,shaderName:_.name,vertexShader:he,fragmentShader:ee,defines:_.defines,customVertexShaderID:ye,customFragmentShaderID:xe,isRawShaderMaterial:_.isRawShaderMaterial===!0,glslVersion:_.glslVersion,precision:Z,batching:at,batchingColor:at&&I._colorsTexture!==null,instancing:Ve,instancingColor:Ve&&I.instanceColor!==null,instancingMorph:Ve&&I.morphTexture!==null,outputColorSpace:Le===null?i.outputColorSpace:Le.isXRRenderTarget===!0?Le.texture.colorSpace:Ct.workingColorSpace,alphaToCoverage:!!_.alphaToCoverage,map:Ze,matcap:lt,envMap:rt,envMapMode:rt&&V.mapping,envMapPMREM:oe,envMapMaxLod:oe?qe.length-1:null,envMapSize:oe?qe[0].width:null,aoMap:_e,lightMap:ve,bumpMap:ke,normalMap:Ne,displacementMap:st,emissiveMap:Be,normalMapObjectSpace:Ne&&_.normalMapType===k0,normalMapTangentSpace:Ne&&_.normalMapType===Al,packedNormalMap:Ne&&_.normalMapType===Al&&N1(_.normalMap.format),metalnessMap:xt,roughnessMap:gt,anisotropy:bt,anisotropyMap:tt,clearcoat:B,clearcoatMap:D,clearcoatNormalMap:A,clearcoatRoughnessMap:Y,diffuseRoughness:Ee,diffuseRoughnessMap:fe,dispersion:Xe,retroreflection:ft,iridescence:Se,iridescenceMap:ae,iridescenceThicknessMap:we,sheen:zt,sheenColorMap:Te,sheenRoughnessMap:ne,specularMap:se,specularColorMap:ge,specularIntensityMap:z,transmission:$e,transmissionMap:re,thicknessMap:ie,gradientMap:Ce,opaque:_.transparent===!1&&_.blending===Vo&&_.alphaToCoverage===!1,alphaMap:be,alphaTest:Re,alphaHash:Je,combine:_.combine,mapUv:Ze&&f(_.map.channel),aoMapUv:_e&&f(_.aoMap.channel),lightMapUv:ve&&f(_.lightMap.channel),bumpMapUv:ke&&f(_.bumpMap.channel),normalMapUv:Ne&&f(_.normalMap.channel),displacementMapUv:st&&f(_.displacementMap.channel),emissiveMapUv:Be&&f(_.emissiveMap.channel),metalnessMapUv:xt&&f(_.metalnessMap.channel),roughnessMapUv:gt&&f(_.roughnessMap.channel),anisotropyMapUv:tt&&f(_.anisotropyMap.channel),clearcoatMapUv:D&&f(_.clearcoatMap.channel),clearcoatNormalMapUv:A&&f(_.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:Y&&f(_.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:fe&&f(_.diffuseRoughnessMap.channel),iridescenceMapUv:ae&&f(_.iridescenceMap.channel),iridescenceThicknessMapUv:we&&f(_.iridescenceThicknessMap.channel),sheenColorMapUv:Te&&f(_.sheenColorMap.channel),sheenRoughnessMapUv:ne&&f(_.sheenRoughnessMap.channel),specularMapUv:se&&f(_.specularMap.channel),specularColorMapUv:ge&&f(_.specularColorMap.channel),specularIntensityMapUv:z&&f(_.specularIntensityMap.channel),transmissionMapUv:re&&f(_.transmissionMap.channel),thicknessMapUv:ie&&f(_.thicknessMap.channel),alphaMapUv:be&&f(_.alphaMap.channel),vertexTangents:!!L.attributes.tangent&&(Ne||bt),vertexNormals:!!L.attributes.normal,vertexColors:_.vertexColors,vertexAlphas:_.vertexColors===!0&&!!L.attributes.color&&L.attributes.color.itemSize===4,pointsUvs:I.isPoints===!0&&!!L.attributes.uv&&(Ze||be),fog:!!H,useFog:_.fog===!0,fogExp2:!!H&&H.isFogExp2,flatShading:_.wireframe===!1&&(_.flatShading===!0||L.attributes.normal===void 0&&Ne===!1&&(_.isMeshLambertMaterial||_.isMeshPhongMaterial||_.isMeshStandardMaterial||_.isMeshPhysicalMaterial)),sizeAttenuation:_.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:Me,skinning:I.isSkinnedMesh===!0,hasPositionAttribute:L.attributes.position!==void 0,morphTargets:L.morphAttributes.position!==void 0,morphNormals:L.morphAttributes.normal!==void 0,morphColors:L.morphAttributes.color!==void 0,morphTargetsCount:te,morphTextureStride:pe,numSunLights:w.sun.length,numDirLights:w.directional.length,numPointLights:w.point.length,numSpotLights:w.spot.length,numSpotLightMaps:w.spotLightMap.length,numRectAreaLights:w.rectArea.length,numHemiLights:w.hemi.length,numSunLightShadows:w.sunShadowMap.length,numDirLightShadows:w.directionalShadowMap.length,numPointLightShadows:w.pointShadowMap.length,numSpotLightShadows:w.spotShadowMap.length,numSpotLightShadowsWithMaps:w.numSpotLightShadowsWithMaps,numLightProbes:w.numLightProbes,numLightProbeGrids:U.filter(De=>De.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:_.dithering,shadowMapEnabled:i.shadowMap.enabled&&N.length>0,shadowMapType:i.shadowMap.type,toneMapping:de,decodeVideoTexture:Ze&&_.map.isVideoTexture===!0&&Ct.getTransfer(_.map.colorSpace)===Vt,decodeVideoTextureEmissive:Be&&_.emissiveMap.isVideoTexture===!0&&Ct.getTransfer(_.emissiveMap.colorSpace)===Vt,premultipliedAlpha:_.premultipliedAlpha,doubleSided:_.side===wn,flipSided:_.side===li,useDepthPacking:_.depthPacking>=0,depthPacking:_.depthPacking||0,index0AttributeName:_.index0AttributeName,extensionClipCullDistance:ut&&_.extensions.clipCullDistance===!0&&t.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(ut&&_.extensions.multiDraw===!0||at)&&t.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:t.has("KHR_parallel_shader_compile"),customProgramCacheKey:_.customProgramCacheKey()};return dt.vertexUv1s=l.has(1),dt.vertexUv2s=l.has(2),dt.vertexUv3s=l.has(3),l.clear(),dt}function v(_){let w=[];if(_.shaderID?w.push(_.shaderID):(w.push(_.customVertexShaderID),w.push(_.customFragmentShaderID)),_.defines!==void 0)for(let N in _.defines)w.push(N),w.push(_.defines[N]);return _.isRawShaderMaterial===!1&&(g(w,_),m(w,_),w.push(i.outputColorSpace)),w.push(_.customProgramCacheKey),w.join()}function g(_,w){_.push(w.precision),_.push(w.outputColorSpace),_.push(w.envMapMode),_.push(w.envMapPMREM),_.push(w.envMapMaxLod),_.push(w.envMapSize),_.push(w.mapUv),_.push(w.alphaMapUv),_.push(w.lightMapUv),_.push(w.aoMapUv),_.push(w.bumpMapUv),_.push(w.normalMapUv),_.push(w.displacementMapUv),_.push(w.emissiveMapUv),_.push(w.metalnessMapUv),_.push(w.roughnessMapUv),_.push(w.anisotropyMapUv),_.push(w.clearcoatMapUv),_.push(w.clearcoatNormalMapUv),_.push(w.clearcoatRoughnessMapUv),_.push(w.diffuseRoughnessMapUv),_.push(w.iridescenceMapUv),_.push(w.iridescenceThicknessMapUv),_.push(w.sheenColorMapUv),_.push(w.sheenRoughnessMapUv),_.push(w.specularMapUv),_.push(w.specularColorMapUv),_.push(w.specularIntensityMapUv),_.push(w.transmissionMapUv),_.push(w.thicknessMapUv),_.push(w.combine),_.push(w.fogExp2),_.push(w.sizeAttenuation),_.push(w.morphTargetsCount),_.push(w.numSunLights),_.push(w.numDirLights),_.push(w.numPointLights),_.push(w.numSpotLights),_.push(w.numSpotLightMaps),_.push(w.numHemiLights),_.push(w.numRectAreaLights),_.push(w.numSunLightShadows),_.push(w.numDirLightShadows),_.push(w.numPointLightShadows),_.push(w.numSpotLightShadows),_.push(w.numSpotLightShadowsWithMaps),_.push(w.numLightProbes),_.push(w.numLightProbeGrids),_.push(w.shadowMapType),_.push(w.toneMapping),_.push(w.numClippingPlanes),_.push(w.numClipIntersection),_.push(w.depthPacking)}function m(_,w){o.disableAll(),w.instancing&&o.enable(0),w.instancingColor&&o.enable(1),w.instancingMorph&&o.enable(2),w.matcap&&o.enable(3),w.envMap&&o.enable(4),w.normalMapObjectSpace&&o.enable(5),w.normalMapTangentSpace&&o.enable(6),w.clearcoat&&o.enable(7),w.iridescence&&o.enable(8),w.alphaTest&&o.enable(9),w.vertexColors&&o.enable(10),w.vertexAlphas&&o.enable(11),w.vertexUv1s&&o.enable(12),w.vertexUv2s&&o.enable(13),w.vertexUv3s&&o.enable(14),w.vertexTangents&&o.enable(15),w.anisotropy&&o.enable(16),w.alphaHash&&o.enable(17),w.batching&&o.enable(18),w.dispersion&&o.enable(19),w.retroreflection&&o.enable(24),w.diffuseRoughness&&o.enable(25),w.batchingColor&&o.enable(20),w.gradientMap&&o.enable(21),w.packedNormalMap&&o.enable(22),w.vertexNormals&&o.enable(23),_.push(o.mask),o.disableAll(),w.fog&&o.enable(0),w.useFog&&o.enable(1),w.flatShading&&o.enable(2),w.logarithmicDepthBuffer&&o.enable(3),w.reversedDepthBuffer&&o.enable(4),w.skinning&&o.enable(5),w.morphTargets&&o.enable(6),w.morphNormals&&o.enable(7),w.morphColors&&o.enable(8),w.premultipliedAlpha&&o.enable(9),w.shadowMapEnabled&&o.enable(10),w.doubleSided&&o.enable(11),w.flipSided&&o.enable(12),w.useDepthPacking&&o.enable(13),w.dithering&&o.enable(14),w.transmission&&o.enable(15),w.sheen&&o.enable(16),w.opaque&&o.enable(17),w.pointsUvs&&o.enable(18),w.decodeVideoTexture&&o.enable(19),w.decodeVideoTextureEmissive&&o.enable(20),w.alphaToCoverage&&o.enable(21),w.numLightProbeGrids>0&&o.enable(22),w.hasPositionAttribute&&o.enable(23),_.push(o.mask)}function y(_){let w=d[_.type],N;if(w){let P=hi[w];N=Rl.clone(P.uniforms)}else N=_.uniforms;return N}function b(_,w){let N=h.get(w);return N!==void 0?++N.usedTimes:(N=new I1(i,w,_,s),c.push(N),h.set(w,N)),N}function x(_){if(--_.usedTimes===0){let w=c.indexOf(_);c[w]=c[c.length-1],c.pop(),h.delete(_.cacheKey),_.destroy()}}function T(_){a.remove(_)}function M(){a.dispose()}return{getParameters:p,getProgramCacheKey:v,getUniforms:y,acquireProgram:b,releaseProgram:x,releaseShaderCache:T,programs:c,dispose:M}}function F1(){let i=new WeakMap;function e(o){return i.has(o)}function t(o){let a=i.get(o);return a===void 0&&(a={},i.set(o,a)),a}function n(o){i.delete(o)}function s(o,a,l){i.get(o)[a]=l}function r(){i=new WeakMap}return{has:e,get:t,remove:n,update:s,dispose:r}}function O1(i,e){return i.groupOrder!==e.groupOrder?i.groupOrder-e.groupOrder:i.renderOrder!==e.renderOrder?i.renderOrder-e.renderOrder:i.material.id!==e.material.id?i.material.id-e.material.id:i.materialVariant!==e.materialVariant?i.materialVariant-e.materialVariant:i.z!==e.z?i.z-e.z:i.id-e.id}function xy(i,e){return i.groupOrder!==e.groupOrder?i.groupOrder-e.groupOrder:i.renderOrder!==e.renderOrder?i.renderOrder-e.renderOrder:i.z!==e.z?e.z-i.z:i.id-e.id}function _y(){let i=[],e=0,t=[],n=[],s=[];function r(){e=0,t.length=0,n.length=0,s.length=0}function o(d){let f=0;return d.isInstancedMesh&&(f+=2),d.isSkinnedMesh&&(f+=1),f}function a(d,f,p,v,g,m){let y=i[e];return y===void 0?(y={id:d.id,object:d,geometry:f,material:p,materialVariant:o(d),groupOrder:v,renderOrder:d.renderOrder,z:g,group:m},i[e]=y):(y.id=d.id,y.object=d,y.geometry=f,y.material=p,y.materialVariant=o(d),y.groupOrder=v,y.renderOrder=d.renderOrder,y.z=g,y.group=m),e++,y}function l(d,f,p,v,g,m,y){y.reversedDepth===!0&&(g=-g);let b=a(d,f,p,v,g,m);p.transmission>0?n.push(b):p.transparent===!0?s.push(b):t.push(b)}function c(d,f,p,v,g,m){let y=a(d,f,p,v,g,m);p.transmission>0?n.unshift(y):p.transparent===!0?s.unshift(y):t.unshift(y)}function h(d,f){t.length>1&&t.sort(d||O1),n.length>1&&n.sort(f||xy),s.length>1&&s.sort(f||xy)}function u(){for(let d=e,f=i.length;d<f;d++){let p=i[d];if(p.id===null)break;p.id=null,p.object=null,p.geometry=null,p.material=null,p.group=null}}return{opaque:t,transmissive:n,transparent:s,init:r,push:l,unshift:c,finish:u,sort:h}}function U1(){let i=new WeakMap;function e(n,s){let r=i.get(n),o;return r===void 0?(o=new _y,i.set(n,[o])):s>=r.length?(o=new _y,r.push(o)):o=r[s],o}function t(){i=new WeakMap}return{get:e,dispose:t}}function k1(){let i={};return{get:function(e){if(i[e.id]!==void 0)return i[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={direction:new S,color:new et};break;case"SpotLight":t={position:new S,direction:new S,color:new et,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":t={position:new S,color:new et,distance:0,decay:0};break;case"HemisphereLight":t={direction:new S,skyColor:new et,groundColor:new et};break;case"RectAreaLight":t={color:new et,position:new S,halfWidth:new S,halfHeight:new S};break}return i[e.id]=t,t}}}function B1(){let i={};return{get:function(e){if(i[e.id]!==void 0)return i[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new ue};break;case"SpotLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new ue};break;case"PointLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new ue,shadowCameraNear:1,shadowCameraFar:1e3};break}return i[e.id]=t,t}}}var H1=0;function z1(i,e){return(e.castShadow?2:0)-(i.castShadow?2:0)+(e.map?1:0)-(i.map?1:0)}function V1(i){let e=new k1,t=B1(),n={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)n.probe.push(new S);let s=new S,r=new Qe,o=new Qe;function a(c){let h=0,u=0,d=0;for(let U=0;U<9;U++)n.probe[U].set(0,0,0);let f=0,p=0,v=0,g=0,m=0,y=0,b=0,x=0,T=0,M=0,_=0,w=0,N=0,P=0;c.sort(z1);for(let U=0,H=c.length;U<H;U++){let L=c[U],k=L.color,q=L.intensity,V=L.distance,ce=null;if(L.shadow&&L.shadow.map&&(L.shadow.map.texture.format===xr?ce=L.shadow.map.texture:ce=L.shadow.map.depthTexture||L.shadow.map.texture),L.isAmbientLight)h+=k.r*q,u+=k.g*q,d+=k.b*q;else if(L.isLightProbe){for(let Z=0;Z<9;Z++)n.probe[Z].addScaledVector(L.sh.coefficients[Z],q);P++}else if(L.isSunLight){let Z=e.get(L);if(Z.color.copy(L.color).multiplyScalar(L.intensity),L.castShadow){let Q=L.shadow,te=t.get(L);te.shadowIntensity=Q.intensity,te.shadowBias=Q.bias,te.shadowNormalBias=Q.normalBias,te.shadowRadius=Q.radius,te.shadowMapSize.copy(Q.mapSize).multiply(Q.getFrameExtents()),n.sunShadow[p]=te,n.sunShadowMap[p]=ce;let pe=Q.getViewportCount();for(let he=0;he<pe;he++)n.sunShadowMatrix[v+he]=Q.getMatrix(he),n.sunShadowCascade[v+he]=Q._cascadeData[he];v+=pe,p++}n.sun[f]=Z,f++}else if(L.isDirectionalLight){let Z=e.get(L);if(Z.color.copy(L.color).multiplyScalar(L.intensity),L.castShadow){let Q=L.shadow,te=t.get(L);te.shadowIntensity=Q.intensity,te.shadowBias=Q.bias,te.shadowNormalBias=Q.normalBias,te.shadowRadius=Q.radius,te.shadowMapSize=Q.mapSize,n.directionalShadow[g]=te,n.directionalShadowMap[g]=ce,n.directionalShadowMatrix[g]=L.shadow.matrix,T++}n.directional[g]=Z,g++}else if(L.isSpotLight){let Z=e.get(L);Z.position.setFromMatrixPosition(L.matrixWorld),Z.color.copy(k).multiplyScalar(q),Z.distance=V,Z.coneCos=Math.cos(L.angle),Z.penumbraCos=Math.cos(L.angle*(1-L.penumbra)),Z.decay=L.decay,n.spot[y]=Z;let Q=L.shadow;if(L.map&&(n.spotLightMap[w]=L.map,w++,Q.updateMatrices(L),L.castShadow&&N++),n.spotLightMatrix[y]=Q.matrix,L.castShadow){let te=t.get(L);te.shadowIntensity=Q.intensity,te.shadowBias=Q.bias,te.shadowNormalBias=Q.normalBias,te.shadowRadius=Q.radius,te.shadowMapSize=Q.mapSize,n.spotShadow[y]=te,n.spotShadowMap[y]=ce,_++}y++}else if(L.isRectAreaLight){let Z=e.get(L);Z.color.copy(k).multiplyScalar(q),Z.halfWidth.set(L.width*.5,0,0),Z.halfHeight.set(0,L.height*.5,0),n.rectArea[b]=Z,b++}else if(L.isPointLight){let Z=e.get(L);if(Z.color.copy(L.color).multiplyScalar(L.intensity),Z.distance=L.distance,Z.decay=L.decay,L.castShadow){let Q=L.shadow,te=t.get(L);te.shadowIntensity=Q.intensity,te.shadowBias=Q.bias,te.shadowNormalBias=Q.normalBias,te.shadowRadius=Q.radius,te.shadowMapSize=Q.mapSize,te.shadowCameraNear=Q.camera.near,te.shadowCameraFar=Q.camera.far,n.pointShadow[m]=te,n.pointShadowMap[m]=ce,n.pointShadowMatrix[m]=L.shadow.matrix,M++}n.point[m]=Z,m++}else if(L.isHemisphereLight){let Z=e.get(L);Z.skyColor.copy(L.color).multiplyScalar(q),Z.groundColor.copy(L.groundColor).multiplyScalar(q),n.hemi[x]=Z,x++}}b>0&&(i.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=Fe.LTC_FLOAT_1,n.rectAreaLTC2=Fe.LTC_FLOAT_2):(n.rectAreaLTC1=Fe.LTC_HALF_1,n.rectAreaLTC2=Fe.LTC_HALF_2)),n.ambient[0]=h,n.ambient[1]=u,n.ambient[2]=d;let I=n.hash;(I.sunLength!==f||I.directionalLength!==g||I.pointLength!==m||I.spotLength!==y||I.rectAreaLength!==b||I.hemiLength!==x||I.numSunShadows!==p||I.numDirectionalShadows!==T||I.numPointShadows!==M||I.numSpotShadows!==_||I.numSpotMaps!==w||I.numLightProbes!==P)&&(n.sun.length=f,n.directional.length=g,n.spot.length=y,n.rectArea.length=b,n.point.length=m,n.hemi.length=x,n.sunShadow.length=p,n.sunShadowMap.length=p,n.sunShadowMatrix.length=v,n.sunShadowCascade.length=v,n.directionalShadow.length=T,n.directionalShadowMap.length=T,n.directionalShadowMatrix.length=T,n.pointShadow.length=M,n.pointShadowMap.length=M,n.pointShadowMatrix.length=M,n.spotShadow.length=_,n.spotShadowMap.length=_,n.spotLightMatrix.length=_+w-N,n.spotLightMap.length=w,n.numSpotLightShadowsWithMaps=N,n.numLightProbes=P,I.sunLength=f,I.directionalLength=g,I.pointLength=m,I.spotLength=y,I.rectAreaLength=b,I.hemiLength=x,I.numSunShadows=p,I.numDirectionalShadows=T,I.numPointShadows=M,I.numSpotShadows=_,I.numSpotMaps=w,I.numLightProbes=P,n.version=H1++)}function l(c,h){let u=0,d=0,f=0,p=0,v=0,g=0,m=h.matrixWorldInverse;for(let y=0,b=c.length;y<b;y++){let x=c[y];if(x.isSunLight){let T=n.sun[u];T.direction.setFromMatrixPosition(x.matrixWorld),T.direction.transformDirection(m),u++}else if(x.isDirectionalLight){let T=n.directional[d];T.direction.setFromMatrixPosition(x.matrixWorld),s.setFromMatrixPosition(x.target.matrixWorld),T.direction.sub(s),T.direction.transformDirection(m),d++}else if(x.isSpotLight){let T=n.spot[p];T.position.setFromMatrixPosition(x.matrixWorld),T.position.applyMatrix4(m),T.direction.setFromMatrixPosition(x.matrixWorld),s.setFromMatrixPosition(x.target.matrixWorld),T.direction.sub(s),T.direction.transformDirection(m),p++}else if(x.isRectAreaLight){let T=n.rectArea[v];T.position.setFromMatrixPosition(x.matrixWorld),T.position.applyMatrix4(m),o.identity(),r.copy(x.matrixWorld),r.premultiply(m),o.extractRotation(r),T.halfWidth.set(x.width*.5,0,0),T.halfHeight.set(0,x.height*.5,0),T.halfWidth.applyMatrix4(o),T.halfHeight.applyMatrix4(o),v++}else if(x.isPointLight){let T=n.point[f];T.position.setFromMatrixPosition(x.matrixWorld),T.position.applyMatrix4(m),f++}else if(x.isHemisphereLight){let T=n.hemi[g];T.direction.setFromMatrixPosition(x.matrixWorld),T.direction.transformDirection(m),g++}}}return{setup:a,setupView:l,state:n}}function by(i){let e=new V1(i),t=[],n=[],s=[];function r(u){h.camera=u,t.length=0,n.length=0,s.length=0}function o(u){u.isLightProbeGrid?s.push(u):t.push(u)}function a(u){n.push(u)}function l(){e.setup(t),s.sort((u,d)=>u.priority-d.priority||u.id-d.id)}function c(u){e.setupView(t,u)}let h={lightsArray:t,shadowsArray:n,lightProbeGridArray:s,camera:null,lights:e,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:l,setupLightsView:c,pushLight:o,pushShadow:a}}function G1(i){let e=new WeakMap;function t(s,r=0){let o=e.get(s),a;return o===void 0?(a=new by(i),e.set(s,[a])):r>=o.length?(a=new by(i),o.push(a)):a=o[r],a}function n(){e=new WeakMap}return{get:t,dispose:n}}var W1=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,X1=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,q1=[new S(1,0,0),new S(-1,0,0),new S(0,1,0),new S(0,-1,0),new S(0,0,1),new S(0,0,-1)],Y1=[new S(0,-1,0),new S(0,-1,0),new S(0,0,1),new S(0,0,-1),new S(0,-1,0),new S(0,-1,0)],Ey=new Qe,Cl=new S,wp=new S;function $1(i,e,t){let n=new Bs,s=new ue,r=new ue,o=new Gt,a=new lh,l=new ch,c={},h=t.maxTextureSize,u={[vr]:li,[li]:vr,[wn]:wn},d=new Bi({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new ue},radius:{value:4}},vertexShader:W1,fragmentShader:X1}),f=d.clone();f.defines.HORIZONTAL_PASS=1;let p=new St;p.setAttribute("position",new kt(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let v=new wt(p,d),g=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=yr;let m=this.type;this.render=function(M,_,w){if(g.enabled===!1||g.autoUpdate===!1&&g.needsUpdate===!1||M.length===0)return;this.type===m0&&(it("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=yr);let N=i.getRenderTarget(),P=i.getActiveCubeFace(),I=i.getActiveMipmapLevel(),U=i.state;U.setBlending(Or),U.buffers.depth.getReversed()===!0?U.buffers.color.setClear(0,0,0,0):U.buffers.color.setClear(1,1,1,1),U.buffers.depth.setTest(!0),U.setScissorTest(!1);let H=m!==this.type;H&&_.traverse(function(L){L.material&&(Array.isArray(L.material)?L.material.forEach(k=>k.needsUpdate=!0):L.material.needsUpdate=!0)});for(let L=0,k=M.length;L<k;L++){let q=M[L],V=q.shadow;if(V===void 0){it("WebGLShadowMap:",q,"has no shadow.");continue}if(V.autoUpdate===!1&&V.needsUpdate===!1)continue;s.copy(V.mapSize);let ce=V.getFrameExtents();s.multiply(ce),r.copy(V.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/ce.x),s.x=r.x*ce.x,V.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/ce.y),s.y=r.y*ce.y,V.mapSize.y=r.y));let Z=i.state.buffers.depth.getReversed();if(V.camera._reversedDepth=Z,V.map===null||H===!0){if(V.map!==null&&(V.map.depthTexture!==null&&(V.map.depthTexture.dispose(),V.map.depthTexture=null),V.map.dispose()),this.type===zo){if(q.isPointLight){it("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}V.map=new Ai(s.x,s.y,{format:xr,type:Qi,minFilter:oi,magFilter:oi,generateMipmaps:!1}),V.map.texture.name=q.name+".shadowMap",V.map.depthTexture=new zs(s.x,s.y,pi),V.map.depthTexture.name=q.name+".shadowMapDepth",V.map.depthTexture.format=ks,V.map.depthTexture.compareFunction=null,V.map.depthTexture.minFilter=Bn,V.map.depthTexture.magFilter=Bn}else q.isPointLight?(V.map=new Il(s.x),V.map.depthTexture=new Xa(s.x,zi)):(V.map=new Ai(s.x,s.y),V.map.depthTexture=new zs(s.x,s.y,zi)),V.map.depthTexture.name=q.name+".shadowMap",V.map.depthTexture.format=ks,this.type===yr?(V.map.depthTexture.compareFunction=Z?cp:lp,V.map.depthTexture.minFilter=oi,V.map.depthTexture.magFilter=oi):(V.map.depthTexture.compareFunction=null,V.map.depthTexture.minFilter=Bn,V.map.depthTexture.magFilter=Bn);V.camera.updateProjectionMatrix()}V.map.isWebGLCubeRenderTarget!==!0&&(V.map.width!==s.x||V.map.height!==s.y)&&V.map.setSize(s.x,s.y);let Q=V.map.isWebGLCubeRenderTarget?6:V.getViewportCount();q.isPointLight!==!0&&V.updateMatrices(q,w);let te=(V.camera.layers.mask&4294967294)!==0?V.camera.layers:w.layers;for(let pe=0;pe<Q;pe++){let he=V.getCamera(pe);if(q.isPointLight){let ee=V.camera,ye=V.matrix,xe=q.distance||ee.far;xe!==ee.far&&(ee.far=xe,ee.updateProjectionMatrix()),Cl.setFromMatrixPosition(q.matrixWorld),ee.position.copy(Cl),wp.copy(ee.position),wp.add(q1[pe]),ee.up.copy(Y1[pe]),ee.lookAt(wp),ee.updateMatrixWorld(),ye.makeTranslation(-Cl.x,-Cl.y,-Cl.z),Ey.multiplyMatrices(ee.projectionMatrix,ee.matrixWorldInverse),V._frustum.setFromProjectionMatrix(Ey,ee.coordinateSystem,ee.reversedDepth)}if(V.map.isWebGLCubeRenderTarget)i.setRenderTarget(V.map,pe),i.clear();else{pe===0&&(i.setRenderTarget(V.map),i.clear());let ee=V.getViewport(pe);o.set(r.x*ee.x,r.y*ee.y,r.x*ee.z,r.y*ee.w),U.viewport(o)}n=V.getFrustum(pe),x(_,w,he,q,te,this.type)}V.isPointLightShadow!==!0&&this.type===zo&&y(V,w),V.needsUpdate=!1}m=this.type,g.needsUpdate=!1,i.setRenderTarget(N,P,I)};function y(M,_){let w=e.update(v);d.defines.VSM_SAMPLES!==M.blurSamples&&(d.defines.VSM_SAMPLES=M.blurSamples,f.defines.VSM_SAMPLES=M.blurSamples,d.needsUpdate=!0,f.needsUpdate=!0),M.mapPass===null?M.mapPass=new Ai(s.x,s.y,{format:xr,type:Qi}):(M.mapPass.width!==M.map.width||M.mapPass.height!==M.map.height)&&M.mapPass.setSize(M.map.width,M.map.height),d.uniforms.shadow_pass.value=M.map.depthTexture,d.uniforms.resolution.value.set(M.map.width,M.map.height),d.uniforms.radius.value=M.radius,i.setRenderTarget(M.mapPass),i.clear(),i.renderBufferDirect(_,null,w,d,v,null),f.uniforms.shadow_pass.value=M.mapPass.texture,f.uniforms.resolution.value.set(M.map.width,M.map.height),f.uniforms.radius.value=M.radius,i.setRenderTarget(M.map),i.clear(),i.renderBufferDirect(_,null,w,f,v,null)}function b(M,_,w,N){let P=null,I=w.isPointLight===!0?M.customDistanceMaterial:M.customDepthMaterial;if(I!==void 0)P=I;else if(P=w.isPointLight===!0?l:a,i.localClippingEnabled&&_.clipShadows===!0&&Array.isArray(_.clippingPlanes)&&_.clippingPlanes.length!==0||_.displacementMap&&_.displacementScale!==0||_.alphaMap&&_.alphaTest>0||_.map&&_.alphaTest>0||_.alphaToCoverage===!0){let U=P.uuid,H=_.uuid,L=c[U];L===void 0&&(L={},c[U]=L);let k=L[H];k===void 0&&(k=P.clone(),L[H]=k,_.addEventListener("dispose",T)),P=k}if(P.visible=_.visible,P.wireframe=_.wireframe,N===zo?P.side=_.shadowSide!==null?_.shadowSide:_.side:P.side=_.shadowSide!==null?_.shadowSide:u[_.side],P.alphaMap=_.alphaMap,P.alphaTest=_.alphaToCoverage===!0?.5:_.alphaTest,P.map=_.map,P.clipShadows=_.clipShadows,P.clippingPlanes=_.clippingPlanes,P.clipIntersection=_.clipIntersection,P.displacementMap=_.displacementMap,P.displacementScale=_.displacementScale,P.displacementBias=_.displacementBias,P.wireframeLinewidth=_.wireframeLinewidth,P.linewidth=_.linewidth,w.isPointLight===!0&&P.isMeshDistanceMaterial===!0){let U=i.properties.get(P);U.light=w}return P}function x(M,_,w,N,P,I){if(M.visible===!1)return;if(M.layers.test(P)&&(M.isMesh||M.isLine||M.isPoints)&&(M.castShadow||M.receiveShadow&&I===zo)&&(!M.frustumCulled||M.intersectsFrustum(n))){M.modelViewMatrix.multiplyMatrices(w.matrixWorldInverse,M.matrixWorld);let L=e.update(M),k=M.material;if(Array.isArray(k)){let q=L.groups;for(let V=0,ce=q.length;V<ce;V++){let Z=q[V],Q=k[Z.materialIndex];if(Q&&Q.visible){let te=b(M,Q,N,I);M.onBeforeShadow(i,M,_,w,L,te,Z),i.renderBufferDirect(w,null,L,te,M,Z),M.onAfterShadow(i,M,_,w,L,te,Z)}}}else if(k.visible){let q=b(M,k,N,I);M.onBeforeShadow(i,M,_,w,L,q,null),i.renderBufferDirect(w,null,L,q,M,null),M.onAfterShadow(i,M,_,w,L,q,null)}}let H=M.children;for(let L=0,k=H.length;L<k;L++)x(H[L],_,w,N,P,I)}function T(M){M.target.removeEventListener("dispose",T);for(let w in c){let N=c[w],P=M.target.uuid;P in N&&(N[P].dispose(),delete N[P])}}}function j1(i,e){function t(){let z=!1,re=new Gt,ie=null,Ce=new Gt(0,0,0,0);return{setMask:function(be){ie!==be&&!z&&(i.colorMask(be,be,be,be),ie=be)},setLocked:function(be){z=be},setClear:function(be,Re,Je,ut,de){de===!0&&(be*=ut,Re*=ut,Je*=ut),re.set(be,Re,Je,ut),Ce.equals(re)===!1&&(i.clearColor(be,Re,Je,ut),Ce.copy(re))},reset:function(){z=!1,ie=null,Ce.set(-1,0,0,0)}}}function n(){let z=!1,re=!1,ie=null,Ce=null,be=null;return{setReversed:function(Re){if(re!==Re){let Je=e.get("EXT_clip_control");Re?Je.clipControlEXT(Je.LOWER_LEFT_EXT,Je.ZERO_TO_ONE_EXT):Je.clipControlEXT(Je.LOWER_LEFT_EXT,Je.NEGATIVE_ONE_TO_ONE_EXT),re=Re;let ut=be;be=null,this.setClear(ut)}},getReversed:function(){return re},setTest:function(Re){Re?Me(i.DEPTH_TEST):Ve(i.DEPTH_TEST)},setMask:function(Re){ie!==Re&&!z&&(i.depthMask(Re),ie=Re)},setFunc:function(Re){if(re&&(Re=$0[Re]),Ce!==Re){switch(Re){case Hc:i.depthFunc(i.NEVER);break;case zc:i.depthFunc(i.ALWAYS);break;case Vc:i.depthFunc(i.LESS);break;case Ro:i.depthFunc(i.LEQUAL);break;case Gc:i.depthFunc(i.EQUAL);break;case Wc:i.depthFunc(i.GEQUAL);break;case Xc:i.depthFunc(i.GREATER);break;case qc:i.depthFunc(i.NOTEQUAL);break;default:i.depthFunc(i.LEQUAL)}Ce=Re}},setLocked:function(Re){z=Re},setClear:function(Re){be!==Re&&(be=Re,re&&(Re=1-Re),i.clearDepth(Re))},reset:function(){z=!1,ie=null,Ce=null,be=null,re=!1}}}function s(){let z=!1,re=null,ie=null,Ce=null,be=null,Re=null,Je=null,ut=null,de=null;return{setTest:function(qe){z||(qe?Me(i.STENCIL_TEST):Ve(i.STENCIL_TEST))},setMask:function(qe){re!==qe&&!z&&(i.stencilMask(qe),re=qe)},setFunc:function(qe,dt,De){(ie!==qe||Ce!==dt||be!==De)&&(i.stencilFunc(qe,dt,De),ie=qe,Ce=dt,be=De)},setOp:function(qe,dt,De){(Re!==qe||Je!==dt||ut!==De)&&(i.stencilOp(qe,dt,De),Re=qe,Je=dt,ut=De)},setLocked:function(qe){z=qe},setClear:function(qe){de!==qe&&(i.clearStencil(qe),de=qe)},reset:function(){z=!1,re=null,ie=null,Ce=null,be=null,Re=null,Je=null,ut=null,de=null}}}let r=new t,o=new n,a=new s,l={},c=new WeakMap,h={},u={},d={},f=new WeakMap,p=[],v=null,g=!1,m=null,y=null,b=null,x=null,T=null,M=null,_=null,w=new et(0,0,0),N=0,P=!1,I=null,U=null,H=null,L=null,k=null,q=i.getParameter(i.MAX_COMBINED_TEXTURE_IMAGE_UNITS),V=!1,ce=0,Z=i.getParameter(i.VERSION);Z.indexOf("WebGL")!==-1?(ce=parseFloat(/^WebGL (\d)/.exec(Z)[1]),V=ce>=1):Z.indexOf("OpenGL ES")!==-1&&(ce=parseFloat(/^OpenGL ES (\d)/.exec(Z)[1]),V=ce>=2);let Q=null,te={},pe=i.getParameter(i.SCISSOR_BOX),he=i.getParameter(i.VIEWPORT),ee=new Gt().fromArray(pe),ye=new Gt().fromArray(he);function xe(z,re,ie,Ce){let be=new Uint8Array(4),Re=i.createTexture();i.bindTexture(z,Re),i.texParameteri(z,i.TEXTURE_MIN_FILTER,i.NEAREST),i.texParameteri(z,i.TEXTURE_MAG_FILTER,i.NEAREST);for(let Je=0;Je<ie;Je++)z===i.TEXTURE_3D||z===i.TEXTURE_2D_ARRAY?i.texImage3D(re,0,i.RGBA,1,1,Ce,0,i.RGBA,i.UNSIGNED_BYTE,be):i.texImage2D(re+Je,0,i.RGBA,1,1,0,i.RGBA,i.UNSIGNED_BYTE,be);return Re}let Le={};Le[i.TEXTURE_2D]=xe(i.TEXTURE_2D,i.TEXTURE_2D,1),Le[i.TEXTURE_CUBE_MAP]=xe(i.TEXTURE_CUBE_MAP,i.TEXTURE_CUBE_MAP_POSITIVE_X,6),Le[i.TEXTURE_2D_ARRAY]=xe(i.TEXTURE_2D_ARRAY,i.TEXTURE_2D_ARRAY,1,1),Le[i.TEXTURE_3D]=xe(i.TEXTURE_3D,i.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),Me(i.DEPTH_TEST),o.setFunc(Ro),ke(!1),Ne(zf),Me(i.CULL_FACE),_e(Or);function Me(z){h[z]!==!0&&(i.enable(z),h[z]=!0)}function Ve(z){h[z]!==!1&&(i.disable(z),h[z]=!1)}function at(z,re){return d[z]!==re?(i.bindFramebuffer(z,re),d[z]=re,z===i.DRAW_FRAMEBUFFER&&(d[i.FRAMEBUFFER]=re),z===i.FRAMEBUFFER&&(d[i.DRAW_FRAMEBUFFER]=re),!0):!1}function Ze(z,re){let ie=p,Ce=!1;if(z){ie=f.get(re),ie===void 0&&(ie=[],f.set(re,ie));let be=z.textures;if(ie.length!==be.length||ie[0]!==i.COLOR_ATTACHMENT0){for(let Re=0,Je=be.length;Re<Je;Re++)ie[Re]=i.COLOR_ATTACHMENT0+Re;ie.length=be.length,Ce=!0}}else ie[0]!==i.BACK&&(ie[0]=i.BACK,Ce=!0);Ce&&i.drawBuffers(ie)}function lt(z){return v!==z?(i.useProgram(z),v=z,!0):!1}let rt={[Ur]:i.FUNC_ADD,[y0]:i.FUNC_SUBTRACT,[v0]:i.FUNC_REVERSE_SUBTRACT};rt[x0]=i.MIN,rt[_0]=i.MAX;let oe={[b0]:i.ZERO,[E0]:i.ONE,[w0]:i.SRC_COLOR,[qf]:i.SRC_ALPHA,[C0]:i.SRC_ALPHA_SATURATE,[A0]:i.DST_COLOR,[S0]:i.DST_ALPHA,[M0]:i.ONE_MINUS_SRC_COLOR,[Yf]:i.ONE_MINUS_SRC_ALPHA,[R0]:i.ONE_MINUS_DST_COLOR,[T0]:i.ONE_MINUS_DST_ALPHA,[P0]:i.CONSTANT_COLOR,[I0]:i.ONE_MINUS_CONSTANT_COLOR,[L0]:i.CONSTANT_ALPHA,[N0]:i.ONE_MINUS_CONSTANT_ALPHA};function _e(z,re,ie,Ce,be,Re,Je,ut,de,qe){if(z===Or){g===!0&&(Ve(i.BLEND),g=!1);return}if(g===!1&&(Me(i.BLEND),g=!0),z!==g0){if(z!==m||qe!==P){if((y!==Ur||T!==Ur)&&(i.blendEquation(i.FUNC_ADD),y=Ur,T=Ur),qe)switch(z){case Vo:i.blendFuncSeparate(i.ONE,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Gf:i.blendFunc(i.ONE,i.ONE);break;case Wf:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case Xf:i.blendFuncSeparate(i.DST_COLOR,i.ONE_MINUS_SRC_ALPHA,i.ZERO,i.ONE);break;default:ht("WebGLState: Invalid blending: ",z);break}else switch(z){case Vo:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Gf:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE,i.ONE,i.ONE);break;case Wf:ht("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case Xf:ht("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:ht("WebGLState: Invalid blending: ",z);break}b=null,x=null,M=null,_=null,w.set(0,0,0),N=0,m=z,P=qe}return}be=be||re,Re=Re||ie,Je=Je||Ce,(re!==y||be!==T)&&(i.blendEquationSeparate(rt[re],rt[be]),y=re,T=be),(ie!==b||Ce!==x||Re!==M||Je!==_)&&(i.blendFuncSeparate(oe[ie],oe[Ce],oe[Re],oe[Je]),b=ie,x=Ce,M=Re,_=Je),(ut.equals(w)===!1||de!==N)&&(i.blendColor(ut.r,ut.g,ut.b,de),w.copy(ut),N=de),m=z,P=!1}function ve(z,re){z.side===wn?Ve(i.CULL_FACE):Me(i.CULL_FACE);let ie=z.side===li;re&&(ie=!ie),ke(ie),z.blending===Vo&&z.transparent===!1?_e(Or):_e(z.blending,z.blendEquation,z.blendSrc,z.blendDst,z.blendEquationAlpha,z.blendSrcAlpha,z.blendDstAlpha,z.blendColor,z.blendAlpha,z.premultipliedAlpha),o.setFunc(z.depthFunc),o.setTest(z.depthTest),o.setMask(z.depthWrite),r.setMask(z.colorWrite);let Ce=z.stencilWrite;a.setTest(Ce),Ce&&(a.setMask(z.stencilWriteMask),a.setFunc(z.stencilFunc,z.stencilRef,z.stencilFuncMask),a.setOp(z.stencilFail,z.stencilZFail,z.stencilZPass)),Be(z.polygonOffset,z.polygonOffsetFactor,z.polygonOffsetUnits),z.alphaToCoverage===!0?Me(i.SAMPLE_ALPHA_TO_COVERAGE):Ve(i.SAMPLE_ALPHA_TO_COVERAGE)}function ke(z){I!==z&&(z?i.frontFace(i.CW):i.frontFace(i.CCW),I=z)}function Ne(z){z!==f0?(Me(i.CULL_FACE),z!==U&&(z===zf?i.cullFace(i.BACK):z===p0?i.cullFace(i.FRONT):i.cullFace(i.FRONT_AND_BACK))):Ve(i.CULL_FACE),U=z}function st(z){z!==H&&(V&&i.lineWidth(z),H=z)}function Be(z,re,ie){z?(Me(i.POLYGON_OFFSET_FILL),(L!==re||k!==ie)&&(L=re,k=ie,o.getReversed()&&(re=-re,ie=-ie),i.polygonOffset(re,ie))):Ve(i.POLYGON_OFFSET_FILL)}function xt(z){z?Me(i.SCISSOR_TEST):Ve(i.SCISSOR_TEST)}function gt(z){z===void 0&&(z=i.TEXTURE0+q-1),Q!==z&&(i.activeTexture(z),Q=z)}function bt(z,re,ie){ie===void 0&&(Q===null?ie=i.TEXTURE0+q-1:ie=Q);let Ce=te[ie];Ce===void 0&&(Ce={type:void 0,texture:void 0},te[ie]=Ce),(Ce.type!==z||Ce.texture!==re)&&(Q!==ie&&(i.activeTexture(ie),Q=ie),i.bindTexture(z,re||Le[z]),Ce.type=z,Ce.texture=re)}function B(){let z=te[Q];z!==void 0&&z.type!==void 0&&(i.bindTexture(z.type,null),z.type=void 0,z.texture=void 0)}function Ee(){try{i.compressedTexImage2D(...arguments)}catch(z){ht("WebGLState:",z)}}function Xe(){try{i.compressedTexImage3D(...arguments)}catch(z){ht("WebGLState:",z)}}function ft(){try{i.texSubImage2D(...arguments)}catch(z){ht("WebGLState:",z)}}function Se(){try{i.texSubImage3D(...arguments)}catch(z){ht("WebGLState:",z)}}function zt(){try{i.compressedTexSubImage2D(...arguments)}catch(z){ht("WebGLState:",z)}}function $e(){try{i.compressedTexSubImage3D(...arguments)}catch(z){ht("WebGLState:",z)}}function tt(){try{i.texStorage2D(...arguments)}catch(z){ht("WebGLState:",z)}}function D(){try{i.texStorage3D(...arguments)}catch(z){ht("WebGLState:",z)}}function A(){try{i.texImage2D(...arguments)}catch(z){ht("WebGLState:",z)}}function Y(){try{i.texImage3D(...arguments)}catch(z){ht("WebGLState:",z)}}function fe(z){return u[z]!==void 0?u[z]:i.getParameter(z)}function ae(z,re){u[z]!==re&&(i.pixelStorei(z,re),u[z]=re)}function we(z){ee.equals(z)===!1&&(i.scissor(z.x,z.y,z.z,z.w),ee.copy(z))}function Te(z){ye.equals(z)===!1&&(i.viewport(z.x,z.y,z.z,z.w),ye.copy(z))}function ne(z,re){let ie=c.get(re);ie===void 0&&(ie=new WeakMap,c.set(re,ie));let Ce=ie.get(z);Ce===void 0&&(Ce=i.getUniformBlockIndex(re,z.name),i.uniformBlockBinding(re,Ce,Ce),ie.set(z,Ce))}function se(z,re,ie){let be=c.get(re).get(z);l[be]!==ie&&(i.bindBufferBase(i.UNIFORM_BUFFER,be,ie),l[be]=ie)}function ge(){i.disable(i.BLEND),i.disable(i.CULL_FACE),i.disable(i.DEPTH_TEST),i.disable(i.POLYGON_OFFSET_FILL),i.disable(i.SCISSOR_TEST),i.disable(i.STENCIL_TEST),i.disable(i.SAMPLE_ALPHA_TO_COVERAGE),i.blendEquation(i.FUNC_ADD),i.blendFunc(i.ONE,i.ZERO),i.blendFuncSeparate(i.ONE,i.ZERO,i.ONE,i.ZERO),i.blendColor(0,0,0,0),i.colorMask(!0,!0,!0,!0),i.clearColor(0,0,0,0),i.depthMask(!0),i.depthFunc(i.LESS),o.setReversed(!1),i.clearDepth(1),i.stencilMask(4294967295),i.stencilFunc(i.ALWAYS,0,4294967295),i.stencilOp(i.KEEP,i.KEEP,i.KEEP),i.clearStencil(0),i.cullFace(i.BACK),i.frontFace(i.CCW),i.polygonOffset(0,0),i.activeTexture(i.TEXTURE0),i.bindFramebuffer(i.FRAMEBUFFER,null),i.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),i.bindFramebuffer(i.READ_FRAMEBUFFER,null),i.useProgram(null),i.lineWidth(1),i.scissor(0,0,i.canvas.width,i.canvas.height),i.viewport(0,0,i.canvas.width,i.canvas.height),i.pixelStorei(i.PACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,!1),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,i.BROWSER_DEFAULT_WEBGL),i.pixelStorei(i.PACK_ROW_LENGTH,0),i.pixelStorei(i.PACK_SKIP_PIXELS,0),i.pixelStorei(i.PACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_ROW_LENGTH,0),i.pixelStorei(i.UNPACK_IMAGE_HEIGHT,0),i.pixelStorei(i.UNPACK_SKIP_PIXELS,0),i.pixelStorei(i.UNPACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_SKIP_IMAGES,0),h={},u={},Q=null,te={},d={},l={},f=new WeakMap,p=[],v=null,g=!1,m=null,y=null,b=null,x=null,T=null,M=null,_=null,w=new et(0,0,0),N=0,P=!1,I=null,U=null,H=null,L=null,k=null,ee.set(0,0,i.canvas.width,i.canvas.height),ye.set(0,0,i.canvas.width,i.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:Me,disable:Ve,bindFramebuffer:at,drawBuffers:Ze,useProgram:lt,setBlending:_e,setMaterial:ve,setFlipSided:ke,setCullFace:Ne,setLineWidth:st,setPolygonOffset:Be,setScissorTest:xt,activeTexture:gt,bindTexture:bt,unbindTexture:B,compressedTexImage2D:Ee,compressedTexImage3D:Xe,texImage2D:A,texImage3D:Y,pixelStorei:ae,getParameter:fe,updateUBOMapping:ne,uniformBlockBinding:se,texStorage2D:tt,texStorage3D:D,texSubImage2D:ft,texSubImage3D:Se,compressedTexSubImage2D:zt,compressedTexSubImage3D:$e,scissor:we,viewport:Te,reset:ge}}function Z1(i,e,t,n,s,r,o){let a=e.has("WEBGL_multisampled_render_to_texture")?e.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new ue,h=new WeakMap,u=new Set,d,f=new WeakMap,p=new Set,v=new FinalizationRegistry(D=>p.delete(D)),g=!1;try{g=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function m(D,A){return g?new OffscreenCanvas(D,A):Fa("canvas")}function y(D,A,Y){let fe=1,ae=tt(D);if((ae.width>Y||ae.height>Y)&&(fe=Y/Math.max(ae.width,ae.height)),fe<1)if(typeof HTMLImageElement<"u"&&D instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&D instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&D instanceof ImageBitmap||typeof VideoFrame<"u"&&D instanceof VideoFrame){let we=Math.floor(fe*ae.width),Te=Math.floor(fe*ae.height);d===void 0&&(d=m(we,Te));let ne=A?m(we,Te):d;return ne.width=we,ne.height=Te,ne.getContext("2d").drawImage(D,0,0,we,Te),it("WebGLRenderer: Texture has been resized from ("+ae.width+"x"+ae.height+") to ("+we+"x"+Te+")."),ne}else return"data"in D&&it("WebGLRenderer: Image in DataTexture is too big ("+ae.width+"x"+ae.height+")."),D;return D}function b(D){return D.generateMipmaps}function x(D){i.generateMipmap(D)}function T(D){return D.isWebGLCubeRenderTarget?i.TEXTURE_CUBE_MAP:D.isWebGL3DRenderTarget?i.TEXTURE_3D:D.isWebGLArrayRenderTarget||D.isCompressedArrayTexture?i.TEXTURE_2D_ARRAY:i.TEXTURE_2D}function M(D,A,Y,fe,ae,we=!1){if(D!==null){if(i[D]!==void 0)return i[D];it("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+D+"'")}let Te;fe&&(Te=e.get("EXT_texture_norm16"),Te||it("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let ne=A;if(A===i.RED&&(Y===i.FLOAT&&(ne=i.R32F),Y===i.HALF_FLOAT&&(ne=i.R16F),Y===i.UNSIGNED_BYTE&&(ne=i.R8),Y===i.UNSIGNED_SHORT&&Te&&(ne=Te.R16_EXT),Y===i.SHORT&&Te&&(ne=Te.R16_SNORM_EXT)),A===i.RED_INTEGER&&(Y===i.UNSIGNED_BYTE&&(ne=i.R8UI),Y===i.UNSIGNED_SHORT&&(ne=i.R16UI),Y===i.UNSIGNED_INT&&(ne=i.R32UI),Y===i.BYTE&&(ne=i.R8I),Y===i.SHORT&&(ne=i.R16I),Y===i.INT&&(ne=i.R32I)),A===i.RG&&(Y===i.FLOAT&&(ne=i.RG32F),Y===i.HALF_FLOAT&&(ne=i.RG16F),Y===i.UNSIGNED_BYTE&&(ne=i.RG8),Y===i.UNSIGNED_SHORT&&Te&&(ne=Te.RG16_EXT),Y===i.SHORT&&Te&&(ne=Te.RG16_SNORM_EXT)),A===i.RG_INTEGER&&(Y===i.UNSIGNED_BYTE&&(ne=i.RG8UI),Y===i.UNSIGNED_SHORT&&(ne=i.RG16UI),Y===i.UNSIGNED_INT&&(ne=i.RG32UI),Y===i.BYTE&&(ne=i.RG8I),Y===i.SHORT&&(ne=i.RG16I),Y===i.INT&&(ne=i.RG32I)),A===i.RGB_INTEGER&&(Y===i.UNSIGNED_BYTE&&(ne=i.RGB8UI),Y===i.UNSIGNED_SHORT&&(ne=i.RGB16UI),Y===i.UNSIGNED_INT&&(ne=i.RGB32UI),Y===i.BYTE&&(ne=i.RGB8I),Y===i.SHORT&&(ne=i.RGB16I),Y===i.INT&&(ne=i.RGB32I)),A===i.RGBA_INTEGER&&(Y===i.UNSIGNED_BYTE&&(ne=i.RGBA8UI),Y===i.UNSIGNED_SHORT&&(ne=i.RGBA16UI),Y===i.UNSIGNED_INT&&(ne=i.RGBA32UI),Y===i.BYTE&&(ne=i.RGBA8I),Y===i.SHORT&&(ne=i.RGBA16I),Y===i.INT&&(ne=i.RGBA32I)),A===i.RGB&&(Y===i.UNSIGNED_SHORT&&Te&&(ne=Te.RGB16_EXT),Y===i.SHORT&&Te&&(ne=Te.RGB16_SNORM_EXT),Y===i.UNSIGNED_INT_5_9_9_9_REV&&(ne=i.RGB9_E5),Y===i.UNSIGNED_INT_10F_11F_11F_REV&&(ne=i.R11F_G11F_B10F)),A===i.RGBA){let se=we?Da:Ct.getTransfer(ae);Y===i.FLOAT&&(ne=i.RGBA32F),Y===i.HALF_FLOAT&&(ne=i.RGBA16F),Y===i.UNSIGNED_BYTE&&(ne=se===Vt?i.SRGB8_ALPHA8:i.RGBA8),Y===i.UNSIGNED_SHORT&&Te&&(ne=Te.RGBA16_EXT),Y===i.SHORT&&Te&&(ne=Te.RGBA16_SNORM_EXT),Y===i.UNSIGNED_SHORT_4_4_4_4&&(ne=i.RGBA4),Y===i.UNSIGNED_SHORT_5_5_5_1&&(ne=i.RGB5_A1)}return(ne===i.R16F||ne===i.R32F||ne===i.RG16F||ne===i.RG32F||ne===i.RGBA16F||ne===i.RGBA32F)&&e.get("EXT_color_buffer_float"),ne}function _(D,A){let Y;return D?A===null||A===zi||A===Br?Y=i.DEPTH24_STENCIL8:A===pi?Y=i.DEPTH32F_STENCIL8:A===Wo&&(Y=i.DEPTH24_STENCIL8,it("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):A===null||A===zi||A===Br?Y=i.DEPTH_COMPONENT24:A===pi?Y=i.DEPTH_COMPONENT32F:A===Wo&&(Y=i.DEPTH_COMPONENT16),Y}function w(D,A){return b(D)===!0||D.isFramebufferTexture&&D.minFilter!==Bn&&D.minFilter!==oi?Math.log2(Math.max(A.width,A.height))+1:D.mipmaps.length>0?D.mipmaps.length:D.isCompressedTexture&&Array.isArray(D.image)?A.mipmaps.length:1}function N(D){let A=new WeakRef(D);n.get(D).__ref=A,p.add(A),v.register(D,A,A)}function P(D){let A=n.get(D).__ref;A!==void 0&&(p.delete(A),v.unregister(A))}function I(D){H(D.target)}function U(D){L(D.target)}function H(D){D.removeEventListener("dispose",I),P(D),q(D),D.isVideoTexture&&h.delete(D),D.isHTMLTexture&&u.delete(D)}function L(D){D.removeEventListener("dispose",U),P(D),ce(D)}function k(){for(let D of p){let A=D.deref();A!==void 0&&(A.isRenderTarget===!0?L(A):H(A))}p.clear(),u.clear()}function q(D){let A=n.get(D);if(A.__webglInit===void 0)return;let Y=D.source,fe=f.get(Y);if(fe){let ae=fe[A.__cacheKey];ae.usedTimes--,ae.usedTimes===0&&V(D),Object.keys(fe).length===0&&f.delete(Y)}n.remove(D)}function V(D){let A=n.get(D);i.deleteTexture(A.__webglTexture);let Y=D.source,fe=f.get(Y);delete fe[A.__cacheKey],o.memory.textures--}function ce(D){let A=n.get(D);A.__depthDisposeCallback&&A.__depthDisposeCallback();let Y=D.depthTexture;if(Y&&Y.renderTarget===D&&H(Y),D.isWebGLCubeRenderTarget)for(let ae=0;ae<6;ae++){if(Array.isArray(A.__webglFramebuffer[ae]))for(let we=0;we<A.__webglFramebuffer[ae].length;we++)i.deleteFramebuffer(A.__webglFramebuffer[ae][we]);else i.deleteFramebuffer(A.__webglFramebuffer[ae]);A.__webglDepthbuffer&&i.deleteRenderbuffer(A.__webglDepthbuffer[ae])}else{if(Array.isArray(A.__webglFramebuffer))for(let ae=0;ae<A.__webglFramebuffer.length;ae++)i.deleteFramebuffer(A.__webglFramebuffer[ae]);else i.deleteFramebuffer(A.__webglFramebuffer);if(A.__webglDepthbuffer&&i.deleteRenderbuffer(A.__webglDepthbuffer),A.__webglMultisampledFramebuffer&&i.deleteFramebuffer(A.__webglMultisampledFramebuffer),A.__webglColorRenderbuffer)for(let ae=0;ae<A.__webglColorRenderbuffer.length;ae++)A.__webglColorRenderbuffer[ae]&&i.deleteRenderbuffer(A.__webglColorRenderbuffer[ae]);A.__webglDepthRenderbuffer&&i.deleteRenderbuffer(A.__webglDepthRenderbuffer)}let fe=D.textures;for(let ae=0,we=fe.length;ae<we;ae++){let Te=n.get(fe[ae]);Te.__webglTexture&&(i.deleteTexture(Te.__webglTexture),o.memory.textures--),n.remove(fe[ae])}n.remove(D)}let Z=0;function Q(){Z=0}function te(){return Z}function pe(D){Z=D}function he(){let D=Z;return D>=s.maxTextures&&it("WebGLTextures: Trying to use "+(D+1)+" texture units while this GPU supports only "+s.maxTextures),Z+=1,D}function ee(D){let A=[];return A.push(D.wrapS),A.push(D.wrapT),A.push(D.wrapR||0),A.push(D.magFilter),A.push(D.minFilter),A.push(D.anisotropy),A.push(D.internalFormat),A.push(D.format),A.push(D.type),A.push(D.generateMipmaps),A.push(D.mipmapsAutoUpdate),A.push(D.premultiplyAlpha),A.push(D.flipY),A.push(D.unpackAlignment),A.push(D.colorSpace),A.join()}function ye(D,A){let Y=n.get(D);if(D.isVideoTexture&&zt(D),D.isRenderTargetTexture===!1&&D.isExternalTexture!==!0&&D.version>0&&Y.__version!==D.version){let fe=D.image;if(fe===null)it("WebGLRenderer: Texture marked for update but no image data found.");else if(fe.complete===!1)it("WebGLRenderer: Texture marked for update but image is incomplete");else{ve(Y,D,A);return}}else D.isExternalTexture&&(Y.__webglTexture=D.sourceTexture?D.sourceTexture:null);t.bindTexture(i.TEXTURE_2D,Y.__webglTexture,i.TEXTURE0+A)}function xe(D,A){let Y=n.get(D);if(D.isRenderTargetTexture===!1&&D.version>0&&Y.__version!==D.version){ve(Y,D,A);return}else D.isExternalTexture&&(Y.__webglTexture=D.sourceTexture?D.sourceTexture:null);t.bindTexture(i.TEXTURE_2D_ARRAY,Y.__webglTexture,i.TEXTURE0+A)}function Le(D,A){let Y=n.get(D);if(D.isRenderTargetTexture===!1&&D.version>0&&Y.__version!==D.version){ve(Y,D,A);return}t.bindTexture(i.TEXTURE_3D,Y.__webglTexture,i.TEXTURE0+A)}function Me(D,A){let Y=n.get(D);if(D.version>0&&Y.__version!==D.version){ke(Y,D,A);return}t.bindTexture(i.TEXTURE_CUBE_MAP,Y.__webglTexture,i.TEXTURE0+A)}let Ve={[Yc]:i.REPEAT,[fs]:i.CLAMP_TO_EDGE,[$c]:i.MIRRORED_REPEAT},at={[Bn]:i.NEAREST,[O0]:i.NEAREST_MIPMAP_NEAREST,[xl]:i.NEAREST_MIPMAP_LINEAR,[oi]:i.LINEAR,[Mh]:i.LINEAR_MIPMAP_NEAREST,[Xs]:i.LINEAR_MIPMAP_LINEAR},Ze={[H0]:i.NEVER,[hp]:i.ALWAYS,[z0]:i.LESS,[lp]:i.LEQUAL,[V0]:i.EQUAL,[cp]:i.GEQUAL,[G0]:i.GREATER,[W0]:i.NOTEQUAL};function lt(D,A){if(A.type===pi&&e.has("OES_texture_float_linear")===!1&&(A.magFilter===oi||A.magFilter===Mh||A.magFilter===xl||A.magFilter===Xs||A.minFilter===oi||A.minFilter===Mh||A.minFilter===xl||A.minFilter===Xs)&&it("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),i.texParameteri(D,i.TEXTURE_WRAP_S,Ve[A.wrapS]),i.texParameteri(D,i.TEXTURE_WRAP_T,Ve[A.wrapT]),(D===i.TEXTURE_3D||D===i.TEXTURE_2D_ARRAY)&&i.texParameteri(D,i.TEXTURE_WRAP_R,Ve[A.wrapR]),i.texParameteri(D,i.TEXTURE_MAG_FILTER,at[A.magFilter]),i.texParameteri(D,i.TEXTURE_MIN_FILTER,at[A.minFilter]),A.compareFunction&&(i.texParameteri(D,i.TEXTURE_COMPARE_MODE,i.COMPARE_REF_TO_TEXTURE),i.texParameteri(D,i.TEXTURE_COMPARE_FUNC,Ze[A.compareFunction])),e.has("EXT_texture_filter_anisotropic")===!0){if(A.magFilter===Bn||A.minFilter!==xl&&A.minFilter!==Xs||A.type===pi&&e.has("OES_texture_float_linear")===!1)return;if(A.anisotropy>1||n.get(A).__currentAnisotropy){let Y=e.get("EXT_texture_filter_anisotropic");i.texParameterf(D,Y.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(A.anisotropy,s.getMaxAnisotropy())),n.get(A).__currentAnisotropy=A.anisotropy}}}function rt(D,A){let Y=!1;D.__webglInit===void 0&&(D.__webglInit=!0,A.addEventListener("dispose",I),N(A));let fe=A.source,ae=f.get(fe);ae===void 0&&(ae={},f.set(fe,ae));let we=ee(A);if(we!==D.__cacheKey){ae[we]===void 0&&(ae[we]={texture:i.createTexture(),usedTimes:0},o.memory.textures++,Y=!0),ae[we].usedTimes++;let Te=ae[D.__cacheKey];Te!==void 0&&(ae[D.__cacheKey].usedTimes--,Te.usedTimes===0&&V(A)),D.__cacheKey=we,D.__webglTexture=ae[we].texture}return Y}function oe(D,A,Y){return Math.floor(Math.floor(D/Y)/A)}function _e(D,A,Y,fe){let we=D.updateRanges;if(we.length===0)t.texSubImage2D(i.TEXTURE_2D,0,0,0,A.width,A.height,Y,fe,A.data);else{we.sort((z,re)=>z.start-re.start);let Te=0;for(let z=1;z<we.length;z++){let re=we[Te],ie=we[z],Ce=re.start+re.count,be=oe(ie.start,A.width,4),Re=oe(re.start,A.width,4);ie.start<=Ce+1&&be===Re&&oe(ie.start+ie.count-1,A.width,4)===be?re.count=Math.max(re.count,ie.start+ie.count-re.start):(++Te,we[Te]=ie)}we.length=Te+1;let ne=t.getParameter(i.UNPACK_ROW_LENGTH),se=t.getParameter(i.UNPACK_SKIP_PIXELS),ge=t.getParameter(i.UNPACK_SKIP_ROWS);t.pixelStorei(i.UNPACK_ROW_LENGTH,A.width);for(let z=0,re=we.length;z<re;z++){let ie=we[z],Ce=Math.floor(ie.start/4),be=Math.ceil(ie.count/4),Re=Ce%A.width,Je=Math.floor(Ce/A.width),ut=be,de=1;t.pixelStorei(i.UNPACK_SKIP_PIXELS,Re),t.pixelStorei(i.UNPACK_SKIP_ROWS,Je),t.texSubImage2D(i.TEXTURE_2D,0,Re,Je,ut,de,Y,fe,A.data)}D.clearUpdateRanges(),t.pixelStorei(i.UNPACK_ROW_LENGTH,ne),t.pixelStorei(i.UNPACK_SKIP_PIXELS,se),t.pixelStorei(i.UNPACK_SKIP_ROWS,ge)}}function ve(D,A,Y){let fe=i.TEXTURE_2D;(A.isDataArrayTexture||A.isCompressedArrayTexture)&&(fe=i.TEXTURE_2D_ARRAY),A.isData3DTexture&&(fe=i.TEXTURE_3D);let ae=rt(D,A),we=A.source;t.bindTexture(fe,D.__webglTexture,i.TEXTURE0+Y);let Te=n.get(we);if(we.version!==Te.__version||ae===!0){if(t.activeTexture(i.TEXTURE0+Y),(typeof ImageBitmap<"u"&&A.image instanceof ImageBitmap)===!1){let de=Ct.getPrimaries(Ct.workingColorSpace),qe=A.colorSpace===Ys?null:Ct.getPrimaries(A.colorSpace),dt=A.colorSpace===Ys||de===qe?i.NONE:i.BROWSER_DEFAULT_WEBGL;t.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,A.flipY),t.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,A.premultiplyAlpha),t.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,dt)}t.pixelStorei(i.UNPACK_ALIGNMENT,A.unpackAlignment);let se=y(A.image,!1,s.maxTextureSize);se=$e(A,se);let ge=r.convert(A.format,A.colorSpace),z=r.convert(A.type),re=M(A.internalFormat,ge,z,A.normalized,A.colorSpace,A.isVideoTexture);lt(fe,A);let ie,Ce=A.mipmaps,be=A.isVideoTexture!==!0,Re=Te.__version===void 0||ae===!0,Je=we.dataReady,ut=w(A,se);if(A.isDepthTexture)re=_(A.format===qs,A.type),Re&&(be?t.texStorage2D(i.TEXTURE_2D,1,re,se.width,se.height):t.texImage2D(i.TEXTURE_2D,0,re,se.width,se.height,0,ge,z,null));else if(A.isDataTexture)if(Ce.length>0){be&&Re&&t.texStorage2D(i.TEXTURE_2D,ut,re,Ce[0].width,Ce[0].height);for(let de=0,qe=Ce.length;de<qe;de++)ie=Ce[de],be?Je&&t.texSubImage2D(i.TEXTURE_2D,de,0,0,ie.width,ie.height,ge,z,ie.data):t.texImage2D(i.TEXTURE_2D,de,re,ie.width,ie.height,0,ge,z,ie.data);A.generateMipmaps=!1}else be?(Re&&t.texStorage2D(i.TEXTURE_2D,ut,re,se.width,se.height),Je&&_e(A,se,ge,z)):t.texImage2D(i.TEXTURE_2D,0,re,se.width,se.height,0,ge,z,se.data);else if(A.isCompressedTexture)if(A.isCompressedArrayTexture){be&&Re&&t.texStorage3D(i.TEXTURE_2D_ARRAY,ut,re,Ce[0].width,Ce[0].height,se.depth);for(let de=0,qe=Ce.length;de<qe;de++)if(ie=Ce[de],A.format!==Ti)if(ge!==null)if(be){if(Je)if(A.layerUpdates.size>0){let dt=bp(ie.width,ie.height,A.format,A.type);for(let De of A.layerUpdates){let _t=ie.data.subarray(De*dt/ie.data.BYTES_PER_ELEMENT,(De+1)*dt/ie.data.BYTES_PER_ELEMENT);t.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,de,0,0,De,ie.width,ie.height,1,ge,_t)}}else t.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,de,0,0,0,ie.width,ie.height,se.depth,ge,ie.data)}else t.compressedTexImage3D(i.TEXTURE_2D_ARRAY,de,re,ie.width,ie.height,se.depth,0,ie.data,0,0);else it("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else be?Je&&t.texSubImage3D(i.TEXTURE_2D_ARRAY,de,0,0,0,ie.width,ie.height,se.depth,ge,z,ie.data):t.texImage3D(i.TEXTURE_2D_ARRAY,de,re,ie.width,ie.height,se.depth,0,ge,z,ie.data);A.layerUpdates.size>0&&A.clearLayerUpdates()}else{be&&Re&&t.texStorage2D(i.TEXTURE_2D,ut,re,Ce[0].width,Ce[0].height);for(let de=0,qe=Ce.length;de<qe;de++)ie=Ce[de],A.format!==Ti?ge!==null?be?Je&&t.compressedTexSubImage2D(i.TEXTURE_2D,de,0,0,ie.width,ie.height,ge,ie.data):t.compressedTexImage2D(i.TEXTURE_2D,de,re,ie.width,ie.height,0,ie.data):it("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):be?Je&&t.texSubImage2D(i.TEXTURE_2D,de,0,0,ie.width,ie.height,ge,z,ie.data):t.texImage2D(i.TEXTURE_2D,de,re,ie.width,ie.height,0,ge,z,ie.data)}else if(A.isDataArrayTexture)if(be){if(Re&&t.texStorage3D(i.TEXTURE_2D_ARRAY,ut,re,se.width,se.height,se.depth),Je)if(A.layerUpdates.size>0){let de=bp(se.width,se.height,A.format,A.type);for(let qe of A.layerUpdates){let dt=se.data.subarray(qe*de/se.data.BYTES_PER_ELEMENT,(qe+1)*de/se.data.BYTES_PER_ELEMENT);t.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,qe,se.width,se.height,1,ge,z,dt)}A.clearLayerUpdates()}else t.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,0,se.width,se.height,se.depth,ge,z,se.data)}else t.texImage3D(i.TEXTURE_2D_ARRAY,0,re,se.width,se.height,se.depth,0,ge,z,se.data);else if(A.isData3DTexture)be?(Re&&t.texStorage3D(i.TEXTURE_3D,ut,re,se.width,se.height,se.depth),Je&&t.texSubImage3D(i.TEXTURE_3D,0,0,0,0,se.width,se.height,se.depth,ge,z,se.data)):t.texImage3D(i.TEXTURE_3D,0,re,se.width,se.height,se.depth,0,ge,z,se.data);else if(A.isFramebufferTexture){if(Re)if(be)t.texStorage2D(i.TEXTURE_2D,ut,re,se.width,se.height);else{let de=se.width,qe=se.height;for(let dt=0;dt<ut;dt++)t.texImage2D(i.TEXTURE_2D,dt,re,de,qe,0,ge,z,null),de>>=1,qe>>=1}}else if(A.isHTMLTexture){if("texElementImage2D"in i){let de=i.canvas;if(de.hasAttribute("layoutsubtree")||de.setAttribute("layoutsubtree","true"),se.parentNode!==de){de.appendChild(se),u.add(A),de.onpaint=qe=>{let dt=qe.changedElements;for(let De of u)dt.includes(De.image)&&(De.needsUpdate=!0)},de.requestPaint();return}if(i.texElementImage2D.length===3)i.texElementImage2D(i.TEXTURE_2D,i.RGBA8,se);else{let dt=i.RGBA,De=i.RGBA,_t=i.UNSIGNED_BYTE;i.texElementImage2D(i.TEXTURE_2D,0,dt,De,_t,se)}i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MIN_FILTER,i.LINEAR),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_S,i.CLAMP_TO_EDGE),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_T,i.CLAMP_TO_EDGE)}}else if(Ce.length>0){if(be&&Re){let de=tt(Ce[0]);t.texStorage2D(i.TEXTURE_2D,ut,re,de.width,de.height)}for(let de=0,qe=Ce.length;de<qe;de++)ie=Ce[de],be?Je&&t.texSubImage2D(i.TEXTURE_2D,de,0,0,ge,z,ie):t.texImage2D(i.TEXTURE_2D,de,re,ge,z,ie);A.generateMipmaps=!1}else if(be){if(Re){let de=tt(se);t.texStorage2D(i.TEXTURE_2D,ut,re,de.width,de.height)}Je&&t.texSubImage2D(i.TEXTURE_2D,0,0,0,ge,z,se)}else t.texImage2D(i.TEXTURE_2D,0,re,ge,z,se);b(A)&&A.mipmapsAutoUpdate===!0&&x(fe),Te.__version=we.version,A.onUpdate&&A.onUpdate(A)}D.__version=A.version}function ke(D,A,Y){if(A.image.length!==6)return;let fe=rt(D,A),ae=A.source;t.bindTexture(i.TEXTURE_CUBE_MAP,D.__webglTexture,i.TEXTURE0+Y);let we=n.get(ae);if(ae.version!==we.__version||fe===!0){t.activeTexture(i.TEXTURE0+Y);let Te=Ct.getPrimaries(Ct.workingColorSpace),ne=A.colorSpace===Ys?null:Ct.getPrimaries(A.colorSpace),se=A.colorSpace===Ys||Te===ne?i.NONE:i.BROWSER_DEFAULT_WEBGL;t.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,A.flipY),t.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,A.premultiplyAlpha),t.pixelStorei(i.UNPACK_ALIGNMENT,A.unpackAlignment),t.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,se);let ge=A.isCompressedTexture||A.image[0].isCompressedTexture,z=A.image[0]&&A.image[0].isDataTexture,re=[];for(let De=0;De<6;De++)!ge&&!z?re[De]=y(A.image[De],!0,s.maxCubemapSize):re[De]=z?A.image[De].image:A.image[De],re[De]=$e(A,re[De]);let ie=re[0],Ce=r.convert(A.format,A.colorSpace),be=r.convert(A.type),Re=M(A.internalFormat,Ce,be,A.normalized,A.colorSpace),Je=A.isVideoTexture!==!0,ut=we.__version===void 0||fe===!0,de=ae.dataReady,qe=w(A,ie);lt(i.TEXTURE_CUBE_MAP,A);let dt;if(A.isDepthTexture){if(Re=_(A.format===qs,A.type),ut)if(Je)t.texStorage2D(i.TEXTURE_CUBE_MAP,1,Re,ie.width,ie.height);else for(let De=0;De<6;De++)t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+De,0,Re,ie.width,ie.height,0,Ce,be,null)}else if(ge){Je&&ut&&t.texStorage2D(i.TEXTURE_CUBE_MAP,qe,Re,ie.width,ie.height);for(let De=0;De<6;De++){dt=re[De].mipmaps;for(let _t=0;_t<dt.length;_t++){let Kt=dt[_t];A.format!==Ti?Ce!==null?Je?de&&t.compressedTexSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+De,_t,0,0,Kt.width,Kt.height,Ce,Kt.data):t.compressedTexImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+De,_t,Re,Kt.width,Kt.height,0,Kt.data):it("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):Je?de&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+De,_t,0,0,Kt.width,Kt.height,Ce,be,Kt.data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+De,_t,Re,Kt.width,Kt.height,0,Ce,be,Kt.data)}}}else{if(dt=A.mipmaps,Je&&ut){dt.length>0&&qe++;let De=tt(re[0]);t.texStorage2D(i.TEXTURE_CUBE_MAP,qe,Re,De.width,De.height)}for(let De=0;De<6;De++)if(z){Je?de&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+De,0,0,0,re[De].width,re[De].height,Ce,be,re[De].data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+De,0,Re,re[De].width,re[De].height,0,Ce,be,re[De].data);for(let _t=0;_t<dt.length;_t++){let Kn=dt[_t].image[De].image;Je?de&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+De,_t+1,0,0,Kn.width,Kn.height,Ce,be,Kn.data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+De,_t+1,Re,Kn.width,Kn.height,0,Ce,be,Kn.data)}}else{Je?de&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+De,0,0,0,Ce,be,re[De]):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+De,0,Re,Ce,be,re[De]);for(let _t=0;_t<dt.length;_t++){let Kt=dt[_t];Je?de&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+De,_t+1,0,0,Ce,be,Kt.image[De]):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+De,_t+1,Re,Ce,be,Kt.image[De])}}}b(A)&&A.mipmapsAutoUpdate===!0&&x(i.TEXTURE_CUBE_MAP),we.__version=ae.version,A.onUpdate&&A.onUpdate(A)}D.__version=A.version}function Ne(D,A,Y,fe,ae,we){let Te=r.convert(Y.format,Y.colorSpace),ne=r.convert(Y.type),se=M(Y.internalFormat,Te,ne,Y.normalized,Y.colorSpace),ge=n.get(A),z=n.get(Y);if(z.__renderTarget=A,!ge.__hasExternalTextures){let re=Math.max(1,A.width>>we),ie=Math.max(1,A.height>>we);ae===i.TEXTURE_3D||ae===i.TEXTURE_2D_ARRAY?t.texImage3D(ae,we,se,re,ie,A.depth,0,Te,ne,null):t.texImage2D(ae,we,se,re,ie,0,Te,ne,null)}t.bindFramebuffer(i.FRAMEBUFFER,D),Se(A)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,fe,ae,z.__webglTexture,0,ft(A)):(ae===i.TEXTURE_2D||ae>=i.TEXTURE_CUBE_MAP_POSITIVE_X&&ae<=i.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&i.framebufferTexture2D(i.FRAMEBUFFER,fe,ae,z.__webglTexture,we),t.bindFramebuffer(i.FRAMEBUFFER,null)}function st(D,A,Y){if(i.bindRenderbuffer(i.RENDERBUFFER,D),A.depthBuffer){let fe=A.depthTexture,ae=fe&&fe.isDepthTexture?fe.type:null,we=_(A.stencilBuffer,ae),Te=A.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;Se(A)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,ft(A),we,A.width,A.height):Y?i.renderbufferStorageMultisample(i.RENDERBUFFER,ft(A),we,A.width,A.height):i.renderbufferStorage(i.RENDERBUFFER,we,A.width,A.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,Te,i.RENDERBUFFER,D)}else{let fe=A.textures;for(let ae=0;ae<fe.length;ae++){let we=fe[ae],Te=r.convert(we.format,we.colorSpace),ne=r.convert(we.type),se=M(we.internalFormat,Te,ne,we.normalized,we.colorSpace);Se(A)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,ft(A),se,A.width,A.height):Y?i.renderbufferStorageMultisample(i.RENDERBUFFER,ft(A),se,A.width,A.height):i.renderbufferStorage(i.RENDERBUFFER,se,A.width,A.height)}}i.bindRenderbuffer(i.RENDERBUFFER,null)}function Be(D,A,Y){let fe=A.isWebGLCubeRenderTarget===!0;if(t.bindFramebuffer(i.FRAMEBUFFER,D),!(A.depthTexture&&A.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let ae=n.get(A.depthTexture);ae.__renderTarget=A;let we=fe?A.depthTexture.image[0]:A.depthTexture.image;(!ae.__webglTexture||we.width!==A.width||we.height!==A.height)&&(we.width=A.width,we.height=A.height,A.depthTexture.needsUpdate=!0),fe?Me(A.depthTexture,0):ye(A.depthTexture,0);let Te=ae.__webglTexture,ne=ft(A),se=fe?i.TEXTURE_CUBE_MAP_POSITIVE_X+Y:i.TEXTURE_2D,ge=A.depthTexture.format===qs?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;if(A.depthTexture.format===ks)Se(A)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ge,se,Te,0,ne):i.framebufferTexture2D(i.FRAMEBUFFER,ge,se,Te,0);else if(A.depthTexture.format===qs)Se(A)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ge,se,Te,0,ne):i.framebufferTexture2D(i.FRAMEBUFFER,ge,se,Te,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function xt(D){let A=n.get(D),Y=D.isWebGLCubeRenderTarget===!0;if(A.__boundDepthTexture!==D.depthTexture){let fe=D.depthTexture;if(A.__depthDisposeCallback&&A.__depthDisposeCallback(),fe){let ae=()=>{delete A.__boundDepthTexture,delete A.__depthDisposeCallback,fe.removeEventListener("dispose",ae)};fe.addEventListener("dispose",ae),A.__depthDisposeCallback=ae}A.__boundDepthTexture=fe}if(D.depthTexture&&!A.__autoAllocateDepthBuffer)if(Y)for(let fe=0;fe<6;fe++)Be(A.__webglFramebuffer[fe],D,fe);else D.texture.mipmaps.length>0?Be(A.__webglFramebuffer[0],D,0):Be(A.__webglFramebuffer,D,0);else if(Y){A.__webglDepthbuffer=[];for(let fe=0;fe<6;fe++)if(t.bindFramebuffer(i.FRAMEBUFFER,A.__webglFramebuffer[fe]),A.__webglDepthbuffer[fe]===void 0)A.__webglDepthbuffer[fe]=i.createRenderbuffer(),st(A.__webglDepthbuffer[fe],D,!1);else{let ae=D.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,we=A.__webglDepthbuffer[fe];i.bindRenderbuffer(i.RENDERBUFFER,we),i.framebufferRenderbuffer(i.FRAMEBUFFER,ae,i.RENDERBUFFER,we)}}else if(D.texture.mipmaps.length>0?t.bindFramebuffer(i.FRAMEBUFFER,A.__webglFramebuffer[0]):t.bindFramebuffer(i.FRAMEBUFFER,A.__webglFramebuffer),A.__webglDepthbuffer===void 0)A.__webglDepthbuffer=i.createRenderbuffer(),st(A.__webglDepthbuffer,D,!1);else{let ae=D.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,we=A.__webglDepthbuffer;i.bindRenderbuffer(i.RENDERBUFFER,we),i.framebufferRenderbuffer(i.FRAMEBUFFER,ae,i.RENDERBUFFER,we)}t.bindFramebuffer(i.FRAMEBUFFER,null)}function gt(D,A,Y){let fe=n.get(D);A!==void 0&&Ne(fe.__webglFramebuffer,D,D.texture,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,0),Y!==void 0&&xt(D)}function bt(D){let A=D.texture,Y=n.get(D),fe=n.get(A);D.addEventListener("dispose",U),N(D);let ae=D.textures,we=D.isWebGLCubeRenderTarget===!0,Te=ae.length>1;if(Te||(fe.__webglTexture===void 0&&(fe.__webglTexture=i.createTexture()),fe.__version=A.version,o.memory.textures++),we){Y.__webglFramebuffer=[];for(let ne=0;ne<6;ne++)if(A.mipmaps.length>0){Y.__webglFramebuffer[ne]=[];for(let se=0;se<A.mipmaps.length;se++)Y.__webglFramebuffer[ne][se]=i.createFramebuffer()}else Y.__webglFramebuffer[ne]=i.createFramebuffer()}else{if(A.mipmaps.length>0){Y.__webglFramebuffer=[];for(let ne=0;ne<A.mipmaps.length;ne++)Y.__webglFramebuffer[ne]=i.createFramebuffer()}else Y.__webglFramebuffer=i.createFramebuffer();if(Te)for(let ne=0,se=ae.length;ne<se;ne++){let ge=n.get(ae[ne]);ge.__webglTexture===void 0&&(ge.__webglTexture=i.createTexture(),o.memory.textures++)}if(D.samples>0&&Se(D)===!1){Y.__webglMultisampledFramebuffer=i.createFramebuffer(),Y.__webglColorRenderbuffer=[],t.bindFramebuffer(i.FRAMEBUFFER,Y.__webglMultisampledFramebuffer);for(let ne=0;ne<ae.length;ne++){let se=ae[ne];Y.__webglColorRenderbuffer[ne]=i.createRenderbuffer(),i.bindRenderbuffer(i.RENDERBUFFER,Y.__webglColorRenderbuffer[ne]);let ge=r.convert(se.format,se.colorSpace),z=r.convert(se.type),re=M(se.internalFormat,ge,z,se.normalized,se.colorSpace,D.isXRRenderTarget===!0),ie=ft(D);i.renderbufferStorageMultisample(i.RENDERBUFFER,ie,re,D.width,D.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ne,i.RENDERBUFFER,Y.__webglColorRenderbuffer[ne])}i.bindRenderbuffer(i.RENDERBUFFER,null),D.depthBuffer&&(Y.__webglDepthRenderbuffer=i.createRenderbuffer(),st(Y.__webglDepthRenderbuffer,D,!0)),t.bindFramebuffer(i.FRAMEBUFFER,null)}}if(we){t.bindTexture(i.TEXTURE_CUBE_MAP,fe.__webglTexture),lt(i.TEXTURE_CUBE_MAP,A);for(let ne=0;ne<6;ne++)if(A.mipmaps.length>0)for(let se=0;se<A.mipmaps.length;se++)Ne(Y.__webglFramebuffer[ne][se],D,A,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+ne,se);else Ne(Y.__webglFramebuffer[ne],D,A,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+ne,0);b(A)?x(i.TEXTURE_CUBE_MAP):A.mipmaps.length>0&&i.texParameteri(i.TEXTURE_CUBE_MAP,i.TEXTURE_MAX_LEVEL,A.mipmaps.length-1),t.unbindTexture()}else if(Te){for(let ne=0,se=ae.length;ne<se;ne++){let ge=ae[ne],z=n.get(ge),re=i.TEXTURE_2D;(D.isWebGL3DRenderTarget||D.isWebGLArrayRenderTarget)&&(re=D.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),t.bindTexture(re,z.__webglTexture),lt(re,ge),Ne(Y.__webglFramebuffer,D,ge,i.COLOR_ATTACHMENT0+ne,re,0),b(ge)&&x(re)}t.unbindTexture()}else{let ne=i.TEXTURE_2D;if((D.isWebGL3DRenderTarget||D.isWebGLArrayRenderTarget)&&(ne=D.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),t.bindTexture(ne,fe.__webglTexture),lt(ne,A),A.mipmaps.length>0)for(let se=0;se<A.mipmaps.length;se++)Ne(Y.__webglFramebuffer[se],D,A,i.COLOR_ATTACHMENT0,ne,se);else Ne(Y.__webglFramebuffer,D,A,i.COLOR_ATTACHMENT0,ne,0);b(A)?x(ne):A.mipmaps.length>0&&i.texParameteri(ne,i.TEXTURE_MAX_LEVEL,A.mipmaps.length-1),t.unbindTexture()}D.depthBuffer&&xt(D)}function B(D){let A=D.textures;for(let Y=0,fe=A.length;Y<fe;Y++){let ae=A[Y];if(b(ae)&&ae.mipmapsAutoUpdate===!0){let we=T(D),Te=n.get(ae).__webglTexture;t.bindTexture(we,Te),x(we),t.unbindTexture()}}}let Ee=[];function Xe(D){if(D.samples>0){if(Se(D)===!1){let A=D.textures,Y=D.width,fe=D.height,ae=i.COLOR_BUFFER_BIT,we=D.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,Te=n.get(D),ne=A.length>1;if(ne)for(let ge=0;ge<A.length;ge++)t.bindFramebuffer(i.FRAMEBUFFER,Te.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ge,i.RENDERBUFFER,null),t.bindFramebuffer(i.FRAMEBUFFER,Te.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+ge,i.TEXTURE_2D,null,0);t.bindFramebuffer(i.READ_FRAMEBUFFER,Te.__webglMultisampledFramebuffer),D.texture.mipmaps.length>0?t.bindFramebuffer(i.DRAW_FRAMEBUFFER,Te.__webglFramebuffer[0]):t.bindFramebuffer(i.DRAW_FRAMEBUFFER,Te.__webglFramebuffer);for(let ge=0;ge<A.length;ge++){if(D.resolveDepthBuffer&&(D.depthBuffer&&(ae|=i.DEPTH_BUFFER_BIT),D.stencilBuffer&&D.resolveStencilBuffer&&(ae|=i.STENCIL_BUFFER_BIT)),ne){i.framebufferRenderbuffer(i.READ_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.RENDERBUFFER,Te.__webglColorRenderbuffer[ge]);let z=n.get(A[ge]).__webglTexture;i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,z,0)}i.blitFramebuffer(0,0,Y,fe,0,0,Y,fe,ae,i.NEAREST),l===!0&&(Ee.length=0,Ee.push(i.COLOR_ATTACHMENT0+ge),D.depthBuffer&&D.storeMultisampledDepthBuffer===!1&&Ee.push(we),i.invalidateFramebuffer(i.READ_FRAMEBUFFER,Ee))}if(t.bindFramebuffer(i.READ_FRAMEBUFFER,null),t.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),ne)for(let ge=0;ge<A.length;ge++){t.bindFramebuffer(i.FRAMEBUFFER,Te.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ge,i.RENDERBUFFER,Te.__webglColorRenderbuffer[ge]);let z=n.get(A[ge]).__webglTexture;t.bindFramebuffer(i.FRAMEBUFFER,Te.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+ge,i.TEXTURE_2D,z,0)}t.bindFramebuffer(i.DRAW_FRAMEBUFFER,Te.__webglMultisampledFramebuffer)}else if(D.depthBuffer&&D.storeMultisampledDepthBuffer===!1&&l){let A=D.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,[A])}}}function ft(D){return Math.min(s.maxSamples,D.samples)}function Se(D){let A=n.get(D);return D.samples>0&&e.has("WEBGL_multisampled_render_to_texture")===!0&&A.__useRenderToTexture!==!1}function zt(D){let A=o.render.frame;h.get(D)!==A&&(h.set(D,A),D.update())}function $e(D,A){let Y=D.colorSpace,fe=D.format,ae=D.type;return D.isCompressedTexture===!0||D.isVideoTexture===!0||Y!==Na&&Y!==Ys&&(Ct.getTransfer(Y)===Vt?(fe!==Ti||ae!==yi)&&it("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):ht("WebGLTextures: Unsupported texture color space:",Y)),A}function tt(D){return typeof HTMLImageElement<"u"&&D instanceof HTMLImageElement?(c.width=D.naturalWidth||D.width,c.height=D.naturalHeight||D.height):typeof VideoFrame<"u"&&D instanceof VideoFrame?(c.width=D.displayWidth,c.height=D.displayHeight):(c.width=D.width,c.height=D.height),c}this.allocateTextureUnit=he,this.resetTextureUnits=Q,this.getTextureUnits=te,this.setTextureUnits=pe,this.setTexture2D=ye,this.setTexture2DArray=xe,this.setTexture3D=Le,this.setTextureCube=Me,this.rebindTextures=gt,this.setupRenderTarget=bt,this.updateRenderTargetMipmap=B,this.updateMultisampleRenderTarget=Xe,this.setupDepthRenderbuffer=xt,this.setupFrameBufferTexture=Ne,this.useMultisampledRTT=Se,this.dispose=k}function J1(i,e){function t(n,s=Ys){let r,o=Ct.getTransfer(s);if(n===yi)return i.UNSIGNED_BYTE;if(n===Th)return i.UNSIGNED_SHORT_4_4_4_4;if(n===Ah)return i.UNSIGNED_SHORT_5_5_5_1;if(n===sp)return i.UNSIGNED_INT_5_9_9_9_REV;if(n===rp)return i.UNSIGNED_INT_10F_11F_11F_REV;if(n===np)return i.BYTE;if(n===ip)return i.SHORT;if(n===Wo)return i.UNSIGNED_SHORT;if(n===Sh)return i.INT;if(n===zi)return i.UNSIGNED_INT;if(n===pi)return i.FLOAT;if(n===Qi)return i.HALF_FLOAT;if(n===op)return i.ALPHA;if(n===ap)return i.RGB;if(n===Ti)return i.RGBA;if(n===ks)return i.DEPTH_COMPONENT;if(n===qs)return i.DEPTH_STENCIL;if(n===Rh)return i.RED;if(n===_l)return i.RED_INTEGER;if(n===xr)return i.RG;if(n===Ch)return i.RG_INTEGER;if(n===Ph)return i.RGBA_INTEGER;if(n===bl||n===El||n===wl||n===Ml)if(o===Vt)if(r=e.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(n===bl)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===El)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===wl)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===Ml)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=e.get("WEBGL_compressed_texture_s3tc"),r!==null){if(n===bl)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===El)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===wl)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===Ml)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===Ih||n===Lh||n===Nh||n===Dh)if(r=e.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(n===Ih)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===Lh)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===Nh)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===Dh)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===Fh||n===Oh||n===Uh||n===kh||n===Bh||n===Sl||n===Hh)if(r=e.get("WEBGL_compressed_texture_etc"),r!==null){if(n===Fh||n===Oh)return o===Vt?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(n===Uh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(n===kh)return r.COMPRESSED_R11_EAC;if(n===Bh)return r.COMPRESSED_SIGNED_R11_EAC;if(n===Sl)return r.COMPRESSED_RG11_EAC;if(n===Hh)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(n===zh||n===Vh||n===Gh||n===Wh||n===Xh||n===qh||n===Yh||n===$h||n===jh||n===Zh||n===Jh||n===Kh||n===Qh||n===eu)if(r=e.get("WEBGL_compressed_texture_astc"),r!==null){if(n===zh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===Vh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===Gh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===Wh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===Xh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===qh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===Yh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===$h)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===jh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===Zh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===Jh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===Kh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===Qh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===eu)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===tu||n===nu||n===iu)if(r=e.get("EXT_texture_compression_bptc"),r!==null){if(n===tu)return o===Vt?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===nu)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===iu)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===su||n===ru||n===Tl||n===ou)if(r=e.get("EXT_texture_compression_rgtc"),r!==null){if(n===su)return r.COMPRESSED_RED_RGTC1_EXT;if(n===ru)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===Tl)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===ou)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===Br?i.UNSIGNED_INT_24_8:i[n]!==void 0?i[n]:null}return{convert:t}}var K1=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,Q1=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,Pp=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(e,t){if(this.texture===null){let n=new qa(e.texture);(e.depthNear!==t.depthNear||e.depthFar!==t.depthFar)&&(this.depthNear=e.depthNear,this.depthFar=e.depthFar),this.texture=n}}getMesh(e){if(this.texture!==null&&this.mesh===null){let t=e.cameras[0].viewport,n=new Bi({vertexShader:K1,fragmentShader:Q1,uniforms:{depthColor:{value:this.texture},depthWidth:{value:t.z},depthHeight:{value:t.w}}});this.mesh=new wt(new Vs(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},Ip=class extends Ji{constructor(e,t){super();let n=this,s=null,r=1,o=null,a="local-floor",l=1,c=null,h=null,u=null,d=null,f=null,p=null,v=typeof XRWebGLBinding<"u",g=new Pp,m={},y=t.getContextAttributes(),b=null,x=null,T=[],M=[],_=new ue,w=null,N=null,P=new ri;P.viewport=new Gt;let I=new ri;I.viewport=new Gt;let U=[P,I],H=new bh,L=null,k=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(ee){let ye=T[ee];return ye===void 0&&(ye=new Do,T[ee]=ye),ye.getTargetRaySpace()},this.getControllerGrip=function(ee){let ye=T[ee];return ye===void 0&&(ye=new Do,T[ee]=ye),ye.getGripSpace()},this.getHand=function(ee){let ye=T[ee];return ye===void 0&&(ye=new Do,T[ee]=ye),ye.getHandSpace()};function q(ee){let ye=M.indexOf(ee.inputSource);if(ye===-1)return;let xe=T[ye];xe!==void 0&&(xe.update(ee.inputSource,ee.frame,c||o),xe.dispatchEvent({type:ee.type,data:ee.inputSource}))}function V(){s.removeEventListener("select",q),s.removeEventListener("selectstart",q),s.removeEventListener("selectend",q),s.removeEventListener("squeeze",q),s.removeEventListener("squeezestart",q),s.removeEventListener("squeezeend",q),s.removeEventListener("end",V),s.removeEventListener("inputsourceschange",ce);for(let ee=0;ee<T.length;ee++){let ye=M[ee];ye!==null&&(M[ee]=null,T[ee].disconnect(ye))}L=null,k=null,g.reset();for(let ee in m)delete m[ee];if(e.setRenderTarget(b),f=null,d=null,u=null,s=null,x=null,he.stop(),n.isPresenting=!1,e.setPixelRatio(w),e.setSize(_.width,_.height,!1),N!==null){let ee=N.camera;ee.fov=N.fov,ee.zoom=N.zoom,ee.updateProjectionMatrix(),N=null}n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(ee){r=ee,n.isPresenting===!0&&it("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(ee){a=ee,n.isPresenting===!0&&it("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(ee){c=ee},this.getBaseLayer=function(){return d!==null?d:f},this.getBinding=function(){return u===null&&v&&(u=new XRWebGLBinding(s,t)),u},this.getFrame=function(){return p},this.getSession=function(){return s},this.setSession=async function(ee){if(s=ee,s!==null){if(b=e.getRenderTarget(),s.addEventListener("select",q),s.addEventListener("selectstart",q),s.addEventListener("selectend",q),s.addEventListener("squeeze",q),s.addEventListener("squeezestart",q),s.addEventListener("squeezeend",q),s.addEventListener("end",V),s.addEventListener("inputsourceschange",ce),y.xrCompatible!==!0&&await t.makeXRCompatible(),w=e.getPixelRatio(),e.getSize(_),v&&"createProjectionLayer"in XRWebGLBinding.prototype){let xe=null,Le=null,Me=null;y.depth&&(Me=y.stencil?t.DEPTH24_STENCIL8:t.DEPTH_COMPONENT24,xe=y.stencil?qs:ks,Le=y.stencil?Br:zi);let Ve={colorFormat:t.RGBA8,depthFormat:Me,scaleFactor:r};u=this.getBinding(),d=u.createProjectionLayer(Ve),s.updateRenderState({layers:[d]}),e.setPixelRatio(1),e.setSize(d.textureWidth,d.textureHeight,!1),x=new Ai(d.textureWidth,d.textureHeight,{format:Ti,type:yi,depthTexture:new zs(d.textureWidth,d.textureHeight,Le,void 0,void 0,void 0,void 0,void 0,void 0,xe),stencilBuffer:y.stencil,colorSpace:e.outputColorSpace,samples:y.antialias?4:0,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}else{let xe={antialias:y.antialias,alpha:!0,depth:y.depth,stencil:y.stencil,framebufferScaleFactor:r};f=new XRWebGLLayer(s,t,xe),s.updateRenderState({baseLayer:f}),e.setPixelRatio(1),e.setSize(f.framebufferWidth,f.framebufferHeight,!1),x=new Ai(f.framebufferWidth,f.framebufferHeight,{format:Ti,type:yi,colorSpace:e.outputColorSpace,stencilBuffer:y.stencil,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}x.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await s.requestReferenceSpace(a),he.setContext(s),he.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return g.getDepthTexture()};function ce(ee){for(let ye=0;ye<ee.removed.length;ye++){let xe=ee.removed[ye],Le=M.indexOf(xe);Le>=0&&(M[Le]=null,T[Le].disconnect(xe))}for(let ye=0;ye<ee.added.length;ye++){let xe=ee.added[ye],Le=M.indexOf(xe);if(Le===-1){for(let Ve=0;Ve<T.length;Ve++)if(Ve>=M.length){M.push(xe),Le=Ve;break}else if(M[Ve]===null){M[Ve]=xe,Le=Ve;break}if(Le===-1)break}let Me=T[Le];Me&&Me.connect(xe)}}function Z(ee,ye){ye===null?ee.matrixWorld.copy(ee.matrix):ee.matrixWorld.multiplyMatrices(ye.matrixWorld,ee.matrix),ee.matrixWorldInverse.copy(ee.matrixWorld).invert()}this.updateCamera=function(ee){if(s===null)return;let ye=ee.near,xe=ee.far;g.texture!==null&&(g.depthNear>0&&(ye=g.depthNear),g.depthFar>0&&(xe=g.depthFar)),H.near=I.near=P.near=ye,H.far=I.far=P.far=xe,(L!==H.near||k!==H.far)&&(s.updateRenderState({depthNear:H.near,depthFar:H.far}),L=H.near,k=H.far),H.layers.mask=ee.layers.mask|6,P.layers.mask=H.layers.mask&-5,I.layers.mask=H.layers.mask&-3;let Le=ee.parent,Me=H.cameras;Z(H,Le);for(let Ve=0;Ve<Me.length;Ve++)Z(Me[Ve],Le);H.projectionMatrix.copy(P.projectionMatrix),H.projectionMatrixInverse.copy(P.projectionMatrixInverse),N===null&&ee.isPerspectiveCamera&&(N={camera:ee,fov:ee.fov,zoom:ee.zoom}),Q(ee,H,Le)};function Q(ee,ye,xe){xe===null?ee.matrix.copy(ye.matrixWorld):(ee.matrix.copy(xe.matrixWorld),ee.matrix.invert(),ee.matrix.multiply(ye.matrixWorld)),ee.matrix.decompose(ee.position,ee.quaternion,ee.scale),ee.updateMatrixWorld(!0),ee.projectionMatrix.copy(ye.projectionMatrix),ee.projectionMatrixInverse.copy(ye.projectionMatrixInverse),ee.isPerspectiveCamera&&(ee.fov=Io*2*Math.atan(1/ee.projectionMatrix.elements[5]),ee.zoom=1)}this.getCamera=function(){return H},this.getFoveation=function(){if(!(d===null&&f===null))return l},this.setFoveation=function(ee){l=ee,d!==null&&(d.fixedFoveation=ee),f!==null&&f.fixedFoveation!==void 0&&(f.fixedFoveation=ee)},this.hasDepthSensing=function(){return g.texture!==null},this.getDepthSensingMesh=function(){return g.getMesh(H)},this.getCameraTexture=function(ee){return m[ee]};let te=null;function pe(ee,ye){if(h=ye.getViewerPose(c||o),p=ye,h!==null){let xe=h.views;f!==null&&(e.setRenderTargetFramebuffer(x,f.framebuffer),e.setRenderTarget(x));let Le=!1;xe.length!==H.cameras.length&&(H.cameras.length=0,Le=!0);for(let Ze=0;Ze<xe.length;Ze++){let lt=xe[Ze],rt=null;if(f!==null)rt=f.getViewport(lt);else{let _e=u.getViewSubImage(d,lt);rt=_e.viewport,Ze===0&&(e.setRenderTargetTextures(x,_e.colorTexture,_e.depthStencilTexture),e.setRenderTarget(x))}let oe=U[Ze];oe===void 0&&(oe=new ri,oe.layers.enable(Ze),oe.viewport=new Gt,U[Ze]=oe),oe.matrix.fromArray(lt.transform.matrix),oe.matrix.decompose(oe.position,oe.quaternion,oe.scale),oe.projectionMatrix.fromArray(lt.projectionMatrix),oe.projectionMatrixInverse.copy(oe.projectionMatrix).invert(),oe.viewport.set(rt.x,rt.y,rt.width,rt.height),Ze===0&&(H.matrix.copy(oe.matrix),H.matrix.decompose(H.position,H.quaternion,H.scale)),Le===!0&&H.cameras.push(oe)}let Me=s.enabledFeatures;if(Me&&Me.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&v){u=n.getBinding();let Ze=u.getDepthInformation(xe[0]);Ze&&Ze.isValid&&Ze.texture&&g.init(Ze,s.renderState)}if(Me&&Me.includes("camera-access")&&v){e.state.unbindTexture(),u=n.getBinding();for(let Ze=0;Ze<xe.length;Ze++){let lt=xe[Ze].camera;if(lt){let rt=m[lt];rt||(rt=new qa,m[lt]=rt);let oe=u.getCameraImage(lt);rt.sourceTexture=oe}}}}for(let xe=0;xe<T.length;xe++){let Le=M[xe],Me=T[xe];Le!==null&&Me!==void 0&&Me.update(Le,ye,c||o)}te&&te(ee,ye),ye.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:ye}),p=null}let he=new wy;he.setAnimationLoop(pe),this.setAnimationLoop=function(ee){te=ee},this.dispose=function(){}}},eA=new Qe,Ny=new yt;Ny.set(-1,0,0,0,1,0,0,0,1);function tA(i,e){function t(g,m){g.matrixAutoUpdate===!0&&g.updateMatrix(),m.value.copy(g.matrix)}function n(g,m){m.color.getRGB(g.fogColor.value,vp(i)),m.isFog?(g.fogNear.value=m.near,g.fogFar.value=m.far):m.isFogExp2&&(g.fogDensity.value=m.density)}function s(g,m,y,b,x){m.isNodeMaterial?m.uniformsNeedUpdate=!1:m.isMeshBasicMaterial?r(g,m):m.isMeshLambertMaterial?(r(g,m),m.envMap&&(g.envMapIntensity.value=m.envMapIntensity)):m.isMeshToonMaterial?(r(g,m),u(g,m)):m.isMeshPhongMaterial?(r(g,m),h(g,m),m.envMap&&(g.envMapIntensity.value=m.envMapIntensity)):m.isMeshStandardMaterial?(r(g,m),d(g,m),m.isMeshPhysicalMaterial&&f(g,m,x)):m.isMeshMatcapMaterial?(r(g,m),p(g,m)):m.isMeshDepthMaterial?r(g,m):m.isMeshDistanceMaterial?(r(g,m),v(g,m)):m.isMeshNormalMaterial?r(g,m):m.isLineBasicMaterial?(o(g,m),m.isLineDashedMaterial&&a(g,m)):m.isPointsMaterial?l(g,m,y,b):m.isSpriteMaterial?c(g,m):m.isShadowMaterial?(g.color.value.copy(m.color),g.opacity.value=m.opacity):m.isShaderMaterial&&(m.uniformsNeedUpdate=!1)}function r(g,m){g.opacity.value=m.opacity,m.color&&g.diffuse.value.copy(m.color),m.emissive&&g.emissive.value.copy(m.emissive).multiplyScalar(m.emissiveIntensity),m.map&&(g.map.value=m.map,t(m.map,g.mapTransform)),m.alphaMap&&(g.alphaMap.value=m.alphaMap,t(m.alphaMap,g.alphaMapTransform)),m.bumpMap&&(g.bumpMap.value=m.bumpMap,t(m.bumpMap,g.bumpMapTransform),g.bumpScale.value=m.bumpScale,m.side===li&&(g.bumpScale.value*=-1)),m.normalMap&&(g.normalMap.value=m.normalMap,t(m.normalMap,g.normalMapTransform),g.normalScale.value.copy(m.normalScale),m.side===li&&g.normalScale.value.negate()),m.displacementMap&&(g.displacementMap.value=m.displacementMap,t(m.displacementMap,g.displacementMapTransform),g.displacementScale.value=m.displacementScale,g.displacementBias.value=m.displacementBias),m.emissiveMap&&(g.emissiveMap.value=m.emissiveMap,t(m.emissiveMap,g.emissiveMapTransform)),m.specularMap&&(g.specularMap.value=m.specularMap,t(m.specularMap,g.specularMapTransform)),m.alphaTest>0&&(g.alphaTest.value=m.alphaTest);let y=e.get(m),b=y.envMap,x=y.envMapRotation;b&&(g.envMap.value=b,g.envMapRotation.value.setFromMatrix4(eA.makeRotationFromEuler(x)).transpose(),b.isCubeTexture&&b.isRenderTargetTexture===!1&&g.envMapRotation.value.premultiply(Ny),g.reflectivity.value=m.reflectivity,g.ior.value=m.ior,g.refractionRatio.value=m.refractionRatio),m.lightMap&&(g.lightMap.value=m.lightMap,g.lightMapIntensity.value=m.lightMapIntensity,t(m.lightMap,g.lightMapTransform)),m.aoMap&&(g.aoMap.value=m.aoMap,g.aoMapIntensity.value=m.aoMapIntensity,t(m.aoMap,g.aoMapTransform))}function o(g,m){g.diffuse.value.copy(m.color),g.opacity.value=m.opacity,m.map&&(g.map.value=m.map,t(m.map,g.mapTransform))}function a(g,m){g.dashSize.value=m.dashSize,g.totalSize.value=m.dashSize+m.gapSize,g.scale.value=m.scale}function l(g,m,y,b){g.diffuse.value.copy(m.color),g.opacity.value=m.opacity,g.size.value=m.size*y,g.scale.value=b*.5,m.map&&(g.map.value=m.map,t(m.map,g.uvTransform)),m.alphaMap&&(g.alphaMap.value=m.alphaMap,t(m.alphaMap,g.alphaMapTransform)),m.alphaTest>0&&(g.alphaTest.value=m.alphaTest)}function c(g,m){g.diffuse.value.copy(m.color),g.opacity.value=m.opacity,g.rotation.value=m.rotation,m.map&&(g.map.value=m.map,t(m.map,g.mapTransform)),m.alphaMap&&(g.alphaMap.value=m.alphaMap,t(m.alphaMap,g.alphaMapTransform)),m.alphaTest>0&&(g.alphaTest.value=m.alphaTest)}function h(g,m){g.specular.value.copy(m.specular),g.shininess.value=Math.max(m.shininess,1e-4)}function u(g,m){m.gradientMap&&(g.gradientMap.value=m.gradientMap)}function d(g,m){g.metalness.value=m.metalness,m.metalnessMap&&(g.metalnessMap.value=m.metalnessMap,t(m.metalnessMap,g.metalnessMapTransform)),g.roughness.value=m.roughness,m.roughnessMap&&(g.roughnessMap.value=m.roughnessMap,t(m.roughnessMap,g.roughnessMapTransform)),m.envMap&&(g.envMapIntensity.value=m.envMapIntensity)}function f(g,m,y){g.ior.value=m.ior,m.diffuseRoughness>0&&(g.diffuseRoughness.value=m.diffuseRoughness,m.diffuseRoughnessMap&&(g.diffuseRoughnessMap.value=m.diffuseRoughnessMap,t(m.diffuseRoughnessMap,g.diffuseRoughnessMapTransform))),m.sheen>0&&(g.sheenColor.value.copy(m.sheenColor).multiplyScalar(m.sheen),g.sheenRoughness.value=m.sheenRoughness,m.sheenColorMap&&(g.sheenColorMap.value=m.sheenColorMap,t(m.sheenColorMap,g.sheenColorMapTransform)),m.sheenRoughnessMap&&(g.sheenRoughnessMap.value=m.sheenRoughnessMap,t(m.sheenRoughnessMap,g.sheenRoughnessMapTransform))),m.clearcoat>0&&(g.clearcoat.value=m.clearcoat,g.clearcoatRoughness.value=m.clearcoatRoughness,m.clearcoatMap&&(g.clearcoatMap.value=m.clearcoatMap,t(m.clearcoatMap,g.clearcoatMapTransform)),m.clearcoatRoughnessMap&&(g.clearcoatRoughnessMap.value=m.clearcoatRoughnessMap,t(m.clearcoatRoughnessMap,g.clearcoatRoughnessMapTransform)),m.clearcoatNormalMap&&(g.clearcoatNormalMap.value=m.clearcoatNormalMap,t(m.clearcoatNormalMap,g.clearcoatNormalMapTransform),g.clearcoatNormalScale.value.copy(m.clearcoatNormalScale),m.side===li&&g.clearcoatNormalScale.value.negate())),m.dispersion>0&&(g.dispersion.value=m.dispersion),m.retroreflectivity>0&&(g.retroreflectivity.value=m.retroreflectivity),m.iridescence>0&&(g.iridescence.value=m.iridescence,g.iridescenceIOR.value=m.iridescenceIOR,g.iridescenceThicknessMinimum.value=m.iridescenceThicknessMinimum,g.iridescenceThicknessMaximum.value=m.iridescenceThicknessMaximum,m.iridescenceMap&&(g.iridescenceMap.value=m.iridescenceMap,t(m.iridescenceMap,g.iridescenceMapTransform)),m.iridescenceThicknessMap&&(g.iridescenceThicknessMap.value=m.iridescenceThicknessMap,t(m.iridescenceThicknessMap,g.iridescenceThicknessMapTransform))),m.transmission>0&&(g.transmission.value=m.transmission,g.transmissionSamplerMap.value=y.texture,g.transmissionSamplerSize.value.set(y.width,y.height),m.transmissionMap&&(g.transmissionMap.value=m.transmissionMap,t(m.transmissionMap,g.transmissionMapTransform)),g.thickness.value=m.thickness,m.thicknessMap&&(g.thicknessMap.value=m.thicknessMap,t(m.thicknessMap,g.thicknessMapTransform)),g.attenuationDistance.value=m.attenuationDistance,g.attenuationColor.value.copy(m.attenuationColor)),m.anisotropy>0&&(g.anisotropyVector.value.set(m.anisotropy*Math.cos(m.anisotropyRotation),m.anisotropy*Math.sin(m.anisotropyRotation)),m.anisotropyMap&&(g.anisotropyMap.value=m.anisotropyMap,t(m.anisotropyMap,g.anisotropyMapTransform))),g.specularIntensity.value=m.specularIntensity,g.specularColor.value.copy(m.specularColor),m.specularColorMap&&(g.specularColorMap.value=m.specularColorMap,t(m.specularColorMap,g.specularColorMapTransform)),m.specularIntensityMap&&(g.specularIntensityMap.value=m.specularIntensityMap,t(m.specularIntensityMap,g.specularIntensityMapTransform))}function p(g,m){m.matcap&&(g.matcap.value=m.matcap)}function v(g,m){let y=e.get(m).light;g.referencePosition.value.setFromMatrixPosition(y.matrixWorld),g.nearDistance.value=y.shadow.camera.near,g.farDistance.value=y.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:s}}function nA(i,e,t,n){let s={},r={};function o(y,b){let x=b.program;n.uniformBlockBinding(y,x,s[y.id])}function a(y,b){let x=s[y.id];x===void 0&&(p(y),x=l(y),s[y.id]=x,y.addEventListener("dispose",g));let T=b.program;n.updateUBOMapping(y,T);let M=e.render.frame;r[y.id]!==M&&(c(y),r[y.id]=M)}function l(y){let b=i.createBuffer(),x=y.__size,T=y.usage;return i.bindBuffer(i.UNIFORM_BUFFER,b),i.bufferData(i.UNIFORM_BUFFER,x,T),i.bindBuffer(i.UNIFORM_BUFFER,null),b}function c(y){let b=s[y.id],x=y.uniforms,T=y.__cache;i.bindBuffer(i.UNIFORM_BUFFER,b);for(let M=0,_=x.length;M<_;M++){let w=x[M];if(Array.isArray(w))for(let N=0,P=w.length;N<P;N++)h(w[N],M,N,T);else h(w,M,0,T)}i.bindBuffer(i.UNIFORM_BUFFER,null)}function h(y,b,x,T){if(d(y,b,x,T)===!0){let M=y.__offset,_=y.value;if(Array.isArray(_)){let w=0;for(let N=0;N<_.length;N++){let P=_[N],I=v(P,!0);u(P,y.__data,w),w+=I.storage/Float32Array.BYTES_PER_ELEMENT}}else u(_,y.__data,0);i.bufferSubData(i.UNIFORM_BUFFER,M,y.__data)}}function u(y,b,x){typeof y=="number"||typeof y=="boolean"?b[x]=y:y.isMatrix3?(b[x]=y.elements[0],b[x+1]=y.elements[1],b[x+2]=y.elements[2],b[x+3]=0,b[x+4]=y.elements[3],b[x+5]=y.elements[4],b[x+6]=y.elements[5],b[x+7]=0,b[x+8]=y.elements[6],b[x+9]=y.elements[7],b[x+10]=y.elements[8],b[x+11]=0):ArrayBuffer.isView(y)?b.set(y.subarray(0,b.length-x),x):y.toArray(b,x)}function d(y,b,x,T){let M=y.value,_=b+"_"+x;if(Array.isArray(M)){T[_]===void 0&&(T[_]=[]);let w=T[_],N=!1;for(let P=0;P<M.length;P++)f(M[P],w,P)===!0&&(N=!0);return N}return f(M,T,_)}function f(y,b,x){if(b[x]===void 0)return typeof y=="number"||typeof y=="boolean"?b[x]=y:ArrayBuffer.isView(y)?b[x]=y.slice():b[x]=y.clone(),!0;{let T=b[x];if(typeof y=="number"||typeof y=="boolean"){if(T!==y)return b[x]=y,!0}else{if(ArrayBuffer.isView(y))return!0;if(T.equals(y)===!1)return T.copy(y),!0}}return!1}function p(y){let b=y.uniforms,x=0,T=16;for(let _=0,w=b.length;_<w;_++){let N=Array.isArray(b[_])?b[_]:[b[_]];for(let P=0,I=N.length;P<I;P++){let U=N[P],H=Array.isArray(U.value)?U.value:[U.value],L=Array.isArray(b[_])||Array.isArray(U.value),k=x;for(let V=0,ce=H.length;V<ce;V++){let Z=H[V],Q=v(Z,L),te=x%T,pe=te%Q.boundary,he=te+pe;x+=pe,he!==0&&T-he<Q.storage&&(x+=T-he),V===0&&(k=x),x+=Q.storage}let q=U.type==="int"?Int32Array:U.type==="uint"?Uint32Array:Float32Array;U.__data=new q((x-k)/Float32Array.BYTES_PER_ELEMENT),U.__offset=k}}let M=x%T;return M>0&&(x+=T-M),y.__size=x,y.__cache={},this}function v(y,b){let x={boundary:0,storage:0};return typeof y=="number"||typeof y=="boolean"?(x.boundary=4,x.storage=4):y.isVector2?(x.boundary=8,x.storage=8):y.isVector3||y.isColor?(x.boundary=16,x.storage=12):y.isVector4?(x.boundary=16,x.storage=16):y.isMatrix3?(x.boundary=16,x.storage=48):y.isMatrix4?(x.boundary=16,x.storage=64):y.isTexture?it("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(y)?(x.boundary=16,x.storage=y.byteLength):it("WebGLRenderer: Unsupported uniform value type.",y),b===!0&&(x.boundary=16,x.storage=Math.ceil(x.storage/16)*16),x}function g(y){let b=y.target;b.removeEventListener("dispose",g),i.deleteBuffer(s[b.id]),delete s[b.id],delete r[b.id]}function m(){for(let y in s)i.deleteBuffer(s[y]);s={},r={}}return{bind:o,update:a,dispose:m}}var iA=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),gs=null;function sA(){return gs===null&&(gs=new lr(iA,16,16,xr,Qi),gs.name="DFG_LUT",gs.minFilter=oi,gs.magFilter=oi,gs.wrapS=fs,gs.wrapT=fs,gs.generateMipmaps=!1,gs.needsUpdate=!0),gs}var uu=class{constructor(e={}){let{canvas:t=X0(),context:n=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:d=!1,outputBufferType:f=yi}=e;this.isWebGLRenderer=!0;let p;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");p=n.getContextAttributes().alpha}else p=o;let v=f,g=new Set([Ph,Ch,_l]),m=new Set([yi,zi,Wo,Br,Th,Ah]),y=new Uint32Array(4),b=new Int32Array(4),x={textures:[],min:[],max:[],resolution:[]},T=null,M=null,_=[],w=[],N=null;this.domElement=t,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=Hi,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let P=this,I=!1,U=null,H=null,L=null,k=null;this._outputColorSpace=Si;let q=0,V=0,ce=null,Z=-1,Q=null,te=new Gt,pe=new Gt,he=null,ee=new et(0),ye=0,xe=t.width,Le=t.height,Me=1,Ve=null,at=null,Ze=new Gt(0,0,xe,Le),lt=new Gt(0,0,xe,Le),rt=!1,oe=new Bs,_e=new Va,ve=!1,ke=!1,Ne=new Qe,st=new S,Be=new Gt,xt={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},gt=!1;function bt(){return ce===null?Me:1}let B=n;function Ee(C,G){return t.getContext(C,G)}let Xe,ft,Se,zt,$e,tt,D,A,Y,fe,ae,we,Te,ne,se,ge,z,re,ie,Ce,be,Re,Je;try{let C={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in t&&t.setAttribute("data-engine",`three.js r${"187"}`),t.addEventListener("webglcontextlost",qe,!1),t.addEventListener("webglcontextrestored",dt,!1),t.addEventListener("webglcontextcreationerror",De,!1),B===null){let G="webgl2";if(B=Ee(G,C),B===null)throw Ee(G)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}ut()}catch(C){throw t.removeEventListener("webglcontextlost",qe,!1),t.removeEventListener("webglcontextrestored",dt,!1),t.removeEventListener("webglcontextcreationerror",De,!1),ht("WebGLRenderer: "+C.message),C}function ut(){Xe=new mT(B),Xe.init(),be=new J1(B,Xe),ft=new sT(B,Xe,e,be),Se=new j1(B,Xe),ft.reversedDepthBuffer&&d&&Se.buffers.depth.setReversed(!0),H=B.createFramebuffer(),L=B.createFramebuffer(),k=B.createFramebuffer(),zt=new vT(B),$e=new F1,tt=new Z1(B,Xe,Se,$e,ft,be,zt),D=new pT(P),A=new _w(B),Re=new nT(B,A),Y=new gT(B,A,zt,Re),fe=new _T(B,Y,A,Re,zt),re=new xT(B,ft,tt),se=new rT($e),ae=new D1(P,D,Xe,ft,Re,se),we=new tA(P,$e),Te=new U1,ne=new G1(Xe),z=new tT(P,D,Se,fe,p,l),ge=new $1(P,fe,ft),Je=new nA(B,zt,ft,Se),ie=new iT(B,Xe,zt),Ce=new yT(B,Xe,zt),zt.programs=ae.programs,P.capabilities=ft,P.extensions=Xe,P.properties=$e,P.renderLists=Te,P.shadowMap=ge,P.state=Se,P.info=zt}v!==yi&&(N=new ET(v,t.width,t.height,a,s,r));let de=new Ip(P,B);this.xr=de,this.getContext=function(){return B},this.getContextAttributes=function(){return B.getContextAttributes()},this.forceContextLoss=function(){let C=Xe.get("WEBGL_lose_context");C&&C.loseContext()},this.forceContextRestore=function(){let C=Xe.get("WEBGL_lose_context");C&&C.restoreContext()},this.getPixelRatio=function(){return Me},this.setPixelRatio=function(C){C!==void 0&&(Me=C,this.setSize(xe,Le,!1))},this.getSize=function(C){return C.set(xe,Le)},this.setSize=function(C,G,K=!0){if(de.isPresenting){it("WebGLRenderer: Can't change size while VR device is presenting.");return}xe=C,Le=G,t.width=Math.floor(C*Me),t.height=Math.floor(G*Me),K===!0&&(t.style.width=C+"px",t.style.height=G+"px"),N!==null&&N.setSize(t.width,t.height),this.setViewport(0,0,C,G)},this.getDrawingBufferSize=function(C){return C.set(xe*Me,Le*Me).floor()},this.setDrawingBufferSize=function(C,G,K){xe=C,Le=G,Me=K,t.width=Math.floor(C*K),t.height=Math.floor(G*K),this.setViewport(0,0,C,G)},this.setEffects=function(C){if(v===yi){ht("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(C){for(let G=0;G<C.length;G++)if(C[G].isOutputPass===!0){it("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}N.setEffects(C||[])},this.getCurrentViewport=function(C){return C.copy(te)},this.getViewport=function(C){return C.copy(Ze)},this.setViewport=function(C,G,K,$){C.isVector4?Ze.set(C.x,C.y,C.z,C.w):Ze.set(C,G,K,$),Se.viewport(te.copy(Ze).multiplyScalar(bt()).round())},this.getScissor=function(C){return C.copy(lt)},this.setScissor=function(C,G,K,$){C.isVector4?lt.set(C.x,C.y,C.z,C.w):lt.set(C,G,K,$),Se.scissor(pe.copy(lt).multiplyScalar(bt()).round())},this.getScissorTest=function(){return rt},this.setScissorTest=function(C){Se.setScissorTest(rt=C)},this.setOpaqueSort=function(C){Ve=C},this.setTransparentSort=function(C){at=C},this.getClearColor=function(C){return C.copy(z.getClearColor())},this.setClearColor=function(){z.setClearColor(...arguments)},this.getClearAlpha=function(){return z.getClearAlpha()},this.setClearAlpha=function(){z.setClearAlpha(...arguments)},this.clear=function(C=!0,G=!0,K=!0){let $=0;if(C){let j=!1;if(ce!==null){let Pe=ce.texture.format;j=g.has(Pe)}if(j){let Pe=ce.texture.type,Oe=m.has(Pe),Ie=z.getClearColor(),Ue=z.getClearAlpha(),je=Ie.r,pt=Ie.g,Tt=Ie.b;Oe?(y[0]=je,y[1]=pt,y[2]=Tt,y[3]=Ue,B.clearBufferuiv(B.COLOR,0,y)):(b[0]=je,b[1]=pt,b[2]=Tt,b[3]=Ue,B.clearBufferiv(B.COLOR,0,b))}else $|=B.COLOR_BUFFER_BIT}G&&($|=B.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),K&&($|=B.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),$!==0&&B.clear($)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(C){C.setRenderer(this),U=C},this.dispose=function(){t.removeEventListener("webglcontextlost",qe,!1),t.removeEventListener("webglcontextrestored",dt,!1),t.removeEventListener("webglcontextcreationerror",De,!1),z.dispose(),Te.dispose(),ne.dispose(),tt.dispose(),$e.dispose(),D.dispose(),fe.dispose(),Y.dispose(),Re.dispose(),Je.dispose(),ae.dispose(),de.dispose(),de.removeEventListener("sessionstart",tc),de.removeEventListener("sessionend",ss),Ss.stop()};function qe(C){C.preventDefault(),Oa("WebGLRenderer: Context Lost."),I=!0}function dt(){Oa("WebGLRenderer: Context Restored."),I=!1;let C=zt.autoReset,G=ge.enabled,K=ge.autoUpdate,$=ge.needsUpdate,j=ge.type;ut(),zt.autoReset=C,ge.enabled=G,ge.autoUpdate=K,ge.needsUpdate=$,ge.type=j}function De(C){ht("WebGLRenderer: A WebGL context could not be created. Reason: ",C.statusMessage)}function _t(C){let G=C.target;G.removeEventListener("dispose",_t),Kt(G)}function Kt(C){Kn(C),$e.remove(C)}function Kn(C){let G=$e.get(C).programs;G!==void 0&&(G.forEach(function(K){ae.releaseProgram(K)}),C.isShaderMaterial&&ae.releaseShaderCache(C))}this.renderBufferDirect=function(C,G,K,$,j,Pe){G===null&&(G=xt);let Oe=j.isMesh&&j.matrixWorld.determinantAffine()<0,Ie=fa(C,G,K,$,j);Se.setMaterial($,Oe);let Ue=K.index,je=1;if($.wireframe===!0){if(Ue=Y.getWireframeAttribute(K),Ue===void 0)return;je=2}let pt=K.drawRange,Tt=K.attributes.position,Ye=pt.start*je,At=(pt.start+pt.count)*je;Pe!==null&&(Ye=Math.max(Ye,Pe.start*je),At=Math.min(At,(Pe.start+Pe.count)*je)),Ue!==null?(Ye=Math.max(Ye,0),At=Math.min(At,Ue.count)):Tt!=null&&(Ye=Math.max(Ye,0),At=Math.min(At,Tt.count));let an=At-Ye;if(an<0||an===1/0)return;Re.setup(j,$,Ie,K,Ue);let Xt,qt=ie;if(Ue!==null&&(Xt=A.get(Ue),qt=Ce,qt.setIndex(Xt)),j.isMesh)$.wireframe===!0?(Se.setLineWidth($.wireframeLinewidth*bt()),qt.setMode(B.LINES)):qt.setMode(B.TRIANGLES);else if(j.isLine){let An=$.linewidth;An===void 0&&(An=1),Se.setLineWidth(An*bt()),j.isLineSegments?qt.setMode(B.LINES):j.isLineLoop?qt.setMode(B.LINE_LOOP):qt.setMode(B.LINE_STRIP)}else j.isPoints?qt.setMode(B.POINTS):j.isSprite&&qt.setMode(B.TRIANGLES);if(j.isBatchedMesh)if(Xe.get("WEBGL_multi_draw"))qt.renderMultiDraw(j._multiDrawStarts,j._multiDrawCounts,j._multiDrawCount);else{let An=j._multiDrawStarts,Ge=j._multiDrawCounts,vn=j._multiDrawCount,Pt=Ue?A.get(Ue).bytesPerElement:1,As=$e.get($).currentProgram.getUniforms();for(let xn=0;xn<vn;xn++)As.setValue(B,"_gl_DrawID",xn),qt.render(An[xn]/Pt,Ge[xn])}else if(j.isInstancedMesh)qt.renderInstances(Ye,an,j.count);else if(K.isInstancedBufferGeometry){let An=K._maxInstanceCount!==void 0?K._maxInstanceCount:1/0,Ge=Math.min(K.instanceCount,An);qt.renderInstances(Ye,an,Ge)}else qt.render(Ye,an)};function ha(C,G,K,$){U!==null&&C.isNodeMaterial&&U.setObject($,C),ve===!0&&se.setState(C,K,!1),C.transparent===!0&&C.side===wn&&C.forceSinglePass===!1?(C.side=li,C.needsUpdate=!0,rs(C,G,$),C.side=vr,C.needsUpdate=!0,rs(C,G,$),C.side=wn):rs(C,G,$)}this.compile=function(C,G,K=null){K===null&&(K=C),U!==null&&U.renderStart(C,G,K),M=ne.get(K),M.init(G),w.push(M),K.traverseVisible(function(j){j.isLight&&j.layers.test(G.layers)&&(M.pushLight(j),j.castShadow&&M.pushShadow(j))}),C!==K&&C.traverseVisible(function(j){j.isLight&&j.layers.test(G.layers)&&(M.pushLight(j),j.castShadow&&M.pushShadow(j))}),M.setupLights(),U!==null&&U.updateLights(M.state.lightsArray),ke=this.localClippingEnabled,ve=se.init(this.clippingPlanes,ke),ve===!0&&se.setGlobalState(this.clippingPlanes,G),U!==null&&ge.render(M.state.shadowsArray,K,G);let $=new Set;return C.traverse(function(j){if(!(j.isMesh||j.isPoints||j.isLine||j.isSprite))return;let Pe=j.material;if(Pe)if(Array.isArray(Pe))for(let Oe=0;Oe<Pe.length;Oe++){let Ie=Pe[Oe];ha(Ie,K,G,j),$.add(Ie)}else ha(Pe,K,G,j),$.add(Pe)}),M=w.pop(),U!==null&&U.renderEnd(),$},this.compileAsync=function(C,G,K=null){let $=this.compile(C,G,K);return new Promise(j=>{function Pe(){if($.forEach(function(Oe){let Ue=$e.get(Oe).currentProgram;(Ue===void 0||Ue.isReady())&&$.delete(Oe)}),$.size===0){j(C);return}setTimeout(Pe,10)}Xe.get("KHR_parallel_shader_compile")!==null?Pe():setTimeout(Pe,10)})};let Kr=null;function Gd(C){Kr&&Kr(C)}function tc(){Ss.stop()}function ss(){Ss.start()}let Ss=new wy;Ss.setAnimationLoop(Gd),typeof self<"u"&&Ss.setContext(self),this.setAnimationLoop=function(C){Kr=C,de.setAnimationLoop(C),C===null?Ss.stop():Ss.start()},de.addEventListener("sessionstart",tc),de.addEventListener("sessionend",ss),this.render=function(C,G){if(G!==void 0&&G.isCamera!==!0){ht("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(I===!0)return;U!==null&&U.renderStart(C,G);let K=de.enabled===!0&&de.isPresenting===!0,$=N!==null&&(ce===null||K)&&N.begin(P,ce);if(C.matrixWorldAutoUpdate===!0&&C.updateMatrixWorld(),G.parent===null&&G.matrixWorldAutoUpdate===!0&&G.updateMatrixWorld(),de.enabled===!0&&de.isPresenting===!0&&(N===null||N.isCompositing()===!1)&&(de.cameraAutoUpdate===!0&&de.updateCamera(G),G=de.getCamera()),C.isScene===!0&&C.onBeforeRender(P,C,G,ce),M=ne.get(C,w.length),M.init(G),M.state.textureUnits=tt.getTextureUnits(),w.push(M),Ne.multiplyMatrices(G.projectionMatrix,G.matrixWorldInverse),G.isArrayCamera?_e.setFromArrayCamera(G):oe.setFromProjectionMatrix(Ne,Ui,G.reversedDepth),ke=this.localClippingEnabled,ve=se.init(this.clippingPlanes,ke),T=Te.get(C,_.length),T.init(),_.push(T),this.info.render.frame++,de.enabled===!0&&de.isPresenting===!0){let Oe=P.xr.getDepthSensingMesh();Oe!==null&&Ts(Oe,G,-1/0,P.sortObjects)}Ts(C,G,0,P.sortObjects),T.finish(),U!==null&&U.updateLights(M.state.lightsArray),P.sortObjects===!0&&T.sort(Ve,at),gt=de.enabled===!1||de.isPresenting===!1||de.hasDepthSensing()===!1,gt&&z.addToRenderList(T,C),this.info.autoReset===!0&&this.info.reset(),ve===!0&&se.beginShadows();let j=M.state.shadowsArray;if(ge.render(j,C,G),ve===!0&&se.endShadows(),($&&N.hasRenderPass())===!1){let Oe=T.opaque,Ie=T.transmissive;if(M.setupLights(),G.isArrayCamera){let Ue=G.cameras;if(Ie.length>0)for(let je=0,pt=Ue.length;je<pt;je++){let Tt=Ue[je];Xi(Oe,Ie,C,Tt)}gt&&z.render(C);for(let je=0,pt=Ue.length;je<pt;je++){let Tt=Ue[je];ua(T,C,Tt,Tt.viewport)}}else Ie.length>0&&Xi(Oe,Ie,C,G),gt&&z.render(C),ua(T,C,G)}ce!==null&&V===0&&(tt.updateMultisampleRenderTarget(ce),tt.updateRenderTargetMipmap(ce)),$&&N.end(P),C.isScene===!0&&C.onAfterRender(P,C,G),Re.resetDefaultState(),Z=-1,Q=null,w.pop(),w.length>0?(M=w[w.length-1],tt.setTextureUnits(M.state.textureUnits),ve===!0&&se.setGlobalState(P.clippingPlanes,M.state.camera)):M=null,_.pop(),_.length>0?T=_[_.length-1]:T=null,U!==null&&U.renderEnd()};function Ts(C,G,K,$){if(C.visible===!1)return;if(C.layers.test(G.layers)){if(C.isGroup)K=C.renderOrder;else if(C.isLOD)C.autoUpdate===!0&&C.update(G);else if(C.isLight)M.pushLight(C),C.castShadow&&M.pushShadow(C);else if(C.isSprite){let Oe=G.isArrayCamera?_e:oe;if(!C.frustumCulled||C.intersectsFrustum(Oe)){$&&Be.setFromMatrixPosition(C.matrixWorld).applyMatrix4(Ne);let Ie=fe.update(C),Ue=C.material;Ue.visible&&T.push(C,Ie,Ue,K,Be.z,null,G)}}else if(C.isMesh||C.isLine||C.isPoints){let Oe=G.isArrayCamera?_e:oe;if(!C.frustumCulled||C.intersectsFrustum(Oe)){let Ie=fe.update(C),Ue=C.material;if($&&(C.boundingSphere!==void 0?(C.boundingSphere===null&&C.computeBoundingSphere(),Be.copy(C.boundingSphere.center)):(Ie.boundingSphere===null&&Ie.computeBoundingSphere(),Be.copy(Ie.boundingSphere.center)),Be.applyMatrix4(C.matrixWorld).applyMatrix4(Ne)),Array.isArray(Ue)){let je=Ie.groups;for(let pt=0,Tt=je.length;pt<Tt;pt++){let Ye=je[pt],At=Ue[Ye.materialIndex];At&&At.visible&&T.push(C,Ie,At,K,Be.z,Ye,G)}}else Ue.visible&&T.push(C,Ie,Ue,K,Be.z,null,G)}}}let Pe=C.children;for(let Oe=0,Ie=Pe.length;Oe<Ie;Oe++)Ts(Pe[Oe],G,K,$)}function ua(C,G,K,$){let{opaque:j,transmissive:Pe,transparent:Oe}=C;M.setupLightsView(K),ve===!0&&se.setGlobalState(P.clippingPlanes,K),$&&Se.viewport(te.copy($)),j.length>0&&hn(j,G,K),Pe.length>0&&hn(Pe,G,K),Oe.length>0&&hn(Oe,G,K),Se.buffers.depth.setTest(!0),Se.buffers.depth.setMask(!0),Se.buffers.color.setMask(!0),Se.setPolygonOffset(!1)}function Xi(C,G,K,$){if((K.isScene===!0?K.overrideMaterial:null)!==null)return;if(M.state.transmissionRenderTarget[$.id]===void 0){let Ye=Xe.has("EXT_color_buffer_half_float")||Xe.has("EXT_color_buffer_float");M.state.transmissionRenderTarget[$.id]=new Ai(1,1,{generateMipmaps:!0,type:Ye?Qi:yi,minFilter:Xs,samples:Math.max(4,ft.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:Ct.workingColorSpace})}let Pe=M.state.transmissionRenderTarget[$.id],Oe=$.viewport||te;Pe.setSize(Oe.z*P.transmissionResolutionScale,Oe.w*P.transmissionResolutionScale);let Ie=P.getRenderTarget(),Ue=P.getActiveCubeFace(),je=P.getActiveMipmapLevel();P.setRenderTarget(Pe),P.getClearColor(ee),ye=P.getClearAlpha(),ye<1&&P.setClearColor(16777215,.5),P.clear(),gt&&z.render(K);let pt=P.toneMapping;P.toneMapping=Hi;let Tt=$.viewport;if($.viewport!==void 0&&($.viewport=void 0),M.setupLightsView($),ve===!0&&se.setGlobalState(P.clippingPlanes,$),hn(C,K,$),tt.updateMultisampleRenderTarget(Pe),tt.updateRenderTargetMipmap(Pe),Xe.has("WEBGL_multisampled_render_to_texture")===!1){let Ye=!1;for(let At=0,an=G.length;At<an;At++){let Xt=G[At],{object:qt,geometry:An,material:Ge,group:vn}=Xt;if(Ge.side===wn&&qt.layers.test($.layers)){let Pt=Ge.side;Ge.side=li,Ge.needsUpdate=!0,gn(qt,K,$,An,Ge,vn),Ge.side=Pt,Ge.needsUpdate=!0,Ye=!0}}Ye===!0&&(tt.updateMultisampleRenderTarget(Pe),tt.updateRenderTargetMipmap(Pe))}P.setRenderTarget(Ie,Ue,je),P.setClearColor(ee,ye),Tt!==void 0&&($.viewport=Tt),P.toneMapping=pt}function hn(C,G,K){let $=G.isScene===!0?G.overrideMaterial:null;for(let j=0,Pe=C.length;j<Pe;j++){let Oe=C[j],{object:Ie,geometry:Ue,group:je}=Oe,pt=Oe.material;pt.allowOverride===!0&&$!==null&&(pt=$),Ie.layers.test(K.layers)&&gn(Ie,G,K,Ue,pt,je)}}function gn(C,G,K,$,j,Pe){U!==null&&j.isNodeMaterial&&U.setObject(C,j),C.onBeforeRender(P,G,K,$,j,Pe),C.modelViewMatrix.multiplyMatrices(K.matrixWorldInverse,C.matrixWorld),C.normalMatrix.getNormalMatrix(C.modelViewMatrix),j.onBeforeRender(P,G,K,$,C,Pe),j.transparent===!0&&j.side===wn&&j.forceSinglePass===!1?(j.side=li,j.needsUpdate=!0,P.renderBufferDirect(K,G,$,j,C,Pe),j.side=vr,j.needsUpdate=!0,P.renderBufferDirect(K,G,$,j,C,Pe),j.side=wn):P.renderBufferDirect(K,G,$,j,C,Pe),C.onAfterRender(P,G,K,$,j,Pe)}function yn(C){let G=0;for(let K of C)K.texture!==null&&G++;return G}function rs(C,G,K){G.isScene!==!0&&(G=xt);let $=$e.get(C),j=M.state.lights,Pe=M.state.shadowsArray,Oe=j.state.version,Ie=ae.getParameters(C,j.state,Pe,G,K,M.state.lightProbeGridArray),Ue=ae.getProgramCacheKey(Ie),je=$.programs;$.environment=C.isMeshStandardMaterial||C.isMeshLambertMaterial||C.isMeshPhongMaterial?G.environment:null,$.fog=G.fog;let pt=C.isMeshStandardMaterial||C.isMeshLambertMaterial&&!C.envMap||C.isMeshPhongMaterial&&!C.envMap;$.envMap=D.get(C.envMap||$.environment,pt),$.envMapRotation=$.environment!==null&&C.envMap===null?G.environmentRotation:C.envMapRotation,je===void 0&&(C.addEventListener("dispose",_t),je=new Map,$.programs=je,$.programVariants=new Map);let Tt=je.get(Ue);if(Tt!==void 0){if($.currentProgram===Tt&&$.lightsStateVersion===Oe)return da(C,Ie),Tt}else Ie.uniforms=ae.getUniforms(C),U!==null&&C.isNodeMaterial&&U.build(C,K,Ie),C.onBeforeCompile(Ie,P),Tt=ae.acquireProgram(Ie,Ue),je.set(Ue,Tt),$.uniforms=Ie.uniforms;let Ye=$.uniforms;return(!C.isShaderMaterial&&!C.isRawShaderMaterial||C.clipping===!0)&&(Ye.clippingPlanes=se.uniform),da(C,Ie),$.needsLights=Ks(C),$.lightsStateVersion=Oe,$.needsLights&&(Ye.ambientLightColor.value=j.state.ambient,Ye.lightProbe.value=j.state.probe,Ye.sunLights.value=j.state.sun,Ye.sunLightShadows.value=j.state.sunShadow,Ye.directionalLights.value=j.state.directional,Ye.directionalLightShadows.value=j.state.directionalShadow,Ye.spotLights.value=j.state.spot,Ye.spotLightShadows.value=j.state.spotShadow,Ye.rectAreaLights.value=j.state.rectArea,Ye.ltc_1.value=j.state.rectAreaLTC1,Ye.ltc_2.value=j.state.rectAreaLTC2,Ye.pointLights.value=j.state.point,Ye.pointLightShadows.value=j.state.pointShadow,Ye.hemisphereLights.value=j.state.hemi,Ye.sunShadowMatrix.value=j.state.sunShadowMatrix,Ye.sunShadowCascade.value=j.state.sunShadowCascade,Ye.directionalShadowMatrix.value=j.state.directionalShadowMatrix,Ye.spotLightMatrix.value=j.state.spotLightMatrix,Ye.spotLightMap.value=j.state.spotLightMap,Ye.pointShadowMatrix.value=j.state.pointShadowMatrix),$.numLightProbeGrids=yn(M.state.lightProbeGridArray),$.currentProgram=Tt,$.uniformsList=null,Tt}function xi(C,G,K,$,j){let Pe=$e.get(C),Oe=Pe.currentProgram.id+","+$+","+j,Ie=Pe.programVariants.get(Oe);return Ie===void 0?(Ie=rs(C,G,K),Pe.programVariants.set(Oe,Ie)):(Pe.currentProgram=Ie,Pe.uniformsList=null,Pe.outputColorSpace=$,Pe.toneMapping=j),Ie}function Js(C){if(C.uniformsList===null){let G=C.currentProgram.getUniforms();C.uniformsList=Xo.seqWithValue(G.seq,C.uniforms)}return C.uniformsList}function da(C,G){let K=$e.get(C);K.outputColorSpace=G.outputColorSpace,K.batching=G.batching,K.batchingColor=G.batchingColor,K.instancing=G.instancing,K.instancingColor=G.instancingColor,K.instancingMorph=G.instancingMorph,K.skinning=G.skinning,K.morphTargets=G.morphTargets,K.morphNormals=G.morphNormals,K.morphColors=G.morphColors,K.morphTargetsCount=G.morphTargetsCount,K.numClippingPlanes=G.numClippingPlanes,K.numIntersection=G.numClipIntersection,K.vertexAlphas=G.vertexAlphas,K.vertexTangents=G.vertexTangents,K.toneMapping=G.toneMapping}function fa(C,G,K,$,j){G.isScene!==!0&&(G=xt),tt.resetTextureUnits();let Pe=G.fog,Oe=$.isMeshStandardMaterial||$.isMeshLambertMaterial||$.isMeshPhongMaterial?G.environment:null,Ie=ce===null?P.outputColorSpace:ce.isXRRenderTarget===!0?ce.texture.colorSpace:Ct.workingColorSpace,Ue=$.isMeshStandardMaterial||$.isMeshLambertMaterial&&!$.envMap||$.isMeshPhongMaterial&&!$.envMap,je=D.get($.envMap||Oe,Ue),pt=$.vertexColors===!0&&!!K.attributes.color&&K.attributes.color.itemSize===4,Tt=!!K.attributes.tangent&&(!!$.normalMap||$.anisotropy>0),Ye=!!K.morphAttributes.position,At=!!K.morphAttributes.normal,an=!!K.morphAttributes.color,Xt=Hi;$.toneMapped&&(ce===null||ce.isXRRenderTarget===!0)&&(Xt=P.toneMapping);let qt=K.morphAttributes.position||K.morphAttributes.normal||K.morphAttributes.color,An=qt!==void 0?qt.length:0,Ge=$e.get($),vn=M.state.lights;if(ve===!0&&(ke===!0||C!==Q)){let Yt=C===Q&&$.id===Z;se.setState($,C,Yt)}let Pt=!1,As=!1;$.version===Ge.__version?Ge.needsLights&&Ge.lightsStateVersion!==vn.state.version||j.isBatchedMesh&&Ge.batching===!1||!j.isBatchedMesh&&Ge.batching===!0||j.isBatchedMesh&&Ge.batchingColor===!0&&j._colorsTexture===null||j.isBatchedMesh&&Ge.batchingColor===!1&&j._colorsTexture!==null||j.isInstancedMesh&&Ge.instancing===!1||!j.isInstancedMesh&&Ge.instancing===!0||j.isSkinnedMesh&&Ge.skinning===!1||!j.isSkinnedMesh&&Ge.skinning===!0||j.isInstancedMesh&&Ge.instancingColor===!0&&j.instanceColor===null||j.isInstancedMesh&&Ge.instancingColor===!1&&j.instanceColor!==null||j.isInstancedMesh&&Ge.instancingMorph===!0&&j.morphTexture===null||j.isInstancedMesh&&Ge.instancingMorph===!1&&j.morphTexture!==null||Ge.envMap!==je||$.fog===!0&&Ge.fog!==Pe||Ge.numClippingPlanes!==void 0&&(Ge.numClippingPlanes!==se.numPlanes||Ge.numIntersection!==se.numIntersection)||Ge.vertexAlphas!==pt||Ge.vertexTangents!==Tt||Ge.morphTargets!==Ye||Ge.morphNormals!==At||Ge.morphColors!==an||Ge.morphTargetsCount!==An||Ge.numLightProbeGrids!==yn(M.state.lightProbeGridArray)?Pt=!0:(Ge.outputColorSpace!==Ie||Ge.toneMapping!==Xt)&&(As=!0):(Pt=!0,Ge.__version=$.version);let xn=Ge.currentProgram;(Pt===!0||As===!0)&&(xn=As===!0?xi($,G,j,Ie,Xt):rs($,G,j),U&&$.isNodeMaterial&&U.onUpdateProgram($,xn,Ge));let to=!1,os=!1,Rs=!1,Et=xn.getUniforms(),un=Ge.uniforms;if(Se.useProgram(xn.program)&&(to=!0,os=!0,Rs=!0),$.id!==Z&&(Z=$.id,os=!0),to||Q!==C){Se.buffers.depth.getReversed()&&C.reversedDepth!==!0&&(C._reversedDepth=!0,C.updateProjectionMatrix()),Et.setValue(B,"projectionMatrix",C.projectionMatrix),Et.setValue(B,"viewMatrix",C.matrixWorldInverse);let _n=Et.map.cameraPosition;_n!==void 0&&_n.setValue(B,st.setFromMatrixPosition(C.matrixWorld)),ft.logarithmicDepthBuffer&&Et.setValue(B,"logDepthBufFC",2/(Math.log(C.far+1)/Math.LN2)),($.isMeshPhongMaterial||$.isMeshToonMaterial||$.isMeshLambertMaterial||$.isMeshBasicMaterial||$.isMeshStandardMaterial||$.isShaderMaterial)&&Et.setValue(B,"isOrthographic",C.isOrthographicCamera===!0),Q!==C&&(Q=C,os=!0,Rs=!0)}if(Ge.needsLights&&(vn.state.sunShadowMap.length>0&&Et.setValue(B,"sunShadowMap",vn.state.sunShadowMap,tt),vn.state.directionalShadowMap.length>0&&Et.setValue(B,"directionalShadowMap",vn.state.directionalShadowMap,tt),vn.state.spotShadowMap.length>0&&Et.setValue(B,"spotShadowMap",vn.state.spotShadowMap,tt),vn.state.pointShadowMap.length>0&&Et.setValue(B,"pointShadowMap",vn.state.pointShadowMap,tt)),j.isSkinnedMesh){Et.setOptional(B,j,"bindMatrix"),Et.setOptional(B,j,"bindMatrixInverse");let Yt=j.skeleton;Yt&&(Yt.boneTexture===null&&Yt.computeBoneTexture(),Et.setValue(B,"boneTexture",Yt.boneTexture,tt))}j.isBatchedMesh&&(Et.setOptional(B,j,"batchingTexture"),Et.setValue(B,"batchingTexture",j._matricesTexture,tt),Et.setOptional(B,j,"batchingIdTexture"),Et.setValue(B,"batchingIdTexture",j._indirectTexture,tt),Et.setOptional(B,j,"batchingColorTexture"),j._colorsTexture!==null&&Et.setValue(B,"batchingColorTexture",j._colorsTexture,tt));let Qn=K.morphAttributes;if((Qn.position!==void 0||Qn.normal!==void 0||Qn.color!==void 0)&&re.update(j,K,xn),(os||Ge.receiveShadow!==j.receiveShadow)&&(Ge.receiveShadow=j.receiveShadow,Et.setValue(B,"receiveShadow",j.receiveShadow)),($.isMeshStandardMaterial||$.isMeshLambertMaterial||$.isMeshPhongMaterial)&&$.envMap===null&&G.environment!==null&&(un.envMapIntensity.value=G.environmentIntensity),un.dfgLUT!==void 0&&(un.dfgLUT.value=sA()),os){if(Et.setValue(B,"toneMappingExposure",P.toneMappingExposure),Ge.needsLights&&Qr(un,Rs),Pe&&$.fog===!0&&we.refreshFogUniforms(un,Pe),we.refreshMaterialUniforms(un,$,Me,Le,M.state.transmissionRenderTarget[C.id]),Ge.needsLights&&Ge.numLightProbeGrids>0){let Yt=x,_n=0;for(let qn of M.state.lightProbeGridArray)qn.texture!==null&&(Yt.textures[_n]=qn.texture,Yt.min[_n]=qn.boundingBox.min,Yt.max[_n]=qn.boundingBox.max,Yt.resolution[_n]=qn.resolution,_n++);for(let qn in Yt)Yt[qn].length=_n;un.probesSH.value=Yt.textures,un.probesMin.value=Yt.min,un.probesMax.value=Yt.max,un.probesResolution.value=Yt.resolution}Xo.upload(B,Js(Ge),un,tt)}if($.isShaderMaterial&&$.uniformsNeedUpdate===!0&&(Xo.upload(B,Js(Ge),un,tt),$.uniformsNeedUpdate=!1),$.isSpriteMaterial&&Et.setValue(B,"center",j.center),Et.setValue(B,"modelViewMatrix",j.modelViewMatrix),Et.setValue(B,"normalMatrix",j.normalMatrix),Et.setValue(B,"modelMatrix",j.matrixWorld),$.uniformsGroups!==void 0){let Yt=$.uniformsGroups;for(let _n=0,qn=Yt.length;_n<qn;_n++){let nc=Yt[_n];Je.update(nc,xn),Je.bind(nc,xn)}}return xn}function Qr(C,G){C.ambientLightColor.needsUpdate=G,C.lightProbe.needsUpdate=G,C.sunLights.needsUpdate=G,C.sunLightShadows.needsUpdate=G,C.directionalLights.needsUpdate=G,C.directionalLightShadows.needsUpdate=G,C.pointLights.needsUpdate=G,C.pointLightShadows.needsUpdate=G,C.spotLights.needsUpdate=G,C.spotLightShadows.needsUpdate=G,C.rectAreaLights.needsUpdate=G,C.hemisphereLights.needsUpdate=G}function Ks(C){return C.isMeshLambertMaterial||C.isMeshToonMaterial||C.isMeshPhongMaterial||C.isMeshStandardMaterial||C.isShadowMaterial||C.isShaderMaterial&&C.lights===!0}this.getActiveCubeFace=function(){return q},this.getActiveMipmapLevel=function(){return V},this.getRenderTarget=function(){return ce},this.setRenderTargetTextures=function(C,G,K){let $=$e.get(C);$.__autoAllocateDepthBuffer=C.resolveDepthBuffer===!1,$.__autoAllocateDepthBuffer===!1&&($.__useRenderToTexture=!1),$e.get(C.texture).__webglTexture=G,$e.get(C.depthTexture).__webglTexture=$.__autoAllocateDepthBuffer?void 0:K,$.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(C,G){let K=$e.get(C);K.__webglFramebuffer=G,K.__useDefaultFramebuffer=G===void 0},this.setRenderTarget=function(C,G=0,K=0){ce=C,q=G,V=K;let $=null,j=!1,Pe=!1;if(C){let Ie=$e.get(C);if(Ie.__useDefaultFramebuffer!==void 0){Se.bindFramebuffer(B.FRAMEBUFFER,Ie.__webglFramebuffer),te.copy(C.viewport),pe.copy(C.scissor),he=C.scissorTest,Se.viewport(te),Se.scissor(pe),Se.setScissorTest(he),Z=-1;return}else if(Ie.__webglFramebuffer===void 0)tt.setupRenderTarget(C);else if(Ie.__hasExternalTextures)tt.rebindTextures(C,$e.get(C.texture).__webglTexture,$e.get(C.depthTexture).__webglTexture);else if(C.depthBuffer){let pt=C.depthTexture;if(Ie.__boundDepthTexture!==pt){if(pt!==null&&$e.has(pt)&&(C.width!==pt.image.width||C.height!==pt.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");tt.setupDepthRenderbuffer(C)}}let Ue=C.texture;(Ue.isData3DTexture||Ue.isDataArrayTexture||Ue.isCompressedArrayTexture)&&(Pe=!0);let je=$e.get(C).__webglFramebuffer;C.isWebGLCubeRenderTarget?(Array.isArray(je[G])?$=je[G][K]:$=je[G],j=!0):C.samples>0&&tt.useMultisampledRTT(C)===!1?$=$e.get(C).__webglMultisampledFramebuffer:Array.isArray(je)?$=je[K]:$=je,te.copy(C.viewport),pe.copy(C.scissor),he=C.scissorTest}else te.copy(Ze).multiplyScalar(Me).floor(),pe.copy(lt).multiplyScalar(Me).floor(),he=rt;if(K!==0&&($=H),Se.bindFramebuffer(B.FRAMEBUFFER,$)&&Se.drawBuffers(C,$),Se.viewport(te),Se.scissor(pe),Se.setScissorTest(he),j){let Ie=$e.get(C.texture);B.framebufferTexture2D(B.FRAMEBUFFER,B.COLOR_ATTACHMENT0,B.TEXTURE_CUBE_MAP_POSITIVE_X+G,Ie.__webglTexture,K)}else if(Pe){let Ie=G;for(let Ue=0;Ue<C.textures.length;Ue++){let je=$e.get(C.textures[Ue]);B.framebufferTextureLayer(B.FRAMEBUFFER,B.COLOR_ATTACHMENT0+Ue,je.__webglTexture,K,Ie)}}else if(C!==null&&K!==0){let Ie=$e.get(C.texture);B.framebufferTexture2D(B.FRAMEBUFFER,B.COLOR_ATTACHMENT0,B.TEXTURE_2D,Ie.__webglTexture,K)}Z=-1};function eo(C){let G=$e.get(C);return(G.__readFormat!==C.format||G.__readType!==C.type)&&(G.__readFormat=C.format,G.__readType=C.type,G.__formatReadable=ft.textureFormatReadable(C.format),G.__typeReadable=ft.textureTypeReadable(C.type)),G}this.readRenderTargetPixels=function(C,G,K,$,j,Pe,Oe,Ie=0){if(!(C&&C.isWebGLRenderTarget)){ht("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let Ue=$e.get(C).__webglFramebuffer;if(C.isWebGLCubeRenderTarget&&Oe!==void 0&&(Ue=Ue[Oe],Array.isArray(Ue)&&(Ue=Ue[0])),Ue){Se.bindFramebuffer(B.FRAMEBUFFER,Ue);try{let je=C.textures[Ie],pt=je.format,Tt=je.type;C.textures.length>1&&B.readBuffer(B.COLOR_ATTACHMENT0+Ie);let Ye=eo(je);if(Ye.__formatReadable===!1){ht("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(Ye.__typeReadable===!1){ht("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}G>=0&&G<=C.width-$&&K>=0&&K<=C.height-j&&B.readPixels(G,K,$,j,be.convert(pt),be.convert(Tt),Pe)}finally{let je=ce!==null?$e.get(ce).__webglFramebuffer:null;Se.bindFramebuffer(B.FRAMEBUFFER,je)}}},this.readRenderTargetPixelsAsync=async function(C,G,K,$,j,Pe,Oe,Ie=0){if(!(C&&C.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let Ue=$e.get(C).__webglFramebuffer;if(C.isWebGLCubeRenderTarget&&Oe!==void 0&&(Ue=Ue[Oe],Array.isArray(Ue)&&(Ue=Ue[0])),Ue)if(G>=0&&G<=C.width-$&&K>=0&&K<=C.height-j){Se.bindFramebuffer(B.FRAMEBUFFER,Ue);let je=C.textures[Ie],pt=je.format,Tt=je.type;C.textures.length>1&&B.readBuffer(B.COLOR_ATTACHMENT0+Ie);let Ye=eo(je);if(Ye.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(Ye.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let At=B.createBuffer();B.bindBuffer(B.PIXEL_PACK_BUFFER,At),B.bufferData(B.PIXEL_PACK_BUFFER,Pe.byteLength,B.STREAM_READ),B.readPixels(G,K,$,j,be.convert(pt),be.convert(Tt),0),B.bindBuffer(B.PIXEL_PACK_BUFFER,null);let an=ce!==null?$e.get(ce).__webglFramebuffer:null;Se.bindFramebuffer(B.FRAMEBUFFER,an);let Xt=B.fenceSync(B.SYNC_GPU_COMMANDS_COMPLETE,0);return B.flush(),await Y0(B,Xt,4),B.bindBuffer(B.PIXEL_PACK_BUFFER,At),B.getBufferSubData(B.PIXEL_PACK_BUFFER,0,Pe),B.bindBuffer(B.PIXEL_PACK_BUFFER,null),B.deleteBuffer(At),B.deleteSync(Xt),Pe}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(C,G=null,K=0){let $=Math.pow(2,-K),j=Math.floor(C.image.width*$),Pe=Math.floor(C.image.height*$),Oe=G!==null?G.x:0,Ie=G!==null?G.y:0;tt.setTexture2D(C,0),B.copyTexSubImage2D(B.TEXTURE_2D,K,0,0,Oe,Ie,j,Pe),Se.unbindTexture()},this.copyTextureToTexture=function(C,G,K=null,$=null,j=0,Pe=0){let Oe,Ie,Ue,je,pt,Tt,Ye,At,an,Xt=C.isCompressedTexture?C.mipmaps[Pe]:C.image;if(K!==null)Oe=K.max.x-K.min.x,Ie=K.max.y-K.min.y,Ue=K.isBox3?K.max.z-K.min.z:1,je=K.min.x,pt=K.min.y,Tt=K.isBox3?K.min.z:0;else{let Et=Math.pow(2,-j);Oe=Math.floor(Xt.width*Et),Ie=Math.floor(Xt.height*Et),C.isDataArrayTexture?Ue=Xt.depth:C.isData3DTexture?Ue=Math.floor(Xt.depth*Et):Ue=1,je=0,pt=0,Tt=0}$!==null?(Ye=$.x,At=$.y,an=$.z):(Ye=0,At=0,an=0);let qt=be.convert(G.format),An=be.convert(G.type),Ge;G.isData3DTexture?(tt.setTexture3D(G,0),Ge=B.TEXTURE_3D):G.isDataArrayTexture||G.isCompressedArrayTexture?(tt.setTexture2DArray(G,0),Ge=B.TEXTURE_2D_ARRAY):(tt.setTexture2D(G,0),Ge=B.TEXTURE_2D),Se.activeTexture(B.TEXTURE0),Se.pixelStorei(B.UNPACK_FLIP_Y_WEBGL,G.flipY),Se.pixelStorei(B.UNPACK_PREMULTIPLY_ALPHA_WEBGL,G.premultiplyAlpha),Se.pixelStorei(B.UNPACK_ALIGNMENT,G.unpackAlignment);let vn=Se.getParameter(B.UNPACK_ROW_LENGTH),Pt=Se.getParameter(B.UNPACK_IMAGE_HEIGHT),As=Se.getParameter(B.UNPACK_SKIP_PIXELS),xn=Se.getParameter(B.UNPACK_SKIP_ROWS),to=Se.getParameter(B.UNPACK_SKIP_IMAGES);Se.pixelStorei(B.UNPACK_ROW_LENGTH,Xt.width),Se.pixelStorei(B.UNPACK_IMAGE_HEIGHT,Xt.height),Se.pixelStorei(B.UNPACK_SKIP_PIXELS,je),Se.pixelStorei(B.UNPACK_SKIP_ROWS,pt),Se.pixelStorei(B.UNPACK_SKIP_IMAGES,Tt);let os=C.isDataArrayTexture||C.isData3DTexture,Rs=G.isDataArrayTexture||G.isData3DTexture;if(C.isDepthTexture){let Et=$e.get(C),un=$e.get(G),Qn=$e.get(Et.__renderTarget),Yt=$e.get(un.__renderTarget);Se.bindFramebuffer(B.READ_FRAMEBUFFER,Qn.__webglFramebuffer),Se.bindFramebuffer(B.DRAW_FRAMEBUFFER,Yt.__webglFramebuffer);for(let _n=0;_n<Ue;_n++)os&&(B.framebufferTextureLayer(B.READ_FRAMEBUFFER,B.COLOR_ATTACHMENT0,$e.get(C).__webglTexture,j,Tt+_n),B.framebufferTextureLayer(B.DRAW_FRAMEBUFFER,B.COLOR_ATTACHMENT0,$e.get(G).__webglTexture,Pe,an+_n)),B.blitFramebuffer(je,pt,je+Oe,pt+Ie,Ye,At,Ye+Oe,At+Ie,B.DEPTH_BUFFER_BIT,B.NEAREST);Se.bindFramebuffer(B.READ_FRAMEBUFFER,null),Se.bindFramebuffer(B.DRAW_FRAMEBUFFER,null)}else if(j!==0||C.isRenderTargetTexture||$e.has(C)){let Et=$e.get(C),un=$e.get(G);Se.bindFramebuffer(B.READ_FRAMEBUFFER,L),Se.bindFramebuffer(B.DRAW_FRAMEBUFFER,k);for(let Qn=0;Qn<Ue;Qn++)os?B.framebufferTextureLayer(B.READ_FRAMEBUFFER,B.COLOR_ATTACHMENT0,Et.__webglTexture,j,Tt+Qn):B.framebufferTexture2D(B.READ_FRAMEBUFFER,B.COLOR_ATTACHMENT0,B.TEXTURE_2D,Et.__webglTexture,j),Rs?B.framebufferTextureLayer(B.DRAW_FRAMEBUFFER,B.COLOR_ATTACHMENT0,un.__webglTexture,Pe,an+Qn):B.framebufferTexture2D(B.DRAW_FRAMEBUFFER,B.COLOR_ATTACHMENT0,B.TEXTURE_2D,un.__webglTexture,Pe),j!==0?B.blitFramebuffer(je,pt,je+Oe,pt+Ie,Ye,At,Ye+Oe,At+Ie,B.COLOR_BUFFER_BIT,B.NEAREST):Rs?B.copyTexSubImage3D(Ge,Pe,Ye,At,an+Qn,je,pt,Oe,Ie):B.copyTexSubImage2D(Ge,Pe,Ye,At,je,pt,Oe,Ie);Se.bindFramebuffer(B.READ_FRAMEBUFFER,null),Se.bindFramebuffer(B.DRAW_FRAMEBUFFER,null)}else Rs?C.isDataTexture||C.isData3DTexture?B.texSubImage3D(Ge,Pe,Ye,At,an,Oe,Ie,Ue,qt,An,Xt.data):G.isCompressedArrayTexture?B.compressedTexSubImage3D(Ge,Pe,Ye,At,an,Oe,Ie,Ue,qt,Xt.data):B.texSubImage3D(Ge,Pe,Ye,At,an,Oe,Ie,Ue,qt,An,Xt):C.isDataTexture?B.texSubImage2D(B.TEXTURE_2D,Pe,Ye,At,Oe,Ie,qt,An,Xt.data):C.isCompressedTexture?B.compressedTexSubImage2D(B.TEXTURE_2D,Pe,Ye,At,Xt.width,Xt.height,qt,Xt.data):B.texSubImage2D(B.TEXTURE_2D,Pe,Ye,At,Oe,Ie,qt,An,Xt);Se.pixelStorei(B.UNPACK_ROW_LENGTH,vn),Se.pixelStorei(B.UNPACK_IMAGE_HEIGHT,Pt),Se.pixelStorei(B.UNPACK_SKIP_PIXELS,As),Se.pixelStorei(B.UNPACK_SKIP_ROWS,xn),Se.pixelStorei(B.UNPACK_SKIP_IMAGES,to),Pe===0&&G.generateMipmaps===!0&&G.mipmapsAutoUpdate===!0&&B.generateMipmap(Ge),Se.unbindTexture()},this.initRenderTarget=function(C){$e.get(C).__webglFramebuffer===void 0&&tt.setupRenderTarget(C)},this.initTexture=function(C){C.isCubeTexture?tt.setTextureCube(C,0):C.isData3DTexture?tt.setTexture3D(C,0):C.isDataArrayTexture||C.isCompressedArrayTexture?tt.setTexture2DArray(C,0):tt.setTexture2D(C,0),Se.unbindTexture()},this.resetState=function(){q=0,V=0,ce=null,Se.reset(),Re.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return Ui}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(e){this._outputColorSpace=e;let t=this.getContext();t.drawingBufferColorSpace=Ct._getDrawingBufferColorSpace(e),t.unpackColorSpace=Ct._getUnpackColorSpace()}};var pu=0,Fy=1,Nl=2,Lp=3,zr=()=>({sign:[],signDark:[],foot:[],wire:[]}),mu=class{constructor(e,t){this.pieces=e;let n=e.map(({geometry:c})=>Dy(c)),s=e.map(({coarse:c})=>c?Dy(c):null),r=[...n,...s.filter(c=>c!==null)],o=r.reduce((c,h)=>c+h.getAttribute("position").count,0),a=r.reduce((c,h)=>c+h.index.count,0);this.mesh=new Ga(e.length,o,a,t),this.mesh.frustumCulled=this.mesh.perObjectFrustumCulled=this.mesh.sortObjects=!1,this.mesh.castShadow=!t.transparent;let l=new et;n.forEach((c,h)=>{this.fine.push(this.mesh.addGeometry(c));let u=s[h];this.coarse.push(u?this.mesh.addGeometry(u):this.fine[h]);let d=this.mesh.addInstance(this.fine[h]),f=e[h].colour;f&&this.mesh.setColorAt(d,l.set(f))})}pieces;mesh;matrix=new Qe;fine=[];coarse=[];update(e){this.pieces.forEach(({holder:t,parent:n,body:s,thin:r},o)=>{let a=e[s]??pu,l=t.visible&&(n?.visible??!0)&&a<(r?Nl:Lp);this.mesh.setVisibleAt(o,l),l&&(this.mesh.setGeometryIdAt(o,a===pu?this.fine[o]:this.coarse[o]),t.updateMatrix(),n&&n.updateMatrix(),this.mesh.setMatrixAt(o,n?this.matrix.multiplyMatrices(n.matrix,t.matrix):t.matrix))})}said(e){return this.pieces[e]?.said??null}};function Dy(i){let e=new St,t=i.getAttribute("position");return e.setAttribute("position",t),e.setAttribute("normal",i.getAttribute("normal")),e.setIndex(i.index??new kt(Uint32Array.from({length:t.count},(n,s)=>s),1)),e}Fe.line={worldUnits:{value:1},linewidth:{value:1},resolution:{value:new ue},dashOffset:{value:0},dashScale:{value:1},dashSize:{value:1},gapSize:{value:1}};hi.line={uniforms:Rl.merge([Fe.common,Fe.fog,Fe.line]),vertexShader:`
		#include <common>
		#include <color_pars_vertex>
		#include <fog_pars_vertex>
		#include <logdepthbuf_pars_vertex>
		#include <clipping_planes_pars_vertex>

		uniform float linewidth;
		uniform vec2 resolution;

		attribute vec3 instanceStart;
		attribute vec3 instanceEnd;

		attribute vec3 instanceColorStart;
		attribute vec3 instanceColorEnd;

		#ifdef WORLD_UNITS

			varying vec4 worldPos;
			varying vec3 worldStart;
			varying vec3 worldEnd;

			#ifdef USE_DASH

				varying vec2 vUv;

			#endif

		#else

			varying vec2 vUv;

		#endif

		#ifdef USE_DASH

			uniform float dashScale;
			attribute float instanceDistanceStart;
			attribute float instanceDistanceEnd;
			varying float vLineDistance;

		#endif

		float trimSegmentAlpha( const in vec4 start, const in vec4 end ) {

			// compute the interpolation factor needed to trim the segment so it terminates
			// between the camera plane and the near plane

			// conservative estimate of the near plane
			float a = projectionMatrix[ 2 ][ 2 ]; // 3nd entry in 3th column
			float b = projectionMatrix[ 3 ][ 2 ]; // 3nd entry in 4th column

			// we need different nearEstimate formula for reversed and default depth buffer
			// a is positive with a reversed depth buffer so it can be used for controlling the code flow
			float nearEstimate = ( a > 0.0 ) ? ( - b / ( a + 1.0 ) ) : ( - 0.5 * b / a );

			return ( nearEstimate - start.z ) / ( end.z - start.z );

		}

		void main() {

			#ifdef USE_COLOR

				vColor.xyz = ( position.y < 0.5 ) ? instanceColorStart : instanceColorEnd;

			#endif

			float aspect = resolution.x / resolution.y;

			// camera space
			vec4 start = modelViewMatrix * vec4( instanceStart, 1.0 );
			vec4 end = modelViewMatrix * vec4( instanceEnd, 1.0 );

			#ifdef USE_DASH

				float lineDistanceStart = dashScale * instanceDistanceStart;
				float lineDistanceEnd = dashScale * instanceDistanceEnd;

			#endif

			#ifdef WORLD_UNITS

				worldStart = start.xyz;
				worldEnd = end.xyz;

			#else

				vUv = uv;

			#endif

			// special case for perspective projection, and segments that terminate either in, or behind, the camera plane
			// clearly the gpu firmware has a way of addressing this issue when projecting into ndc space
			// but we need to perform ndc-space calculations in the shader, so we must address this issue directly
			// perhaps there is a more elegant solution -- WestLangley

			bool perspective = ( projectionMatrix[ 2 ][ 3 ] == - 1.0 ); // 4th entry in the 3rd column

			if ( perspective ) {

				if ( start.z < 0.0 && end.z >= 0.0 ) {

					float alpha = trimSegmentAlpha( start, end );
					end.xyz = mix( start.xyz, end.xyz, alpha );

					#ifdef USE_DASH

						lineDistanceEnd = mix( lineDistanceStart, lineDistanceEnd, alpha );

					#endif

				} else if ( end.z < 0.0 && start.z >= 0.0 ) {

					float alpha = trimSegmentAlpha( end, start );
					start.xyz = mix( end.xyz, start.xyz, alpha );

					#ifdef USE_DASH

						lineDistanceStart = mix( lineDistanceEnd, lineDistanceStart, alpha );

					#endif

				}

			}

			#ifdef USE_DASH

				vLineDistance = ( position.y < 0.5 ) ? lineDistanceStart : lineDistanceEnd;
				vUv = uv;

			#endif

			// clip space
			vec4 clipStart = projectionMatrix * start;
			vec4 clipEnd = projectionMatrix * end;

			// ndc space
			vec3 ndcStart = clipStart.xyz / clipStart.w;
			vec3 ndcEnd = clipEnd.xyz / clipEnd.w;

			// direction
			vec2 dir = ndcEnd.xy - ndcStart.xy;

			// account for clip-space aspect ratio
			dir.x *= aspect;
			dir = normalize( dir );

			#ifdef WORLD_UNITS

				vec3 worldDir = normalize( end.xyz - start.xyz );
				vec3 tmpFwd = perspective ? normalize( mix( start.xyz, end.xyz, 0.5 ) ) : vec3( 0.0, 0.0, - 1.0 );
				vec3 worldUp = normalize( cross( worldDir, tmpFwd ) );
				vec3 worldFwd = cross( worldDir, worldUp );
				worldPos = position.y < 0.5 ? start: end;

				// height offset
				float hw = linewidth * 0.5;
				worldPos.xyz += position.x < 0.0 ? hw * worldUp : - hw * worldUp;

				// don't extend the line if we're rendering dashes because we
				// won't be rendering the endcaps
				#ifndef USE_DASH

					// cap extension
					worldPos.xyz += position.y < 0.5 ? - hw * worldDir : hw * worldDir;

					// add width to the box
					worldPos.xyz += worldFwd * hw;

					// endcaps
					if ( position.y > 1.0 || position.y < 0.0 ) {

						worldPos.xyz -= worldFwd * 2.0 * hw;

					}

				#endif

				// project the worldpos
				vec4 clip = projectionMatrix * worldPos;

				// shift the depth of the projected points so the line
				// segments overlap neatly
				vec3 clipPose = ( position.y < 0.5 ) ? ndcStart : ndcEnd;

				// only shift the depth of vertices in front of the camera (#35137)
				if ( clip.w > 0.0 ) clip.z = clipPose.z * clip.w;

			#else

				vec2 offset = vec2( dir.y, - dir.x );
				// undo aspect ratio adjustment
				dir.x /= aspect;
				offset.x /= aspect;

				// sign flip
				if ( position.x < 0.0 ) offset *= - 1.0;

				// endcaps
				if ( position.y < 0.0 ) {

					offset += - dir;

				} else if ( position.y > 1.0 ) {

					offset += dir;

				}

				// adjust for linewidth
				offset *= linewidth;

				// adjust for clip-space to screen-space conversion // maybe resolution should be based on viewport ...
				offset /= resolution.y;

				// select end
				vec4 clip = ( position.y < 0.5 ) ? clipStart : clipEnd;

				// back to clip space
				offset *= clip.w;

				clip.xy += offset;

			#endif

			gl_Position = clip;

			vec4 mvPosition = ( position.y < 0.5 ) ? start : end; // this is an approximation

			#include <logdepthbuf_vertex>
			#include <clipping_planes_vertex>
			#include <fog_vertex>

		}
		`,fragmentShader:`
		uniform vec3 diffuse;
		uniform float opacity;
		uniform float linewidth;

		#ifdef USE_DASH

			uniform float dashOffset;
			uniform float dashSize;
			uniform float gapSize;

		#endif

		varying float vLineDistance;

		#ifdef WORLD_UNITS

			varying vec4 worldPos;
			varying vec3 worldStart;
			varying vec3 worldEnd;

			#ifdef USE_DASH

				varying vec2 vUv;

			#endif

		#else

			varying vec2 vUv;

		#endif

		#include <common>
		#include <color_pars_fragment>
		#include <fog_pars_fragment>
		#include <logdepthbuf_pars_fragment>
		#include <clipping_planes_pars_fragment>

		vec2 closestLineToLine(vec3 p1, vec3 p2, vec3 p3, vec3 p4) {

			float mua;
			float mub;

			vec3 p13 = p1 - p3;
			vec3 p43 = p4 - p3;

			vec3 p21 = p2 - p1;

			float d1343 = dot( p13, p43 );
			float d4321 = dot( p43, p21 );
			float d1321 = dot( p13, p21 );
			float d4343 = dot( p43, p43 );
			float d2121 = dot( p21, p21 );

			float denom = d2121 * d4343 - d4321 * d4321;

			float numer = d1343 * d4321 - d1321 * d4343;

			mua = numer / denom;
			mua = clamp( mua, 0.0, 1.0 );
			mub = ( d1343 + d4321 * ( mua ) ) / d4343;
			mub = clamp( mub, 0.0, 1.0 );

			return vec2( mua, mub );

		}

		void main() {

			float alpha = opacity;
			vec4 diffuseColor = vec4( diffuse, alpha );

			#include <clipping_planes_fragment>

			#ifdef USE_DASH

				if ( vUv.y < - 1.0 || vUv.y > 1.0 ) discard; // discard endcaps

				if ( mod( vLineDistance + dashOffset, dashSize + gapSize ) > dashSize ) discard; // todo - FIX

			#endif

			#ifdef WORLD_UNITS

				float len;

				if ( isOrthographic ) {

					// View rays are parallel to the z axis so the distance reduces to camera-space XY
					vec2 lineDir = worldEnd.xy - worldStart.xy;
					float t = clamp( dot( worldPos.xy - worldStart.xy, lineDir ) / dot( lineDir, lineDir ), 0.0, 1.0 );
					len = length( worldStart.xy + lineDir * t - worldPos.xy );

				} else {

					// Find the closest points on the view ray and the line segment
					vec3 rayEnd = normalize( worldPos.xyz ) * 1e5;
					vec3 lineDir = worldEnd - worldStart;
					vec2 params = closestLineToLine( worldStart, worldEnd, vec3( 0.0, 0.0, 0.0 ), rayEnd );

					vec3 p1 = worldStart + lineDir * params.x;
					vec3 p2 = rayEnd * params.y;
					vec3 delta = p1 - p2;
					len = length( delta );

				}

				float norm = len / linewidth;

				#ifndef USE_DASH

					#ifdef USE_ALPHA_TO_COVERAGE

						float dnorm = fwidth( norm );
						alpha = 1.0 - smoothstep( 0.5 - dnorm, 0.5 + dnorm, norm );

					#else

						if ( norm > 0.5 ) {

							discard;

						}

					#endif

				#endif

			#else

				#ifdef USE_ALPHA_TO_COVERAGE

					// artifacts appear on some hardware if a derivative is taken within a conditional
					float a = vUv.x;
					float b = ( vUv.y > 0.0 ) ? vUv.y - 1.0 : vUv.y + 1.0;
					float len2 = a * a + b * b;
					float dlen = fwidth( len2 );

					if ( abs( vUv.y ) > 1.0 ) {

						alpha = 1.0 - smoothstep( 1.0 - dlen, 1.0 + dlen, len2 );

					}

				#else

					if ( abs( vUv.y ) > 1.0 ) {

						float a = vUv.x;
						float b = ( vUv.y > 0.0 ) ? vUv.y - 1.0 : vUv.y + 1.0;
						float len2 = a * a + b * b;

						if ( len2 > 1.0 ) discard;

					}

				#endif

			#endif

			#include <logdepthbuf_fragment>
			#include <color_fragment>

			gl_FragColor = vec4( diffuseColor.rgb, alpha );

			#include <tonemapping_fragment>
			#include <colorspace_fragment>
			#include <fog_fragment>
			#include <premultiplied_alpha_fragment>

		}
		`};var ys=class extends Bi{constructor(e){super({type:"LineMaterial",uniforms:Rl.clone(hi.line.uniforms),vertexShader:hi.line.vertexShader,fragmentShader:hi.line.fragmentShader,clipping:!0}),this.isLineMaterial=!0,this.setValues(e)}get color(){return this.uniforms.diffuse.value}set color(e){this.uniforms.diffuse.value=e}get worldUnits(){return"WORLD_UNITS"in this.defines}set worldUnits(e){e===!0!==this.worldUnits&&(this.needsUpdate=!0),e===!0?this.defines.WORLD_UNITS="":delete this.defines.WORLD_UNITS}get linewidth(){return this.uniforms.linewidth.value}set linewidth(e){this.uniforms.linewidth&&(this.uniforms.linewidth.value=e)}get dashed(){return"USE_DASH"in this.defines}set dashed(e){e===!0!==this.dashed&&(this.needsUpdate=!0),e===!0?this.defines.USE_DASH="":delete this.defines.USE_DASH}get dashScale(){return this.uniforms.dashScale.value}set dashScale(e){this.uniforms.dashScale.value=e}get dashSize(){return this.uniforms.dashSize.value}set dashSize(e){this.uniforms.dashSize.value=e}get dashOffset(){return this.uniforms.dashOffset.value}set dashOffset(e){this.uniforms.dashOffset.value=e}get gapSize(){return this.uniforms.gapSize.value}set gapSize(e){this.uniforms.gapSize.value=e}get opacity(){return this.uniforms.opacity.value}set opacity(e){this.uniforms&&(this.uniforms.opacity.value=e)}get resolution(){return this.uniforms.resolution.value}set resolution(e){this.uniforms.resolution.value.copy(e)}get alphaToCoverage(){return"USE_ALPHA_TO_COVERAGE"in this.defines}set alphaToCoverage(e){this.defines&&(e===!0!==this.alphaToCoverage&&(this.needsUpdate=!0),e===!0?this.defines.USE_ALPHA_TO_COVERAGE="":delete this.defines.USE_ALPHA_TO_COVERAGE)}};var Oy=new Ut,gu=new S,_r=class extends ml{constructor(){super(),this.isLineSegmentsGeometry=!0,this.type="LineSegmentsGeometry";let e=[-1,2,0,1,2,0,-1,1,0,1,1,0,-1,0,0,1,0,0,-1,-1,0,1,-1,0],t=[-1,2,1,2,-1,1,1,1,-1,-1,1,-1,-1,-2,1,-2],n=[0,2,1,2,3,1,2,4,3,4,5,3,4,6,5,6,7,5];this.setIndex(n),this.setAttribute("position",new ot(e,3)),this.setAttribute("uv",new ot(t,2))}applyMatrix4(e){let t=this.attributes.instanceStart,n=this.attributes.instanceEnd;return t!==void 0&&(t.applyMatrix4(e),n.applyMatrix4(e),t.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this}setPositions(e){let t;e instanceof Float32Array?t=e:Array.isArray(e)&&(t=new Float32Array(e));let n=new pr(t,6,1);return this.setAttribute("instanceStart",new ki(n,3,0)),this.setAttribute("instanceEnd",new ki(n,3,3)),this.instanceCount=this.attributes.instanceStart.count,this.computeBoundingBox(),this.computeBoundingSphere(),this}setColors(e){let t;e instanceof Float32Array?t=e:Array.isArray(e)&&(t=new Float32Array(e));let n=new pr(t,6,1);return this.setAttribute("instanceColorStart",new ki(n,3,0)),this.setAttribute("instanceColorEnd",new ki(n,3,3)),this}fromWireframeGeometry(e){return this.setPositions(e.attributes.position.array),this}fromEdgesGeometry(e){return this.setPositions(e.attributes.position.array),this}fromMesh(e){return this.fromWireframeGeometry(new al(e.geometry)),this}fromLineSegments(e){let t=e.geometry;return this.setPositions(t.attributes.position.array),this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Ut);let e=this.attributes.instanceStart,t=this.attributes.instanceEnd;e!==void 0&&t!==void 0&&(this.boundingBox.setFromBufferAttribute(e),Oy.setFromBufferAttribute(t),this.boundingBox.union(Oy))}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Vn),this.boundingBox===null&&this.computeBoundingBox();let e=this.attributes.instanceStart,t=this.attributes.instanceEnd;if(e!==void 0&&t!==void 0){let n=this.boundingSphere.center;this.boundingBox.getCenter(n);let s=0;for(let r=0,o=e.count;r<o;r++)gu.fromBufferAttribute(e,r),s=Math.max(s,n.distanceToSquared(gu)),gu.fromBufferAttribute(t,r),s=Math.max(s,n.distanceToSquared(gu));this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&console.error("THREE.LineSegmentsGeometry.computeBoundingSphere(): Computed radius is NaN. The instanced position data is likely to have NaN values.",this)}}toJSON(){}};var Np=new Gt,Uy=new S,ky=new S,Gn=new Gt,Wn=new Gt,vs=new Gt,Dp=new S,Fp=new Qe,Xn=new gl,By=new S,yu=new Ut,vu=new Vn,xs=new Gt,_s,Vr;function Hy(i,e,t){return xs.set(0,0,-e,1).applyMatrix4(i.projectionMatrix),xs.multiplyScalar(1/xs.w),xs.x=Vr/t.width,xs.y=Vr/t.height,xs.applyMatrix4(i.projectionMatrixInverse),xs.multiplyScalar(1/xs.w),Math.abs(Math.max(xs.x,xs.y))}function rA(i,e){let t=i.matrixWorld,n=i.geometry,s=n.attributes.instanceStart,r=n.attributes.instanceEnd,o=Math.min(n.instanceCount,s.count);for(let a=0,l=o;a<l;a++){Xn.start.fromBufferAttribute(s,a),Xn.end.fromBufferAttribute(r,a),Xn.applyMatrix4(t);let c=new S,h=new S;_s.distanceSqToSegment(Xn.start,Xn.end,h,c),h.distanceTo(c)<Vr*.5&&e.push({point:h,pointOnLine:c,distance:_s.origin.distanceTo(h),object:i,face:null,faceIndex:a,uv:null,uv1:null})}}function oA(i,e,t){let n=e.projectionMatrix,r=i.material.resolution,o=i.matrixWorld,a=i.geometry,l=a.attributes.instanceStart,c=a.attributes.instanceEnd,h=Math.min(a.instanceCount,l.count),u=-e.near;_s.at(1,vs),vs.w=1,vs.applyMatrix4(e.matrixWorldInverse),vs.applyMatrix4(n),vs.multiplyScalar(1/vs.w),vs.x*=r.x/2,vs.y*=r.y/2,vs.z=0,Dp.copy(vs),Fp.multiplyMatrices(e.matrixWorldInverse,o);for(let d=0,f=h;d<f;d++){if(Gn.fromBufferAttribute(l,d),Wn.fromBufferAttribute(c,d),Gn.w=1,Wn.w=1,Gn.applyMatrix4(Fp),Wn.applyMatrix4(Fp),Gn.z>u&&Wn.z>u)continue;if(Gn.z>u){let b=Gn.z-Wn.z,x=(Gn.z-u)/b;Gn.lerp(Wn,x)}else if(Wn.z>u){let b=Wn.z-Gn.z,x=(Wn.z-u)/b;Wn.lerp(Gn,x)}Gn.applyMatrix4(n),Wn.applyMatrix4(n),Gn.multiplyScalar(1/Gn.w),Wn.multiplyScalar(1/Wn.w),Gn.x*=r.x/2,Gn.y*=r.y/2,Wn.x*=r.x/2,Wn.y*=r.y/2,Xn.start.copy(Gn),Xn.start.z=0,Xn.end.copy(Wn),Xn.end.z=0;let v=Xn.closestPointToPointParameter(Dp,!0);Xn.at(v,By);let g=ci.lerp(Gn.z,Wn.z,v),m=g>=-1&&g<=1,y=Dp.distanceTo(By)<Vr*.5;if(m&&y){Xn.start.fromBufferAttribute(l,d),Xn.end.fromBufferAttribute(c,d),Xn.start.applyMatrix4(o),Xn.end.applyMatrix4(o);let b=new S,x=new S;_s.distanceSqToSegment(Xn.start,Xn.end,x,b),t.push({point:x,pointOnLine:b,distance:_s.origin.distanceTo(x),object:i,face:null,faceIndex:d,uv:null,uv1:null})}}}var Yo=class extends wt{constructor(e=new _r,t=new ys({color:Math.random()*16777215})){super(e,t),this.isLineSegments2=!0,this.type="LineSegments2"}computeLineDistances(){let e=this.geometry,t=e.attributes.instanceStart,n=e.attributes.instanceEnd,s=new Float32Array(2*t.count);for(let o=0,a=0,l=t.count;o<l;o++,a+=2)Uy.fromBufferAttribute(t,o),ky.fromBufferAttribute(n,o),s[a]=a===0?0:s[a-1],s[a+1]=s[a]+Uy.distanceTo(ky);let r=new pr(s,2,1);return e.setAttribute("instanceDistanceStart",new ki(r,1,0)),e.setAttribute("instanceDistanceEnd",new ki(r,1,1)),this}raycast(e,t){let n=this.material.worldUnits,s=e.camera;if(s===null&&!n&&console.error('LineSegments2: "Raycaster.camera" needs to be set in order to raycast against LineSegments2 while worldUnits is set to false.'),n===!1&&(this.material.resolution.x===0||this.material.resolution.y===0))return;let r=e.params.Line2!==void 0&&e.params.Line2.threshold||0;_s=e.ray;let o=this.matrixWorld,a=this.geometry,l=this.material;Vr=l.linewidth+r,a.boundingSphere===null&&a.computeBoundingSphere(),vu.copy(a.boundingSphere).applyMatrix4(o);let c;if(n)c=Vr*.5;else{let u=Math.max(s.near,vu.distanceToPoint(_s.origin));c=Hy(s,u,l.resolution)}if(vu.radius+=c,_s.intersectsSphere(vu)===!1)return;a.boundingBox===null&&a.computeBoundingBox(),yu.copy(a.boundingBox).applyMatrix4(o);let h;if(n)h=Vr*.5;else{let u=Math.max(s.near,yu.distanceToPoint(_s.origin));h=Hy(s,u,l.resolution)}yu.expandByScalar(h),_s.intersectsBox(yu)!==!1&&(n?rA(this,t):oA(this,s,t))}onBeforeRender(e){let t=this.material.uniforms;t&&t.resolution&&(e.getViewport(Np),this.material.uniforms.resolution.value.set(Np.z,Np.w))}};var aA=2,xu=class{constructor(e,t){this.actor=e;let n=[],s=new et;e.stage.bodies.forEach((o,a)=>{for(let l of o.links)this.ends.push({body:a,points:[o.centre_of_mass,l]}),s.set(o.colour),n.push(...s.toArray(),...s.toArray())}),this.material=new ys({linewidth:aA,vertexColors:!t,transparent:t,opacity:t?.4:1});let r=new _r;r.setPositions(new Float32Array(6*this.ends.length)),t||r.setColors(n),this.object=new Yo(r,this.material),this.object.frustumCulled=!1,this.object.raycast=()=>{}}actor;object;ends=[];material;recolour(e){this.material.vertexColors||this.material.color.set(e)}update(){let e=new S,t=this.object.geometry.getAttribute("instanceStart"),n=t.data.array;this.ends.forEach(({body:s,points:r},o)=>{let a=this.actor.isBad[s];r.forEach((l,c)=>{this.actor.place(s,a?r[0]:l,e),e.toArray(n,6*o+3*c)})}),t.data.needsUpdate=!0}};var zy=[[.16,.2,.46],[.15,.41,.61],[.14,.6,.58],[.52,.77,.38],[.98,.86,.32]],lA=i=>i<=.04045?i/12.92:((i+.055)/1.055)**2.4,_u=zy.map(i=>i.map(lA));function bu(i,e,t){let n=Math.min(Math.max(Number.isFinite(i)?i:0,0),1)*(_u.length-1),s=Math.min(Math.floor(n),_u.length-2),r=n-s;for(let o=0;o<3;o++)e[t+o]=_u[s][o]*(1-r)+_u[s+1][o]*r}function Vy(){return`linear-gradient(90deg, ${zy.map(e=>`rgb(${e.map(t=>Math.round(255*t)).join(" ")})`).join(", ")})`}var Eu=class{constructor(e,t){this.record=e;this.modes=t.rounded(e.modes),this.ranges=t.indices(e.stations),this.count=e.modes.numbers.shape[2]??0,this.tensor=new Float32Array(6*this.count),this.values=new Float32Array(e.stations.shape[0]??0)}record;values;peak=-1;modes;ranges;tensor;count;update(e,t){let{tensor:n,modes:s,count:r,values:o,ranges:a}=this,l=6*r;n.fill(0);for(let c=0;c*l<s.length;c++){let h=e[t+c];if(!(!Number.isFinite(h)||h===0))for(let u=0;u<l;u++)n[u]+=h*s[c*l+u]}this.peak=-1;for(let c=0;c<o.length;c++){let h=NaN;for(let u=a[2*c];u<a[2*c+1];u++){let d=this.vonMises(u);d<=h||(h=d)}o[c]=h,h>(o[this.peak]??0)&&(this.peak=c)}}vonMises(e){let{tensor:t,count:n}=this,[s,r,o]=[t[e],t[n+e],t[2*n+e]],[a,l,c]=[t[3*n+e],t[4*n+e],t[5*n+e]];return Math.sqrt(.5*((s-r)**2+(r-o)**2+(o-s)**2)+3*(a*a+l*l+c*c))}};var cA=40,hA=28,uA=4e4;function Op(i,e){return e==="x"?i.rotateZ(-Math.PI/2):e==="z"&&i.rotateX(Math.PI/2),i}function dA(i,e,t,n){let s=t/2,r=[[e,-s],[i,-s],[i,s],[e,s],[e,-s]],o=new rl(r.map(([a,l])=>new ue(a,l)),n).toNonIndexed();return o.computeVertexNormals(),fA(o),o}function fA(i){let e=i.getAttribute("position"),t=i.getAttribute("normal");for(let n=0;n<e.count;n++){if(Math.abs(t.getY(n))>.5)continue;let s=Math.hypot(e.getX(n),e.getZ(n))||1,r=Math.sign(t.getX(n)*e.getX(n)+t.getZ(n)*e.getZ(n))||1;t.setXYZ(n,r*e.getX(n)/s,0,r*e.getZ(n)/s)}}function pA(i){let e=new Uo(i.outline.map(([l,c])=>new ue(l,c))),t=i.size[0]??1,n=new sl(e,{depth:t,bevelEnabled:!1,steps:1});n.translate(0,0,-t/2);let[s,r,o]=[new S(1,0,0),new S(0,1,0),new S(0,0,1)],a=new Qe;return i.along==="x"?a.makeBasis(r,o,s):i.along==="y"&&a.makeBasis(o,s,r),n.applyMatrix4(a)}function Dl(i,e){let t=new St;return t.setAttribute("position",new kt(i,3)),t.setIndex(new kt(e,1)),t}function mA(i){let e=i.toNonIndexed();return e.computeVertexNormals(),e}function Fl(i,e,t=cA){let[n=1,s=1,r=1]=i.size,o;switch(i.kind){case"box":o=new pn(n,s,r);break;case"cylinder":o=Op(new Jt(n,n,s,t),i.along);break;case"capsule":o=Op(new Ya(n,s,Math.ceil(.3*t),t),i.along);break;case"tube":o=Op(dA(n,s,r,t),i.along);break;case"sphere":o=new on(n,t,t/2);break;case"ellipsoid":o=new on(1,t,t/2).scale(n,s,r);break;case"extrusion":o=pA(i);break;case"mesh":if(!i.vertices||!i.triangles)throw new Error("a mesh without vertices");o=mA(Dl(e.floats(i.vertices),e.indices(i.triangles)))}return o.translate(...i.centre)}function wu(i,e){return i.kind==="sphere"||i.kind==="ellipsoid"||i.kind==="capsule"||(e.index?.count??e.getAttribute("position").count)/3>uA?null:new $a(e,hA)}var gA=new S(0,1,0);function Gy(i,e,t,n){let s=i.distanceTo(e),r=new Jt(t,t,s||1e-9,n,1,!0),o=new nt().setFromUnitVectors(gA,e.clone().sub(i).normalize()),a=i.clone().add(e).multiplyScalar(.5);return r.applyMatrix4(new Qe().compose(a,o,new S(1,1,1)))}function Up(i,e,t){return new on(e,t,Math.round(.7*t)).translate(i.x,i.y,i.z)}var yA=.55,vA=.012,xA=1.001,Mu=class{constructor(e,t,n,s){this.record=e;this.rest=t.floats(e.vertices),this.modes=t.floats(e.modes),this.field=e.field?t.floats(e.field):null,this.count=this.rest.length/3,this.values=new Float32Array(this.count),this.stressed=e.stress?new Eu(e.stress,t):null,this.scale=this.ownScale,this.modeCount=e.modes.shape[0]??0;let r=Dl(this.rest.slice(),t.indices(e.triangles));r.setAttribute("color",new kt(new Float32Array(3*this.count).fill(1),3)),r.computeVertexNormals();let o=new Gs({vertexColors:!0,shininess:20,specular:1710618,side:wn,transparent:n,opacity:n?.25:1});this.mesh=new wt(r,o),this.mesh.castShadow=!n,this.mesh.frustumCulled=!1,this.mesh.userData={kind:"body",name:e.name},this.peak=new wt(new on(vA*s,16,12),new Rn({color:13632027,depthTest:!1,transparent:!0})),this.peak.renderOrder=2,this.peak.visible=!1,this.mesh.add(this.peak)}record;mesh;values;stressed;exaggeration=1;showsStress=!1;scale;seen=0;peak;near=new WeakMap;rest;modes;field;count;modeCount;get ownScale(){let{quantity:e,unit:t,low:n,high:s,stress:r}=this.record;return this.showsStress&&r?{quantity:"von Mises stress",unit:"Pa",low:0,high:r.high}:{quantity:e,unit:t,low:n,high:s>n?s:this.seen}}get peakValue(){return this.stressed&&this.stressed.peak>=0?this.stressed.values[this.stressed.peak]:0}carried(e,t,n,s){let r=this.near.get(e);r||this.near.set(e,r=this.nearest(e)),s.set(0,0,0);for(let o=0;o<this.modeCount;o++){let a=t[n+this.record.first+o]/r.length;for(let l of r){let c=3*(this.count*o+l);s.x+=a*this.modes[c],s.y+=a*this.modes[c+1],s.z+=a*this.modes[c+2]}}return s}nearest([e,t,n]){let s=Array.from({length:this.count},(o,a)=>Math.hypot(this.rest[3*a]-e,this.rest[3*a+1]-t,this.rest[3*a+2]-n)),r=s.reduce((o,a)=>Math.min(o,a));return s.flatMap((o,a)=>o<=xA*r+1e-12?[a]:[])}update(e,t){let{count:n,modes:s,rest:r,field:o}=this,a=this.mesh.geometry.getAttribute("position"),l=this.mesh.geometry.getAttribute("color"),c=a.array,h=new Float32Array(3*n),u=new Float32Array(n);for(let m=0;m<this.modeCount;m++){let y=e[t+this.record.first+m];if(!Number.isFinite(y)||y===0)continue;let b=3*n*m;for(let x=0;x<3*n;x++)h[x]+=y*s[b+x];if(o)for(let x=0;x<n;x++)u[x]+=y*o[n*m+x]}this.showsStress&&this.stressed?.update(e,t+this.record.first);let{low:d,high:f}=this.scale,p=f>d?f-d:1,v=l.array;for(let m=0;m<n;m++){let[y,b,x]=[h[3*m],h[3*m+1],h[3*m+2]];c[3*m]=r[3*m]+this.exaggeration*y,c[3*m+1]=r[3*m+1]+this.exaggeration*b,c[3*m+2]=r[3*m+2]+this.exaggeration*x;let T=this.showsStress?this.stressed.values[m]:o?u[m]:Math.hypot(y,b,x);this.values[m]=T,T>this.seen&&(this.seen=T),Number.isNaN(T)?v.fill(yA,3*m,3*m+3):bu((T-d)/p,v,3*m)}let g=this.showsStress?this.stressed.peak:-1;this.peak.visible=g>=0,g>=0&&this.peak.position.fromArray(c,3*g),a.needsUpdate=!0,l.needsUpdate=!0,this.mesh.geometry.computeVertexNormals()}};function kp(i,e=!1){let t=i[0].index!==null,n=new Set(Object.keys(i[0].attributes)),s=new Set(Object.keys(i[0].morphAttributes)),r={},o={},a=i[0].morphTargetsRelative,l=new St;l.morphTargetsRelative=a;let c=0;for(let h=0;h<i.length;++h){let u=i[h],d=0,f=0;if(t!==(u.index!==null))return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+". All geometries must have compatible attributes; make sure index attribute exists among all geometries, or in none of them."),null;for(let p in u.attributes){if(!n.has(p))return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+'. All geometries must have compatible attributes; make sure "'+p+'" attribute exists among all geometries, or in none of them.'),null;r[p]===void 0&&(r[p]=[]),r[p].push(u.attributes[p]),d++}if(d!==n.size)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+". Make sure all geometries have the same number of attributes."),null;if(a!==u.morphTargetsRelative)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+". .morphTargetsRelative must be consistent throughout all geometries."),null;for(let p in u.morphAttributes){if(!s.has(p))return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+".  .morphAttributes must be consistent throughout all geometries."),null;if(u.morphAttributes[p].length!==i[0].morphAttributes[p].length)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+'. All geometries must have the same number of morph targets for the "'+p+'" morph attribute.'),null;o[p]===void 0&&(o[p]=[]),o[p].push(u.morphAttributes[p]),f++}if(f!==s.size)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+". Make sure all geometries have the same number of morph attributes."),null;if(e){let p;if(t)p=u.index.count;else if(u.attributes.position!==void 0)p=u.attributes.position.count;else return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+". The geometry must have either an index or a position attribute"),null;l.addGroup(c,p,h),c+=p}}if(t){let h=0,u=[];for(let d=0;d<i.length;++d){let f=i[d].index;for(let p=0;p<f.count;++p)u.push(f.getX(p)+h);h+=i[d].attributes.position.count}l.setIndex(u)}for(let h in r){let u=Wy(r[h]);if(!u)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed while trying to merge the "+h+" attribute."),null;l.setAttribute(h,u)}for(let h in o){let u=o[h][0].length;if(u!==0){l.morphAttributes=l.morphAttributes||{},l.morphAttributes[h]=[];for(let d=0;d<u;++d){let f=[];for(let v=0;v<o[h].length;++v)f.push(o[h][v][d]);let p=Wy(f);if(!p)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed while trying to merge the "+h+" morphAttribute."),null;l.morphAttributes[h].push(p)}}}return l}function Wy(i){let e,t,n,s=-1,r=0;for(let c=0;c<i.length;++c){let h=i[c];if(e===void 0&&(e=h.array.constructor),e!==h.array.constructor)return console.error("THREE.BufferGeometryUtils: .mergeAttributes() failed. BufferAttribute.array must be of consistent array types across matching attributes."),null;if(t===void 0&&(t=h.itemSize),t!==h.itemSize)return console.error("THREE.BufferGeometryUtils: .mergeAttributes() failed. BufferAttribute.itemSize must be consistent across matching attributes."),null;if(n===void 0&&(n=h.normalized),n!==h.normalized)return console.error("THREE.BufferGeometryUtils: .mergeAttributes() failed. BufferAttribute.normalized must be consistent across matching attributes."),null;if(s===-1&&(s=h.gpuType),s!==h.gpuType)return console.error("THREE.BufferGeometryUtils: .mergeAttributes() failed. BufferAttribute.gpuType must be consistent across matching attributes."),null;r+=h.count*t}let o=new e(r),a=new kt(o,t,n),l=0;for(let c=0;c<i.length;++c){let h=i[c];if(h.isInterleavedBufferAttribute){let u=l/t;for(let d=0,f=h.count;d<f;d++)for(let p=0;p<t;p++){let v=h.getComponent(d,p);a.setComponent(d+u,p,v)}}else o.set(h.array,l);l+=h.count*t}return s!==void 0&&(a.gpuType=s),a}var es=class{constructor(e,t,n){this.owners=n;this.mesh=new Nr(e,t,n.length),this.mesh.frustumCulled=!1,this.mesh.userData={instances:this},n.forEach((s,r)=>this.hide(r))}owners;mesh;matrix=new Qe;set(e,t,n,s){this.mesh.setMatrixAt(e,this.matrix.compose(t,n,s))}hide(e){this.mesh.setMatrixAt(e,this.matrix.makeScale(0,0,0))}done(){this.mesh.instanceMatrix.needsUpdate=!0,this.mesh.boundingSphere=null}said(e){return this.owners[e??-1]??null}};var $y=[13780799,2595413,3108822],Ol=.09,Xy=.7,_A=.014,bA=.16,qy=.0012,EA=["revolute","cylindrical","translational","screw","planar","point-on-line","point-on-plane","revolute-spherical","revolute-cylindrical","revolute-translational","universal","cylindrical-on-beam","translational-on-beam"],Su=class{constructor(e){this.actor=e}actor;made=new Map;at=new S;turn=new nt;scale=new S;show(e,t){t&&!this.made.has(e)&&this.made.set(e,this.make(e));let n=this.made.get(e);n&&(n.instances.mesh.visible=t)}update(e){for(let[t,{spots:n,instances:s}]of this.made)s.mesh.visible&&(n.forEach(({body:r,point:o,turn:a,size:l},c)=>{if(this.actor.isBad[r]||(e[r]??0)>=Nl){s.hide(c);return}t==="triads"?this.at.copy(this.actor.holder(r).position):this.actor.place(r,o,this.at),this.turn.copy(this.actor.holder(r).quaternion).multiply(a),s.set(c,this.at,this.turn,this.scale.setScalar(l))}),s.done())}make(e){let t=this.spots(e),{geometry:n,material:s}=this.looks(e),r=new es(n,s,t.map(({owner:o})=>o));return this.actor.root.add(r.mesh),{spots:t,instances:r}}looks(e){return e==="centres"?{geometry:new on(_A,16,12),material:this.actor.palette.signDark}:e==="axes"?{geometry:wA(),material:new Rn({color:$y[2],depthTest:!1,transparent:!0,opacity:.75})}:{geometry:MA(),material:new Rn({vertexColors:!0})}}spots(e){let{stage:t,nearness:n}=this.actor,s=new nt;switch(e){case"triads":case"centres":return t.bodies.map((r,o)=>({owner:{kind:"body",name:r.name},body:o,point:e==="triads"?[0,0,0]:r.centre_of_mass,turn:s,size:n.body(o)}));case"markers":return t.markers.map(({body:r,point:o,x_axis:a,axis:l})=>({owner:{kind:"body",name:t.bodies[r].name},body:r,point:o,turn:Yy(l,a),size:Xy*n.body(r)}));case"joints":case"axes":return t.joints.flatMap(r=>e==="axes"&&!EA.includes(r.kind)?[]:[0,1].filter(a=>e==="joints"&&!(a&&r.kind.endsWith("-on-beam"))||a===r.place||r.kind==="universal").map(a=>({owner:{kind:"joint",name:r.name},body:r.bodies[a],point:r.points[a],turn:Yy(r.axes[a],r.x_axes?.[a]),size:(e==="joints"?Xy:1)*n.joint(r)})))}}};function Yy(i,e){let t=new S(...i).normalize();if(!e)return new nt().setFromUnitVectors(new S(0,0,1),t);let n=new S(...e);return n.addScaledVector(t,-n.dot(t)).normalize(),new nt().setFromRotationMatrix(new Qe().makeBasis(n,new S().crossVectors(t,n),t))}function wA(){return new Jt(qy,qy,2*bA,6).rotateX(Math.PI/2)}function MA(){let i=.028*Ol,e=$y.map((t,n)=>{let s=new Jt(i,i,.8*Ol,6).translate(0,.4*Ol,0),r=new gi(3*i,.2*Ol,10).translate(0,.9*Ol,0),o=kp([s,r]);n===0&&o.rotateZ(-Math.PI/2),n===2&&o.rotateX(Math.PI/2);let a=Array.from({length:o.getAttribute("position").count},()=>new et(t).toArray()).flat();return o.setAttribute("color",new ot(a,3)),o});return kp(e)}function Bp(){let i=getComputedStyle(document.documentElement),e=t=>i.getPropertyValue(`--${t}`).trim();return{dark:matchMedia("(prefers-color-scheme: dark)").matches,sky:e("sky"),ground:e("floor"),grid:e("mesh-line"),ink:e("ink"),paper:e("card"),soft:e("soft"),accent:e("accent"),reaction:e("reaction"),moment:e("moment"),applied:e("applied"),trace:[0,1,2,3,4,5,6,7].map(t=>e(`tone-${t}`))}}var Hp=["sign","signDark","foot","wire"],Tu=class{constructor(e,t){this.ghost=t;if(this.body=new Gs({shininess:28,specular:2236962,polygonOffset:!0,polygonOffsetFactor:1,polygonOffsetUnits:1,transparent:t,opacity:t?.24:1,depthWrite:!t,side:wn}),this.edge=new Zn({transparent:!0,opacity:t?.35:.5}),this.sign=new ai,this.signDark=new ai,this.foot=new ai,this.wire=new ai,t)for(let n of[this.sign,this.signDark,this.foot,this.wire])Object.assign(n,{transparent:!0,opacity:.3,depthWrite:!1});this.recolour(e)}ghost;body;own=[];edge;sign;signDark;foot;wire;bodyOf(e){let t=this.body.clone();return this.ghost||t.color.set(e),this.own.push(t),t}recolour(e){if(this.edge.color.set(e.dark?"#0b0f14":"#1b2430"),this.sign.color.set(e.dark?"#dfe6ee":"#ffffff"),this.signDark.color.set(e.dark?"#aab6c4":"#39434f"),this.foot.color.set(e.dark?"#566272":"#9aa5b2"),this.wire.color.set(e.dark?"#c2ccd8":"#56616f"),this.ghost)for(let t of[this.body,...this.own])t.color.set(e.soft)}};var Au=class{constructor(e){this.stage=e;this.bodies=e.bodies.map(SA)}stage;bodies;body(e){return this.atMost(this.bodies[e]??0)}joint(e){return this.between(e.bodies)}between(e){let t=e.map(n=>this.bodies[n]??0).filter(n=>n>0);return this.atMost(t.length?Math.min(...t):0)}atMost(e){return e>1e-9*this.stage.size?Math.min(this.stage.size,6*e):this.stage.size}};function SA(i){let e=[...i.held,i.centre_of_mass],t=[0,1,2].map(n=>{let s=e.map(r=>r[n]);return s.reduce((r,o)=>Math.max(r,o))-s.reduce((r,o)=>Math.min(r,o))});return Math.max(Math.hypot(...t),...i.parts.map(TA))}function TA(i){let[e=0,t=0,n=0]=i.size;switch(i.kind){case"box":return Math.max(e,t,n);case"sphere":return 2*e;case"ellipsoid":return 2*Math.max(e,t,n);case"cylinder":case"capsule":return Math.max(2*e,t);case"tube":return Math.max(2*e,n);case"extrusion":return Math.max(e,...i.outline.map(([s,r])=>2*Math.hypot(s,r)));case"mesh":return 0}}var AA=.021,jy=new S(0,0,1);function zp(i,e,t,n){if(i.rod)return[];let s=AA*t,r=new S(...i.points[i.place]),o=new S(...i.slot&&i.place===1?i.slot:i.axes[i.place]).normalize(),a=new Qe().compose(r,new nt().setFromUnitVectors(jy,o),new S(1,1,1)),l=RA(i.kind,s,n).map(({tone:u,geometry:d})=>({tone:u,geometry:d.applyMatrix4(a),standing:!1})),c=i.bodies[0]<0?0:i.bodies[1]<0?1:-1,h=c<0?[]:PA(i,c,e,s).map(u=>({tone:"foot",geometry:u,standing:!0}));return[...l,...h]}function RA(i,e,t){let n=a=>({tone:"sign",geometry:a}),s=a=>({tone:"signDark",geometry:a}),r=(a,l)=>new Jt(a,a,l,t).rotateX(Math.PI/2),o=a=>new on(a,t,Math.round(.7*t));switch(i){case"revolute":return[n(r(.95*e,1.9*e)),s(r(.42*e,2.7*e))];case"cylindrical":return[n(r(.95*e,1.9*e)),s(r(.42*e,4.4*e))];case"screw":{let a=[-.6,0,.6].map(l=>s(new Ci(.95*e,.14*e,8,24).translate(0,0,l*e)));return[n(r(.9*e,1.9*e)),s(r(.42*e,4.4*e)),...a]}case"translational":return[n(new pn(1.7*e,1.7*e,2.8*e))];case"spherical":return[n(o(1.1*e))];case"universal":return[s(r(.36*e,2.8*e)),s(r(.36*e,2.8*e).rotateX(Math.PI/2)),n(o(.62*e))];case"fixed":return[s(new pn(1.5*e,1.5*e,1.5*e))];case"planar":return[n(new pn(4.2*e,4.2*e,.3*e))];case"point-on-beam":case"keyed-on-beam":return[n(o(.9*e)),...i==="keyed-on-beam"?[s(new pn(2.6*e,.5*e,.5*e))]:[]];case"cylindrical-on-beam":return[n(r(1.1*e,2.8*e)),s(r(.5*e,3.4*e))];case"translational-on-beam":return[n(new pn(1.9*e,1.9*e,2.8*e))];case"point-on-line":return[s(r(.22*e,6*e)),n(o(.8*e))];case"point-on-plane":return[n(new pn(4.2*e,4.2*e,.16*e)),s(o(.7*e))];default:return[n(o(.9*e))]}}var CA=["translational","cylindrical","screw","point-on-line"];function PA(i,e,t,n){let s=new S(...i.points[e]),r=new S(...t.up),o=new S(1,1,1);if(CA.includes(i.kind)||i.slot){let u=new S(...i.slot??i.axes[e]).normalize(),d=Math.max(.62*IA(u,t),4*n),f=new S(...t.low).add(new S(...t.high)).multiplyScalar(.5).add(new S(...t.origin)),p=Math.max(Math.min(f.sub(s).dot(u),d-3*n),3*n-d),v=new Jt(.24*n,.24*n,2*d,12).rotateX(Math.PI/2),g=new nt().setFromUnitVectors(jy,u);return[v.applyMatrix4(new Qe().compose(s.addScaledVector(u,p),g,o))]}let a=new nt().setFromUnitVectors(new S(0,1,0),r),l=new gi(1.5*n,2.5*n,4,1).rotateY(Math.PI/4).translate(0,-2*n,0),c=new pn(3.4*n,.3*n,3.4*n).translate(0,-3.35*n,0),h=new Qe().compose(s,a,o);return[l.applyMatrix4(h),c.applyMatrix4(h)]}function IA(i,e){let t=new S(...e.high).sub(new S(...e.low));return .5*(Math.abs(i.x)*t.x+Math.abs(i.y)*t.y+Math.abs(i.z)*t.z)}var LA=.16,Zy=1.015,NA={x:0,y:1,z:2};function Ky(i){let[e=1,t=1,n=1]=i.size,s;if(i.kind==="cylinder")s=Jy(.3*e,e,t);else if(i.kind==="tube")s=Jy(t,e,n);else if(i.kind==="sphere")s=new Ci(e,.03*e,6,32,Math.PI);else return null;let r=NA[i.along]??2;return r===0?s.rotateY(Math.PI/2):r===1&&s.rotateX(-Math.PI/2),s.translate(...i.centre)}function Jy(i,e,t){let n=Zy*e-i;return new pn(n,LA*e,t+2*(Zy-1)*e).translate(i+.5*n,0,0)}function Qy(i){let e=new et(i),{h:t,s:n,l:s}=e.getHSL({h:0,s:0,l:0});return`#${e.setHSL(t,n,s>.25?.55*s:s+.3).getHexString()}`}var DA=.0042,ev=.0024,tv=new S(0,1,0),FA=new S(0,0,1),nv=new S(1,1,1);function iv(i){let e={moving:[],pieces:zr()};for(let t of i.stage.couplings){let n={kind:"coupling",name:t.name},s=(r,o)=>e.pieces.wire.push({geometry:r,body:-1,holder:i.holder(o),said:n});for(let r of t.wheels)for(let o of OA(r,sv(i,r)))s(o,r.body);for(let{body:r,point:o,along:a,half:l}of t.tracks){let c=new nt().setFromUnitVectors(tv,new S(...a).normalize()),h=new Jt(.02*l,.02*l,2*l,8);s(h.applyMatrix4(new Qe().compose(new S(...o),c,nv)),r)}t.belt!=="none"&&e.moving.push(...UA(i,t,n,e.pieces.wire)),e.moving.push(...kA(i,t,n,e.pieces.wire))}return e}var sv=(i,e)=>Math.min(2.5*DA*e.radius+.3*ev*i.stage.size,.2*e.radius);function OA({centre:i,axis:e,radius:t},n){let s=new nt().setFromUnitVectors(FA,new S(...e).normalize()),r=new Qe().compose(new S(...i),s,nv),o=new Jt(.6*n,.6*n,.22*t,8).translate(0,.89*t,0);return[new Ci(t,n,8,72),o].map(a=>a.applyMatrix4(r))}function rv(i,e,t,n,s){let r=new cn,o=new Jt(i,i,1,8).translate(0,.5,0);t.push({geometry:o,body:-1,holder:r,said:e});let a=new S,l=new S;return{object:r,update(){if(r.visible=!n(),!r.visible)return;s(a,l),r.position.copy(a);let c=l.sub(a).length();r.scale.set(1,Math.max(c,1e-12),1),c>0&&r.quaternion.setFromUnitVectors(tv,l.divideScalar(c))}}}function UA(i,{wheels:e,belt:t},n,s){let[r,o]=e;if(!r||!o)return[];let a=t==="crossed"?-1:1,l=new S,c=new S,h=new S,u=new S;return[1,-1].map(d=>rv(sv(i,r),n,s,()=>e.some(({body:f})=>i.isBad[f]),(f,p)=>{l.set(...r.axis).applyQuaternion(i.holder(r.body).quaternion).normalize(),i.place(r.body,r.centre,c),i.place(o.body,o.centre,h).sub(c);let v=h.dot(l);h.addScaledVector(l,-v);let g=h.length();h.divideScalar(g||1),u.crossVectors(l,h);let m=Math.min(Math.max((r.radius-a*o.radius)/(g||1),-1),1),y=d*Math.sqrt(1-m*m);f.copy(c).addScaledVector(h,r.radius*m).addScaledVector(u,r.radius*y),p.copy(c).addScaledVector(l,v).addScaledVector(h,g+a*o.radius*m),p.addScaledVector(u,a*o.radius*y)}))}function kA(i,e,t,n){return e.joined.slice(1).map((s,r)=>{let o=e.joined[r];return rv(ev*i.stage.size,t,n,()=>i.isBad[o.body]||i.isBad[s.body]||!1,(a,l)=>{i.place(o.body,o.point,a),i.place(s.body,s.point,l)})})}var BA=20,HA=new S(0,0,1);function Vp(i,e,t,n){let s=e.points[0],r=e.bodies[0];if(!s||r===void 0)return;let o=new nt().setFromUnitVectors(HA,new S(...e.axis??[0,0,1]).normalize()),a=new Qe().compose(new S(...s),o,new S(1,1,1)),l=i.nearness.between(e.bodies);for(let[c,h]of zA(e,l,i.stage.forces.length>BA))n[c].push({geometry:h.applyMatrix4(a),thin:!0,body:r,holder:i.holder(r),said:{kind:t,name:e.name}})}function zA(i,e,t){switch(i.look){case"coil":return[["wire",VA(e,t)]];case"bushing":return[["signDark",new Ci(.02*e,.009*e,12,28)]];case"turn":return GA(e);case"slide":return WA(e);case"ring":return[["wire",new Ci(.034*e,.0045*e,8,t?20:36)]];case"dot":return[["wire",new ol(.015*e)]];default:return[]}}function VA(i,e){let t=Array.from({length:80},(n,s)=>{let r=s/79*5*Math.PI,o=i*(.012+.026*(s/79));return new S(o*Math.cos(r),o*Math.sin(r),0)});return new Fr(new hr(t),e?50:120,.0036*i,e?4:6)}function GA(i){let e=.036*i,t=1.5*Math.PI,n=new gi(.0125*i,.028*i,14).translate(0,.01*i,0);return n.rotateZ(t).translate(e*Math.cos(t),e*Math.sin(t),0),[["wire",new Ci(e,.0045*i,8,30,t)],["wire",n]]}function WA(i){let[e,t]=[.045*i,.036*i],n=new Jt(.0045*i,.0045*i,2*e,10).rotateX(Math.PI/2),s=[1,-1].map(r=>new gi(.0125*i,.028*i,14).rotateX(r*Math.PI/2).translate(0,0,r*e));return[n,...s].map(r=>["wire",r.translate(t,0,0)])}var ov=12,XA=.12;function av(i,e,t){let[n=0,s=0,r=0]=e.sizes,[o,,a]=e.bodies,l={kind:"force",name:e.name},[c,h]=[0,1].map(P=>new S(...e.points[P])),u=c.clone().sub(h),d=u.length();u.normalize();let f=new S(...e.axis??[0,0,1]).cross(u).normalize(),p=u.clone().cross(f),v=Math.PI*n,g=2*(d+v),m=Math.max(Math.round(g*ov/(2*v)),3),y=g/m,b=new Nt,x=Array.from({length:m},()=>{let P=new cn;return b.add(P),t.pieces.foot.push({geometry:new pn((1-XA)*y,s,r),body:-1,holder:P,parent:b,said:l}),P}),T=new S,M=new S,_=new Qe,w=(P,I)=>{let U=I<d+v,H=U?I:I-d-v,L=Math.max(H-d,0)/n,k=U?1:-1;T.copy(u).multiplyScalar(-k*Math.cos(L)).addScaledVector(p,k*Math.sin(L)),M.copy(p).multiplyScalar(-k*Math.cos(L)).addScaledVector(u,-k*Math.sin(L)),P.position.copy(U?c:h).addScaledVector(u,-k*Math.min(H,d)),P.position.addScaledVector(p,n+.5*r).addScaledVector(M,n),_.makeBasis(T,f,T.clone().cross(f)),P.quaternion.setFromRotationMatrix(_)},N=new nt;t.moving.push({object:b,update(){if(b.visible=!e.bodies.some(U=>i.isBad[U]),!b.visible)return;i.place(o,[0,0,0],b.position),b.quaternion.copy(i.holder(o).quaternion),N.copy(b.quaternion).invert().multiply(i.holder(a).quaternion);let I=(2*Math.atan2(N.x*f.x+N.y*f.y+N.z*f.z,N.w)*ov/(2*Math.PI)%1+1)%1;x.forEach((U,H)=>w(U,(H+I)*y))}})}var Gp=24,Ru=class{constructor(e,t,n,s){this.actor=e;this.force=t;this.winding=n;this.motion=s;this.most=t.points.length-1+Gp*n.radii.filter(r=>r).length,this.near=[...n.arcs]}actor;force;winding;motion;most;near;table=null;x=new S;y=new S;axis=new S;points(){let{motion:e,actor:t}=this;e&&e.count>1&&(this.table??=this.follow(e),this.table[e.at(t.time)].forEach((s,r)=>this.near[r]=s));let n=this.layOut(t.frame);return n.flatMap((s,r)=>this.around(s,n[r-1]??null))}follow(e){let t=new Float32Array(e.layout.width);return Array.from({length:e.count},(n,s)=>(e.sample(e.time[s],t),this.layOut(t),[...this.near]))}layOut(e){let{actor:t,force:n,winding:s,axis:r,x:o,y:a}=this;t.turnIn(e,n.bodies[s.carrier],s.axis,r).normalize(),o.set(Math.abs(r.x)<.6?1:0,Math.abs(r.x)<.6?0:1,0).cross(r).normalize(),a.crossVectors(r,o);let l=n.points.map((d,f)=>{let p=t.placeIn(e,n.bodies[f],d,new S);return{number:f,centre:p,x:p.dot(o),y:p.dot(a),radius:s.radii[f],ux:0,uy:0,arc:0}}),c=[l[0],l[l.length-1]],h=c.map(({number:d},f)=>t.turnIn(e,n.bodies[d],s.fixed[f],new S));if(this.find(l,h),l.forEach(({arc:d,number:f})=>{Number.isFinite(d)&&(this.near[f]=d)}),l.every(({arc:d})=>d>=0))return l;let u=l.filter(d=>c.includes(d)||d.arc>=0);return c.forEach((d,f)=>{d.arc>=0||(d.centre.addScaledVector(h[f],Math.abs(d.radius)),Object.assign(d,{x:d.centre.dot(o),y:d.centre.dot(a),radius:0}))}),this.find(u,h),u}find(e,t){for(let n=1;n<e.length;n++){let[s,r]=[e[n-1],e[n]],[o,a,l]=[r.x-s.x,r.y-s.y,r.radius-s.radius],c=o*o+a*a,h=Math.sqrt(Math.max(c-l*l,0));s.ux=(o*h+a*l)/c,s.uy=(a*h-o*l)/c}e.forEach((n,s)=>{let r=Math.sign(n.radius),o=e[s-1],a=s===e.length-1;if(n.arc=0,!r)return;if(o&&!a){n.arc=this.next(n,r*(o.ux*n.uy-o.uy*n.ux),o.ux*n.ux+o.uy*n.uy);return}let{ux:l,uy:c}=o??n,[h,u]=[r*c,-r*l],d=t[o?1:0],[f,p]=[d.dot(this.x),d.dot(this.y)];n.arc=this.next(n,(o?-r:r)*(f*u-p*h),f*h+p*u)})}next({number:e},t,n){let s=Math.atan2(t,n);return s+2*Math.PI*Math.round((this.near[e]-s)/(2*Math.PI))}around(e,t){let{centre:n,radius:s}=e;if(!s)return[n];let{ux:r,uy:o}=t??e,a=Math.min(e.arc,2*Math.PI)*Math.sign(s),l=Math.atan2(-s*r,s*o)-(t?0:a);return Array.from({length:Gp+1},(c,h)=>{let u=l+a*h/Gp;return n.clone().addScaledVector(this.x,Math.abs(s)*Math.cos(u)).addScaledVector(this.y,Math.abs(s)*Math.sin(u))})}};var qA=.0042,YA=.021,cv=.0075,$A=.0135,hv=.0016,jA=.012,lv=9,ZA=["spring","damper","spring-damper","cylinder"],JA=20,Cu=new S(0,0,1);function uv(i,e){let t={moving:[],pieces:zr()};for(let n of i.stage.joints)n.rod&&KA(i,n,t);for(let n of i.stage.forces)n.look==="plane"?t.moving.push(rR(i,n)):n.winding?tR(i,n,n.winding,e,t):n.look==="rope"?eR(i,n,t):n.look==="track"?av(i,n,t):ZA.includes(n.look)?iR(i,n,t):Vp(i,n,"force",t.pieces);for(let n of i.stage.drivers)Vp(i,n,"driver",t.pieces);return t}function Wp(i,e,t,n,s){let r=new S,o=new S;return{object:n,update(){i.place(e[0],t[0],r),i.place(e[1],t[1],o);let a=e.some(c=>i.isBad[c]);if(n.visible=!a,a)return;n.position.copy(r);let l=o.sub(r).length();l>0&&n.quaternion.setFromUnitVectors(Cu,o.divideScalar(l)),s(Math.max(l,1e-9*i.stage.size))}}}function br(i,e,t,n,s){let r=new cn;return i.add(r),s.pieces[e].push({geometry:t,body:-1,holder:r,parent:i,said:n}),r}var Ul=(i,e=18)=>new Jt(i,i,1,e).rotateX(Math.PI/2).translate(0,0,.5);function KA(i,e,t){let n=i.nearness.atMost(dv(i,e.bodies,e.points)),s={kind:"joint",name:e.name},r=new Nt;Pu(i,e.bodies,e.points,s,t);let o=br(r,"foot",Ul(cv*n),s,t),a=[0,1].map(()=>br(r,"sign",new on(.016*n,20,14),s,t));t.moving.push(Wp(i,e.bodies,e.points,r,l=>{o.scale.z=l,a[1].position.z=l}))}function Pu(i,e,t,n,s){let r=t.map((o,a)=>i.place(e[a],o,new S));e.forEach((o,a)=>{if(o>=0)return;let l=e.findIndex((u,d)=>u>=0&&Math.abs(d-a)===1),c=l<0?new S(...i.stage.up).negate():r[a].clone().sub(r[l]),h=i.nearness.atMost(c.length());for(let u of QA(jA*h)){let d=new nt().setFromUnitVectors(Cu,c.clone().normalize());u.applyMatrix4(new Qe().compose(new S(...t[a]),d,new S(1,1,1))),s.pieces.foot.push({geometry:u,body:-1,holder:i.ground,said:n})}})}function QA(i){let e=new gi(1.5*i,2.5*i,4,1).rotateX(-Math.PI/2).rotateZ(Math.PI/4).translate(0,0,1.25*i),t=new pn(3.4*i,3.4*i,.3*i).translate(0,0,2.65*i);return[e,t]}function eR(i,e,t){let n={kind:"force",name:e.name};Pu(i,e.bodies,e.points,n,t);for(let s=1;s<e.points.length;s++){let r=e.bodies.slice(s-1,s+1),o=e.points.slice(s-1,s+1),a=new Nt,l=br(a,"signDark",Ul(hv*i.stage.size),n,t);t.moving.push(Wp(i,r,o,a,c=>l.scale.z=c))}}function tR(i,e,t,n,s){let r={kind:"force",name:e.name},o=new Nt,a=new Ru(i,e,t,n),l=Array.from({length:a.most},()=>br(o,"signDark",Ul(hv*i.stage.size,8),r,s)),c=new S;Pu(i,e.bodies,e.points,r,s),s.moving.push({object:o,update(){if(o.visible=!e.bodies.some(u=>i.isBad[u]),!o.visible)return;let h=a.points();l.forEach((u,d)=>{let[f,p]=[h[d],h[d+1]];if(u.visible=!!f&&!!p,!f||!p)return;let v=c.copy(p).sub(f).length();u.position.copy(f),u.scale.z=Math.max(v,1e-9*i.stage.size),v>0&&u.quaternion.setFromUnitVectors(Cu,c.divideScalar(v))})}})}function nR(i,e,t,n){let s=[],r=lv*(n?8:16);for(let a=0;a<=r;a++){let l=a/r,c=2*Math.PI*lv*l,h=Math.min(1,6*l,6*(1-l));s.push(new S(h*i*Math.cos(c),h*i*Math.sin(c),t*(.04+.92*l)))}s.unshift(new S(0,0,0)),s.push(new S(0,0,t));let o=new hr(s,!1,"catmullrom",.3);return new Fr(o,r,e,n?4:6).scale(1,1,1/t)}function iR(i,e,t){let n=sR(i,e),s=i.nearness.atMost(n),r={kind:"force",name:e.name},o=new Nt;Pu(i,e.bodies,e.points,r,t);let a=e.look==="spring"||e.look==="spring-damper",l=e.look==="cylinder",c=i.stage.forces.length>JA,[h=(l?1.35:.8)*$A*s,u=.55*cv*s*(l?1.5:1),d=.58*n]=e.sizes,f=a?br(o,"wire",nR(YA*s,qA*s,n,c),r,t):null,p=e.look==="spring"?null:br(o,"foot",Ul(h),r,t),v=p?br(o,"sign",Ul(u),r,t):null,g=[0,1].map(()=>br(o,"signDark",new on(e.sizes.length?1.1*u:.008*s,14,10),r,t));t.moving.push(Wp(i,e.bodies,e.points,o,m=>{f&&(f.scale.z=m),p&&v&&(p.scale.z=Math.min(d,.92*m),v.scale.z=m),g[1].position.z=m}))}function sR(i,e){let t=dv(i,e.bodies,e.points);return t>1e-6*i.stage.size?t:.2*i.stage.size}function dv(i,e,t){let[n,s]=[0,1].map(r=>i.place(e[r],t[r],new S));return n.distanceTo(s)}function rR(i,e){let t=1.6*Math.max(i.stage.size,new S(...i.stage.high).distanceTo(new S(...i.stage.low))*.6),n=new ai({color:9412787,transparent:!0,opacity:.16,side:wn,depthWrite:!1}),s=new wt(new Vs(t,t),n);s.userData={kind:"force",name:e.name};let r=new Nt,o=new S(...e.axis??[0,0,1]).normalize();s.quaternion.setFromUnitVectors(Cu,o),r.add(s);let a=new S,l=new S,c=new S,h=e.bodies[1],u={offset:null};return{object:r,update(){if(r.visible=!i.isBad[h],i.place(h,e.points[1],a),!u.offset){i.place(e.bodies[0],e.points[0],l);let d=c.copy(o).applyQuaternion(i.holder(h).quaternion);u.offset=l.sub(a).addScaledVector(d,-l.dot(d)).applyQuaternion(i.holder(h).quaternion.clone().invert()),Number.isFinite(u.offset.lengthSq())||u.offset.set(0,0,0)}r.quaternion.copy(i.holder(h).quaternion),r.position.copy(u.offset).applyQuaternion(r.quaternion).add(a)}}}var Xp=class{constructor(e,t){this.record=e;this.strain=t.rounded(e.strain),this.values=new Float32Array(e.places.length)}record;values;strain;set(e,t,n,s){let[,r=0,o=0]=this.record.strain.numbers.shape,a=new Float64Array(6);for(let l=0;l<o;l++){for(let h=0;h<6;h++){let u=h*r*o+l;a[h]=(1-s)*this.strain[u+t*o]+s*this.strain[u+n*o]}let c=e.rows.map(h=>h<6?a[h]:this.record.stiffness[h-6].reduce((u,d,f)=>u+d*a[f],0));this.values[l]=c.length===1?c[0]:Math.hypot(...c)}}at(e){let{places:t}=this.record,n=0;for(;n<t.length&&t[n]<e;)n++;if(n===0)return this.values[0];if(n===t.length)return this.values[n-1];let s=(e-t[n-1])/(t[n]-t[n-1]);return this.values[n-1]+s*(this.values[n]-this.values[n-1])}},Iu=class{quantities;shown=null;time;beams=new Map;constructor(e,t){this.quantities=e.sections?.quantities??[],this.time=e.sections?t.times(e.sections.time):new Float64Array;for(let n of e.sections?.beams??[])this.beams.set(n.sweep,new Xp(n,t))}of(e){return this.shown?this.beams.get(e)??null:null}show(e){this.shown=this.quantities.find(t=>t.name===e)??null}moveTo(e){if(!this.shown)return;let t=0;for(;t+1<this.time.length&&this.time[t+1]<=e;)t++;let n=Math.min(t+1,this.time.length-1),s=this.time[n]-this.time[t],r=s>0?Math.min(Math.max((e-this.time[t])/s,0),1):0;for(let o of this.beams.values())o.set(this.shown,t,n,r)}};var oR=240,aR=500,lR=10,cR=Math.cos(35*Math.PI/180),qp=new S(1,0,0),Lu=class{constructor(e,t,n){this.actor=t;this.material=n;this.kept=hR(e.bodies.length);let s=uR(e,this.kept);this.record=s;let r=s.bodies.length-1;this.steps=s.smooth?Math.min(Math.max(Math.floor(oR/r),1),lR):1,this.corners=[...fv(s.section,1),...fv(s.hollow,-1)],this.caps=[...s.section,...s.hollow],this.turns=s.bodies.map((c,h)=>pR(s.axes[h],s.across[h]));let o=r*this.steps+1,a=o*this.corners.length+2*this.caps.length,l=new St;l.setAttribute("position",new kt(new Float32Array(3*a),3)),l.setAttribute("normal",new kt(new Float32Array(3*a),3)),l.setAttribute("color",new kt(new Float32Array(3*a).fill(1),3)),l.setIndex(this.triangles(o)),this.mesh=new wt(l,n),this.mesh.castShadow=!n.transparent,this.mesh.frustumCulled=!1}actor;material;mesh;corners;caps;steps;turns;kept;painted=new Gs({vertexColors:!0,shininess:20,specular:1710618,side:wn});record;nearest(e){let t=new S,n=this.actor.root.worldToLocal(e.clone()),s=this.record.bodies.map((o,a)=>this.actor.place(o,this.record.points[a],t).distanceTo(n)),r=this.record.bodies[s.indexOf(Math.min(...s))];return{kind:"body",name:this.actor.stage.bodies[r].name}}around(e){let t=this.record.bodies.findIndex(l=>this.actor.stage.bodies[l].name===e);if(t<0)return null;let n=new St;for(let l of["position","normal"])n.setAttribute(l,this.mesh.geometry.getAttribute(l));n.setIndex(this.mesh.geometry.index);let s=Math.max(t-.5,0),r=Math.min(t+.5,this.record.bodies.length-1),o=3*this.corners.length,a=o*Math.floor(s*this.steps);return n.setDrawRange(a,o*Math.ceil(r*this.steps)-a),n}*extent(){for(let[e,t]of this.record.bodies.entries())for(let[n,s]of this.record.section)yield[t,new S(0,n,s).applyQuaternion(this.turns[e]).add(new S(...this.record.points[e]))]}update(){let{bodies:e,points:t}=this.record;if(this.mesh.visible=e.every(d=>!this.actor.isBad[d]),!this.mesh.visible)return;let n=e.map((d,f)=>this.actor.place(d,t[f],new S)),s=e.map((d,f)=>this.actor.holder(d).quaternion.clone().multiply(this.turns[f])),r=new S,o=new S,a=new nt,l=new nt,c=0;for(let d=0;d+1<e.length;d++)for(let f=0;f<this.steps;f++){let p=f/this.steps;fR(p,n[d],n[d+1],s[d],s[d+1],this.record.smooth,r,o),a.slerpQuaternions(s[d],s[d+1],p),this.record.smooth&&o.lengthSq()>0&&a.premultiply(l.setFromUnitVectors(qp.clone().applyQuaternion(a),o.normalize())),this.ring(c++,r,a)}let h=e.length-1;this.ring(c,n[h],s[h]);let u=(c+1)*this.corners.length;this.cap(u,n[0],s[0],-1),this.cap(u+this.caps.length,n[h],s[h],1);for(let d of["position","normal"])this.mesh.geometry.getAttribute(d).needsUpdate=!0;this.mesh.geometry.boundingSphere=null}paint(e,t,n){if(this.mesh.material=e?this.painted:this.material,!e)return;let s=this.mesh.geometry.getAttribute("color"),r=s.array,o=n>t?n-t:1,a=(this.record.bodies.length-1)*this.steps+1,l=(h,u,d)=>{bu((e.at(d)-t)/o,r,3*h);for(let f=1;f<u;f++)r.copyWithin(3*(h+f),3*h,3*h+3)};for(let h=0;h<a;h++)l(h*this.corners.length,this.corners.length,this.placeOf(h));let c=a*this.corners.length;l(c,this.caps.length,0),l(c+this.caps.length,this.caps.length,this.kept.at(-1)),s.needsUpdate=!0}placeOf(e){let t=Math.min(Math.floor(e/this.steps),this.kept.length-1),[n,s]=[this.kept[t],this.kept[t+1]??this.kept[t]];return n+(s-n)*(e-t*this.steps)/this.steps}ring(e,t,n){this.corners.forEach(({at:[s,r],normal:[o,a]},l)=>this.vertex(e*this.corners.length+l,t,n,s,r,0,o,a))}cap(e,t,n,s){this.caps.forEach(([r,o],a)=>this.vertex(e+a,t,n,r,o,s,0,0))}vertex(e,t,n,s,r,o,a,l){let{position:c,normal:h}=this.mesh.geometry.attributes,u=dR.set(0,s,r).applyQuaternion(n).add(t);c.setXYZ(e,u.x,u.y,u.z),u.set(o,a,l).applyQuaternion(n),h.setXYZ(e,u.x,u.y,u.z)}triangles(e){let t=[],n=this.corners.length;for(let c=0;c+1<e;c++)for(let h=0;h<n;h+=2){let[u,d]=[c*n+h,c*n+h+1];t.push(u,d,d+n,u,d+n,u+n)}let s=this.record.section.map(([c,h])=>new ue(c,h)),r=this.record.hollow.map(([c,h])=>new ue(c,h)),o=Os.triangulateShape(s,r.length?[r]:[]),a=e*n;for(let[c,h,u]of o)t.push(a+c,a+u,a+h);let l=a+this.caps.length;for(let[c,h,u]of o)t.push(l+c,l+h,l+u);return t}};function hR(i){let e=Math.min(i,aR);return Array.from({length:e},(t,n)=>Math.round(n*(i-1)/(e-1)))}function uR(i,e){let t=n=>e.map(s=>n[s]);return{...i,bodies:t(i.bodies),points:t(i.points),axes:t(i.axes),across:t(i.across)}}var dR=new S;function fR(i,e,t,n,s,r,o,a){if(!r){o.lerpVectors(e,t,i),a.subVectors(t,e);return}let l=e.distanceTo(t),c=qp.clone().applyQuaternion(n).multiplyScalar(l),h=qp.clone().applyQuaternion(s).multiplyScalar(l),[u,d]=[i*i,i*i*i];o.copy(e).multiplyScalar(2*d-3*u+1).addScaledVector(t,3*u-2*d).addScaledVector(c,d-2*u+i).addScaledVector(h,d-u),a.subVectors(t,e).multiplyScalar(6*(i-u)).addScaledVector(c,3*u-4*i+1).addScaledVector(h,3*u-2*i)}function pR(i,e){let t=new S(...i).normalize(),n=new S(...e);return n.addScaledVector(t,-n.dot(t)),n.lengthSq()<1e-12&&n.set(t.z,t.x,t.y).cross(t),n.normalize(),new nt().setFromRotationMatrix(new Qe().makeBasis(t,n,new S().crossVectors(t,n)))}function fv(i,e){let t=i.length,s=i.reduce((o,[a,l],c)=>o+a*i[(c+1)%t][1]-i[(c+1)%t][0]*l,0)*e<0?[...i].reverse():i,r=s.map(([o,a],l)=>{let[c,h]=s[(l+1)%t],u=Math.hypot(c-o,h-a)||1;return[(h-a)/u,(o-c)/u]});return s.flatMap((o,a)=>{let l=r[a],c=h=>{if(l[0]*h[0]+l[1]*h[1]<cR)return l;let u=Math.hypot(l[0]+h[0],l[1]+h[1]);return[(l[0]+h[0])/u,(l[1]+h[1])/u]};return[{at:o,normal:c(r[(a+t-1)%t])},{at:s[(a+1)%t],normal:c(r[(a+1)%t])}]})}var pv=.013,mR=.008,gR=1e30,yR=40,kl=20,Bl=6,vR=6,xR=.75,_R=new S,mv=new nt,Hl=class{constructor(e,t,n,s,r){this.stage=e;this.isGhost=r;this.palette=new Tu(n,r),this.nearness=new Au(e),this.frame=new Float32Array(e.layout.width),this.isBad=e.bodies.map(()=>!1),this.levels=new Uint8Array(e.bodies.length),this.ground.position.copy(this.origin).negate(),this.root.add(this.ground);for(let[h,u]of e.bodies.entries())this.bodies.push(new Nt),this.root.add(this.bodies[h]),this.build(h,u,t);s?.sample(s.start,this.frame),this.pose();let{moving:o,pieces:a}=uv(this,s),l=r?{moving:[],pieces:zr()}:iv(this);this.stretching=[...o,...l.moving];for(let h of this.stretching)this.root.add(h.object);this.fill(this.solids,this.palette.body,this.batches);let c=this.signs();for(let h of Hp)c[h].push(...l.pieces[h]),this.fill(c[h],this.palette[h],this.signBatches),this.fill(a[h],this.palette[h],this.batches);this.pieces=[...this.solids,...Hp.flatMap(h=>[...c[h],...a[h]])],this.swept=e.sweeps.map(h=>new Lu(h,this,this.palette.bodyOf(h.colour)));for(let h of this.swept)this.root.add(h.mesh);this.sections=new Iu(e,t),this.bones=this.isLarge?new xu(this,r):null,this.bones&&this.root.add(this.bones.object),this.recolour(n),this.deforming=e.flexible.map(h=>new Mu(h,t,r,e.size));for(let h of this.deforming)this.holder(h.record.body).add(h.mesh),this.bending.set(h.record.body,h)}stage;isGhost;root=new Nt;bodies=[];ground=new Nt;palette;deforming;swept;sections;time=0;nearness;frame;isBad;solids=[];pieces;levels;bones;stretching;batches=[];signBatches=[];edges=[];extras=new Su(this);bending=new Map;marked=[];holder(e){return this.bodies[e]??this.ground}place(e,t,n){let s=this.holder(e);return this.bent(e,t,this.frame,n,this.bending.get(e)?.exaggeration),n.applyQuaternion(s.quaternion).add(s.position)}placeIn(e,t,n,s){if(t<0)return s.set(...n).add(this.ground.position);let[r,o,a,l,c,h,u]=e.subarray(7*t,7*t+7);return this.bent(t,n,e,s,this.bending.get(t)?.exaggeration),s.applyQuaternion(mv.set(c,h,u,l).normalize()),s.set(s.x+r,s.y+o,s.z+a)}turnIn(e,t,n,s){if(s.set(...n),t<0)return s;let[r,o,a,l]=e.subarray(7*t+3,7*t+7);return s.applyQuaternion(mv.set(o,a,l,r).normalize())}bent(e,t,n,s,r=1){let o=this.bending.get(e);return o?o.carried(t,n,7*this.stage.layout.bodies,s).multiplyScalar(r).add(_R.set(...t)):s.set(...t)}get origin(){return new S(...this.stage.origin)}vector(e,t){let{bodies:n,modes:s}=this.stage.layout,r=7*n+s+3*e;return t.set(this.frame[r],this.frame[r+1],this.frame[r+2])}apply(){this.pose();for(let s of[...this.stretching,...this.swept])s.update();this.sections.moveTo(this.time);let{low:e=0,high:t=0}=this.sections.shown??{};this.swept.forEach((s,r)=>s.paint(this.sections.of(r),e,t)),this.arrange(),this.bones?.update();let n=7*this.stage.layout.bodies;for(let s of this.deforming)s.update(this.frame,n)}look(e,t){if(!this.isLarge)return;let n=new S,s=.5*t/Math.tan(ci.degToRad(e.fov/2)),r=!1;e.updateMatrixWorld(),this.bodies.forEach((o,a)=>{let l=this.nearness.body(a);n.copy(o.position).add(this.root.position).applyMatrix4(e.matrixWorldInverse);let c=Math.max(-n.z,.1*l),h=pv*l*s/c,u=(.5*l+c*Math.tan(ci.degToRad(e.fov/2)))*1.05,f=n.z>l||Math.abs(n.y)>u||Math.abs(n.x)>u*Math.max(e.aspect,1)?Lp:h>vR?pu:h>xR?Fy:Nl;f!==this.levels[a]&&(r=!0),this.levels[a]=f}),r&&this.arrange()}get isLarge(){return this.stage.bodies.length>yR}arrange(){for(let e of[...this.batches,...this.signBatches])e.update(this.levels);this.extras.update(this.levels)}pose(){this.bodies.forEach((e,t)=>{let n=7*t,[s,r,o,a,l,c,h]=[0,1,2,3,4,5,6].map(d=>this.frame[n+d]),u=Number.isFinite(a+l+c+h)&&Math.max(Math.abs(s),Math.abs(r),Math.abs(o))<=gR;this.isBad[t]=!u,e.visible=u,u&&(e.position.set(s,r,o),e.quaternion.set(l,c,h,a).normalize())})}show(e,t){if(e==="signs")for(let n of this.signBatches)n.mesh.visible=t;else if(e==="edges")for(let n of this.edges)n.visible=t;else this.extras.show(e,t)}recolour(e){this.palette.recolour(e),this.bones?.recolour(e.soft)}mark(e,t){for(let o of this.marked)o.removeFromParent();if(this.marked=[],!e)return;let n=new Rn({color:t.accent,transparent:!0,opacity:.34,depthTest:e.kind==="body",polygonOffset:!0,polygonOffsetFactor:-1,polygonOffsetUnits:-1}),s=o=>o.kind===e.kind&&o.name===e.name,r=this.pieces.filter(({said:o})=>s(o)).map(({geometry:o,holder:a})=>[o,a]);this.root.traverse(o=>{o instanceof wt&&s(o.userData)&&r.push([o.geometry,o])});for(let o of e.kind==="body"?this.swept:[]){let a=o.around(e.name);a&&r.push([a,o.mesh])}for(let[o,a]of r){let l=new wt(o,n);a.add(l),this.marked.push(l)}}get bodyMeshes(){return this.batches.map(({mesh:e})=>e)}said(e){let t=[...this.batches,...this.signBatches].find(({mesh:s})=>s===e.object);if(t)return t.said(e.batchId??-1);if(e.object instanceof Nr)return e.object.userData.instances.said(e.instanceId);let n=this.swept.find(({mesh:s})=>s===e.object);return n?n.nearest(e.point):e.object instanceof wt&&e.object.userData.name?e.object.userData:null}fill(e,t,n){if(!e.length)return;let s=new mu(e,t);this.root.add(s.mesh),n.push(s)}build(e,t,n){let s=this.bodies[e],r={kind:"body",name:t.name},o=this.isGhost?void 0:t.colour,a=(u,d,f,p="")=>{let v=p&&!this.isGhost?p:o,g=this.isLarge&&d>Bl?{coarse:u(Bl)}:{};this.solids.push({geometry:u(d),...g,thin:f,body:e,holder:s,said:r,...v?{colour:v}:{}})};for(let u of t.parts){a(p=>Fl(u,n,2*p),u.kind==="mesh"?Bl:kl,!1,u.colour);let d=this.isGhost||this.isLarge?null:Ky(u);d&&(u.colour||o)&&a(()=>d,Bl,!0,Qy(u.colour||o));let f=wu(u,Fl(u,n));if(f){let p=new Hs(f,this.palette.edge);s.add(p),this.edges.push(p)}}let l=new S(...t.centre_of_mass),c=this.nearness.body(e),h=(t.parts.length?mR:pv)*c;for(let u of t.links){let d=new S(...u);d.distanceTo(l)<1e-6*c||(a(f=>Gy(l,d,h,f),kl,!0),a(f=>Up(d,h,f),kl,!0))}t.automatic&&!t.parts.length&&a(u=>Up(l,(t.links.length>1?1.5:2.2)*h,u),kl,!0)}signs(){let e=zr();for(let t of this.isGhost?[]:this.stage.joints){let n={kind:"joint",name:t.name},s=this.nearness.joint(t),r=this.isLarge?zp(t,this.stage,s,Bl):[];zp(t,this.stage,s,kl+4).forEach(({tone:o,geometry:a,standing:l},c)=>{let h=l?-1:t.bodies[t.place],u=r[c]?{coarse:r[c].geometry}:{};e[o].push({geometry:a,...u,thin:!0,body:h,holder:this.holder(h),said:n})})}return e}};var gv=.32,Yp=.0052,Nu=.05,$p=1e-9,bR=100,ER=new S(0,1,0),Fu=["applied-force","applied-torque","reaction-force","reaction-torque"],Ou=class{constructor(e,t){this.actor=e;for(let n of Fu)this.materials.set(n,new Rn({depthTest:!1,transparent:!0}));this.recolour(t);for(let n of e.stage.arrows){let s=Math.max(2*n.typical,n.largest/4);this.reference.set(n.kind,Math.max(this.reference.get(n.kind)??0,s))}this.dropRoundOff(),this.drawn=e.stage.arrows.map(n=>({record:n,place:0,visible:!1}));for(let n of Fu)this.bundle(n)}actor;root=new Nt;shown=new Set;scale=1;only=null;drawn;bundles=new Map;reference=new Map;materials=new Map;has(e){return this.drawn.some(({record:t})=>xv(t)===e&&t.largest>$p*(this.reference.get(t.kind)??1/0))}unit(e){return(this.reference.get(e)??0)*.1/(gv*this.scale)}dropRoundOff(){let{size:e}=this.actor.stage,t=this.reference.get("force")??0,n=this.reference.get("torque")??0;n<=$p*t*e&&this.reference.delete("torque"),t*e<=$p*n&&this.reference.delete("force")}recolour(e){for(let[t,n]of this.materials)n.color.set(t.startsWith("applied")?e.applied:t.endsWith("torque")?e.moment:e.reaction)}update(){for(let[e,{arrows:t,shafts:n,heads:s}]of this.bundles){let r=this.shown.has(e);n.mesh.visible=s.mesh.visible=r;for(let o of t)o.visible=r&&this.draw(o,n,s);r&&(n.done(),s.done())}}draw({record:e,place:t},n,s){let{size:r}=this.actor.stage,o=yv(e.kind),a=this.actor.vector(e.vector,vv).length(),l=this.reference.get(e.kind)??0,c=l>0?a/l*gv*r*this.scale:0;if(!(c>.001*r&&Number.isFinite(c)&&!this.actor.isBad[e.body]&&(!this.only||this.only===e.owner))){n.hide(t);for(let p=0;p<o;p++)s.hide(o*t+p);return!1}let u=vv.divideScalar(a);e.place>=0?this.actor.vector(e.place,Du):this.actor.place(e.body,e.point,Du),Zp.setFromUnitVectors(ER,u);let d=Math.min(Nu*r,.5*c),f=d/(Nu*r);n.set(t,Du,Zp,jp.set(1,Math.max(c-d,1e-9),1)),jp.setScalar(f);for(let p=0;p<o;p++)s.set(o*t+p,wR.copy(Du).addScaledVector(u,c-d-.55*p*d),Zp,jp);return!0}bundle(e){let t=this.drawn.filter(({record:h})=>xv(h)===e);if(!t.length)return;let{size:n}=this.actor.stage,s=this.materials.get(e),r=t.map(({record:h})=>this.owner(h)),o=t.length>bR?6:18,a=new es(new Jt(Yp*n,Yp*n,1,o).translate(0,.5,0),s,r),l=new gi(3.1*Yp*n,Nu*n,o).translate(0,.5*Nu*n,0),c=new es(l,s,r.flatMap((h,u)=>Array(yv(t[u].record.kind)).fill(h)));t.forEach((h,u)=>h.place=u);for(let{mesh:h}of[a,c])h.renderOrder=5,h.visible=!1,this.root.add(h);this.bundles.set(e,{arrows:t,shafts:a,heads:c})}owner(e){let{joints:t,drivers:n}=this.actor.stage,s=r=>r.name===e.owner;return{kind:e.source==="reaction"&&t.some(s)?"joint":n.some(s)?"driver":"force",name:e.owner}}},yv=i=>i==="torque"?2:1,[vv,Du,wR,jp,Zp]=[new S,new S,new S,new S,new nt];function xv(i){return`${i.source}-${i.kind}`}var _v="von Mises stress",Uu=class{constructor(e){this.actor=e;this.spread()}actor;get ofBeams(){return this.actor.sections.quantities.map(e=>e.name)}get ofBodies(){let{deforming:e}=this.actor;return e.some(t=>t.stressed)?[e[0].record.quantity,_v]:[]}get all(){return[...this.ofBeams,...this.ofBodies]}beams(e){this.actor.sections.show(e)}bodies(e){for(let t of this.actor.deforming)t.showsStress=e===_v&&t.stressed!==null;this.spread()}scales(){let{shown:e}=this.actor.sections,t=[];e&&t.push({quantity:e.name,unit:e.unit,low:e.low,high:e.high,now:null});for(let n of this.groups()){let[s]=n,{quantity:r,unit:o,low:a,high:l}=s.scale,c=s.showsStress?Math.max(...n.map(h=>h.peakValue)):null;t.push({quantity:r,unit:o,low:a,high:l,now:c})}return t}spread(){for(let e of this.groups()){let t=Math.min(...e.map(s=>s.ownScale.low)),n=Math.max(...e.map(s=>s.ownScale.high));for(let s of e)s.scale={...s.ownScale,low:t,high:n}}}groups(){let e=new Map;for(let t of this.actor.deforming){let{quantity:n,unit:s}=t.ownScale,r=`${n} ${s}`;e.set(r,[...e.get(r)??[],t])}return[...e.values()]}};var Mv=["first","front","right","top","back","left","below"],bv=40,$o=i=>new S(...i);function zl(i){let{min:e,max:t}=i;return Array.from({length:8},(n,s)=>new S(s&1?e.x:t.x,s&2?e.y:t.y,s&4?e.z:t.z))}function Jp(i,e,t){if(i==="first")return{towards:$o(e.towards),up:$o(e.up)};let n=Math.abs(t.z)>.9?new S(0,-1,0):new S(0,0,1),s=new S().crossVectors(t,n);return{towards:{front:n,right:s,top:t.clone(),back:n.clone().negate(),left:s.clone().negate(),below:t.clone().negate()}[i],up:i==="top"?n.clone().negate():i==="below"?n.clone():t.clone()}}var MR=1.08,Ev=.05;function Sv(i,e,t,n,s,r){let o=e.clone().normalize(),a=new S().crossVectors(t,o);a.lengthSq()<1e-6&&a.crossVectors(new S(.1,.3,1),o),a.normalize();let l=new S().crossVectors(o,a),c=Math.tan(ci.degToRad(s/2))/MR/n.height,h=wv(i,a,o,c*Math.max(n.across,bv),Ev*r),u=wv(i,l,o,c*Math.max(n.down,bv),Ev*r),d=new Ut().setFromPoints([...i]).getCenter(new S).dot(o);return{aim:a.multiplyScalar(h.middle).addScaledVector(l,u.middle).addScaledVector(o,d),distance:Math.max(h.eye-d,u.eye-d,.2*r)}}function wv(i,e,t,n,s){let r=-1/0,o=-1/0;for(let a of i){let l=n*a.dot(t);r=Math.max(r,l+a.dot(e)),o=Math.max(o,l-a.dot(e))}return{middle:.5*(r-o),eye:(.5*(r+o)+s)/n}}var SR=24,TR=8e3;function Kp(i,e){let t=Av(i),n=Math.max(Math.min(SR,e.count,Math.floor(TR/(8*Math.max(t.length,1)))),1),s=new Float32Array(e.layout.width),r=new nt,o=new Ut(new S(...i.stage.low),new S(...i.stage.high));o.expandByScalar(o.min.distanceTo(o.max)+i.stage.size);let a=[];for(let l=0;l<n;l++)e.sample(e.time[Math.round(l*(e.count-1)/Math.max(n-1,1))],s),t.forEach((c,h)=>{let[u,d,f,p,v,g,m]=s.subarray(7*h,7*h+7);if(c.isEmpty()||!Number.isFinite(u+d+f+p+v+g+m))return;r.set(v,g,m,p).normalize();let y=new S(u,d,f);if(o.containsPoint(y))for(let b of zl(c))a.push(b.applyQuaternion(r).add(y))});return[...a,...Tv(i)]}function Qp(i){return[...ku(i).flat(),...Tv(i)]}function ku(i){return Av(i).map((e,t)=>{let{position:n,quaternion:s}=i.bodies[t];return e.isEmpty()||i.isBad[t]?[]:zl(e).map(r=>r.applyQuaternion(s).add(n))})}function Tv(i){let e=[],t=new S;for(let n of[...i.stage.joints,...i.stage.forces])n.points.forEach((s,r)=>{n.bodies[r]===-1&&n.kind!=="contact"&&e.push(i.place(-1,s,t).clone())});return e}function Av(i){let e=new Map(i.bodies.map(n=>[n,new Ut])),t=(n,s)=>{s.computeBoundingBox(),s.boundingBox&&e.get(n)?.union(s.boundingBox)};for(let{holder:n,geometry:s}of i.solids)t(n,s);for(let{record:n,mesh:s}of i.deforming)t(i.holder(n.body),s.geometry);for(let n of i.swept)for(let[s,r]of n.extent())e.get(i.holder(s))?.expandByPoint(r);return[...e.values()]}var em=24,tm=12,Rv=5,Bu=class{group=new Nt;square;lines;material=new Zn({vertexColors:!0,transparent:!0,depthWrite:!1});shadow;height;shade=new ll({opacity:.16,depthWrite:!1});constructor(e,t){let n=new S(...e.low),s=new S(...e.high),r=new S(...e.up),o=Math.max(n.distanceTo(s),e.size);this.square=nm(o/9);let a=n.clone().add(s).multiplyScalar(.5),l=[n.dot(r),s.dot(r)],c=Math.min(...l)-.04*e.size,h=a.clone().addScaledVector(r,c-a.dot(r)),u=new nt().setFromUnitVectors(new S(0,0,1),r),d=f=>f.applyQuaternion(u.clone().invert());this.height=d(h.clone()).z,this.group.quaternion.copy(u),this.under(h,this.square),this.lines=new Hs(AR(this.square),this.material),this.lines.renderOrder=-1,this.shadow=new wt(new Vs(3*o,3*o),this.shade),this.shadow.receiveShadow=!0,this.shadow.renderOrder=-2,this.group.add(this.lines,this.shadow),this.recolour(t)}under(e,t=Rv*this.square){let n=e.clone().applyQuaternion(this.group.quaternion.clone().invert()),s=new S(Math.round(n.x/t)*t,Math.round(n.y/t)*t,this.height);this.group.position.copy(s.applyQuaternion(this.group.quaternion))}setGrid(e){this.lines.visible=e}setShadows(e){this.shadow.visible=e}recolour(e){this.material.color.set(e.grid),this.shade.opacity=e.dark?.4:.15}};function nm(i){let e=10**Math.floor(Math.log10(i));return e*([5,2,1].find(t=>t*e<=i*1.0001)??1)}function AR(i){let e=[],t=[],n=em*i,s=n/tm,r=(a,l,c)=>Math.max(0,1-Math.hypot(a,l)/n)**1.4*(c?1:.5);for(let a=-em;a<=em;a++){let l=a*i,c=a%Rv===0;for(let h=-tm;h<tm;h++){for(let u of[h*s,(h+1)*s])e.push(l,u,0),t.push(1,1,1,r(l,u,c));for(let u of[h*s,(h+1)*s])e.push(u,l,0),t.push(1,1,1,r(u,l,c))}}let o=new St;return o.setAttribute("position",new ot(e,3)),o.setAttribute("color",new ot(t,4)),o}var Hu=24,jo=34,RR=90,im=[[1e3,"km"],[1,"m"],[.001,"mm"],[1e-6,"µm"]],CR="http://www.w3.org/2000/svg",zu=class{constructor(e){this.world=e;for(let{line:t,text:n}of this.axes)this.element.append(t,n);this.element.append(this.bar,this.length)}world;element=Vl("svg",{class:"compass",width:"190",height:"72","aria-hidden":"true"});axes=["x","y","z"].map(e=>{let t=Vl("line",{class:`axis ${e}`,x1:String(jo),y1:String(jo)}),n=Vl("text",{class:`axis ${e}`});return n.textContent=e,{line:t,text:n}});bar=Vl("path",{class:"bar"});length=Vl("text",{class:"length",x:"84",y:"40"});update(){let{camera:e,controls:t}=this.world,n=e.quaternion.clone().invert(),s=[0,1,2].map(h=>new S().setComponent(h,1).applyQuaternion(n));s.forEach((h,u)=>{let{line:d,text:f}=this.axes[u];d.setAttribute("x2",(jo+Hu*h.x).toFixed(1)),d.setAttribute("y2",(jo-Hu*h.y).toFixed(1)),f.setAttribute("x",(jo+(Hu+8)*h.x).toFixed(1)),f.setAttribute("y",(jo-(Hu+8)*h.y+4).toFixed(1))});let r=[0,1,2].sort((h,u)=>s[h].z-s[u].z);for(let h of r)this.element.append(this.axes[h].line,this.axes[h].text);let a=2*e.position.distanceTo(t.target)*Math.tan(ci.degToRad(e.fov/2))/Math.max(this.world.holder.clientHeight,1),l=nm(RR*a),c=84+l/a;this.bar.setAttribute("d",`M84 48v6H${c.toFixed(1)}v-6`),this.length.textContent=PR(l)}};function PR(i){let[e,t]=im.find(([n])=>i>=.999*n)??im[im.length-1];return`${Number((i/e).toPrecision(3))} ${t}`}function Vl(i,e){let t=document.createElementNS(CR,i);for(let[n,s]of Object.entries(e))t.setAttribute(n,s);return t}var Vu=new Ws,IR=.02;function Cv(i,e,t,n){let s=t.clone().sub(n.position),r=s.length();Vu.set(n.position,s.divideScalar(r)),Vu.near=n.near,Vu.far=(1-IR)*r;let o=i.stage.bodies[e]?.name;return Vu.intersectObjects(i.bodyMeshes,!1).some(a=>{let l=i.said(a);return l!==null&&l.kind==="body"&&l.name!==o})}var LR=80,Gu=17,NR=3,DR=60,FR=7,OR=40,UR=2e4,Wu=class{constructor(e,t){this.actor=e;this.holder=t;let{stage:n}=e,s=e.solids.reduce((o,{geometry:a})=>o+(a.index??a.getAttribute("position")).count/3,0);this.looks=n.bodies.length<=OR&&s<=UR;let r=new Map(n.sweeps.flatMap(o=>o.bodies.map((a,l)=>[a,l===o.bodies.length>>1?o.name:""])));for(let[o,a]of n.bodies.entries())this.add("body",r.get(o)??a.name,o,a.centre_of_mass);for(let o of n.joints)this.add("joint",o.name,o.bodies[o.place],o.points[o.place]);for(let o of[...n.forces,...n.drivers])o.points[0]&&this.add("force",o.name,o.bodies[0],o.points[0]);for(let{name:o,wheels:a,joined:l}of n.couplings){let[c]=a,[h]=l;c?this.add("force",o,c.body,c.centre):h&&this.add("force",o,h.body,h.point)}}actor;holder;shown={body:!1,joint:!1,force:!1};labels=[];looks;update(e,t,n,s){let r=new S,o=[],a=this.labels.length>DR?0:NR;for(let l of this.labels){let{style:c}=l.element,h=this.shown[l.kind]&&o.length<LR&&!this.actor.isBad[l.body];if(h&&l.kind==="body"&&this.looks){let b=s&&Cv(this.actor,l.body,this.actor.place(l.body,l.point,r),e);l.element.classList.toggle("covered",b)}h&&this.actor.place(l.body,l.point,r).project(e);let u=FR*l.text.length,d=(.5+.5*r.x)*t,f=Math.min(Math.max(d,.5*u+4),t-.5*u-4),p=(.5-.5*r.y)*n,v=b=>!o.some(([x,T,M])=>Math.abs(x-f)<.5*(u+M)&&Math.abs(T-p-Gu*b)<Gu-1),g=!h||r.z>1||d<0||p<0||d>t||p>n,m=0;for(;!g&&m<=a&&!v(m);)m++;let y=!g&&m<=a;c.display=y?"":"none",y&&(o.push([f,p+Gu*m,u]),c.transform=`translate(${f.toFixed(1)}px, ${(p+Gu*m).toFixed(1)}px) translate(-50%, 9px)`)}}add(e,t,n,s){if(!t)return;let r=document.createElement("span");r.className=`label ${e}`,r.textContent=t,r.style.display="none",this.holder.append(r),this.labels.push({element:r,text:t,body:n,point:s,kind:e})}};var Xu=class{constructor(e,t){this.world=e;this.actor=t}world;actor;name=null;body=-1;last=new S;toggle(e){if(this.name===e){this.stop();return}this.name=e,this.body=this.actor.stage.bodies.findIndex(t=>t.name===e),this.centre(this.last),this.world.shift(this.last.clone().sub(this.world.controls.target)),this.world.invalidate()}stop(){this.name=null,this.body=-1}update(){if(this.body<0||this.actor.isBad[this.body])return;let e=this.centre(new S);this.world.shift(e.clone().sub(this.last)),this.last.copy(e)}centre(e){return this.actor.place(this.body,this.actor.stage.bodies[this.body].centre_of_mass,e)}};var kR=20,BR=.008,qu=class{constructor(e,t,n){this.world=e;this.actor=t;this.send=n;this.dot=new wt(new on(BR*t.stage.size,16,12),new Rn({color:14698554,depthTest:!1})),this.line.frustumCulled=!1;for(let r of[this.line,this.dot])r.renderOrder=10,r.raycast=()=>{};this.object.add(this.line,this.dot),this.object.visible=!1;let s=e.renderer.domElement;e.holder.addEventListener("pointerdown",r=>this.pick(r),!0),s.addEventListener("pointermove",r=>this.move(r));for(let r of["pointerup","pointercancel"])addEventListener(r,()=>this.letGo());addEventListener("blur",()=>this.letGo()),setInterval(()=>this.held&&this.say(1),kR)}world;actor;send;isOut=!1;object=new Nt;held=null;caster=new Ws;line=new ms(new St().setFromPoints([new S,new S]),new Zn({color:14698554,depthTest:!1}));dot;update(){if(!this.held)return;let e=this.actor.place(this.held.body,this.held.point.toArray(),new S);this.line.geometry.setFromPoints([e,this.held.towards]),this.dot.position.copy(this.held.towards)}pick(e){if(e.button!==0||!e.isPrimary||!(this.isOut||e.shiftKey)||e.target!==this.world.renderer.domElement)return;this.aim(e);let t=this.caster.intersectObject(this.actor.root,!0).find(c=>this.actor.said(c)?.kind==="body");if(!t)return;let n=this.actor.said(t).name,s=this.actor.stage.bodies.findIndex(c=>c.name===n),r=this.actor.root.worldToLocal(t.point.clone()),o=this.actor.holder(s),a=r.clone().sub(o.position).applyQuaternion(o.quaternion.clone().invert()),l=new si().setFromNormalAndCoplanarPoint(this.world.camera.getWorldDirection(new S),t.point);this.held={body:s,point:a,towards:r,plane:l},this.world.controls.enabled=!1,this.object.visible=!0,e.preventDefault(),this.say(1)}move(e){if(!this.held||!e.isPrimary)return;this.aim(e);let t=this.caster.ray.intersectPlane(this.held.plane,new S);t&&(this.held.towards=this.actor.root.worldToLocal(t)),this.world.invalidate()}letGo(){this.held&&(this.say(0),this.held=null,this.object.visible=!1,this.world.controls.enabled=!0,this.world.invalidate())}say(e){let{body:t,point:n,towards:s}=this.held;this.send({type:"hold",body:t,point:n.toArray(),towards:s.toArray(),on:e}),this.update()}aim(e){let t=this.world.renderer.domElement.getBoundingClientRect(),n=new ue(2*(e.clientX-t.left)/t.width-1,1-2*(e.clientY-t.top)/t.height);this.caster.setFromCamera(n,this.world.camera)}};var HR=400,zR=2,VR=1.5,Yu=class{constructor(e,t,n){this.world=e;this.actor=t;this.follow=n}world;actor;follow;body=-1;patience=0;looked=0;start=new Ut;move(e){let{stage:t}=this.actor,n=t.coordinates.find(r=>r.name===e)?.joint,s=t.joints.find(r=>r.name===n);s?this.body=s.bodies[1]>=0?s.bodies[1]:s.bodies[0]:this.body=t.bodies.findIndex(r=>r.name===n)}watchAll(){this.body=0,this.patience=HR,this.start.setFromPoints(ku(this.actor).flat())}keepInSight(){let e=performance.now();if(e-this.looked<this.patience)return;this.looked=e;let t=this.actor.bodies[this.body];if(!this.world.around||!t||this.actor.isBad[this.body]||this.patience&&!this.world.isFitted||this.world.holds(this.world.isFitted?this.world.around():[t.position]))return;let n=this.patience?this.driven():null;n?this.follow(n):this.world.fit()}driven(){let e=ku(this.actor).map(o=>new Ut().setFromPoints(o)),t=e.reduce((o,a)=>o.union(a),new Ut),n=this.start.min.distanceTo(this.start.max);if(!(t.getCenter(new S).distanceTo(this.start.getCenter(new S))>zR*n)||t.min.distanceTo(t.max)>VR*n)return null;let r=e.map(o=>o.isEmpty()?0:o.min.distanceTo(o.max));return this.actor.stage.bodies[r.indexOf(Math.max(...r))].name}};var GR=5;function Pv(i,e,t,n){let s=i.renderer.domElement,r=null;s.addEventListener("pointerdown",c=>r=c.button===0&&c.isPrimary?{x:c.clientX,y:c.clientY}:null),s.addEventListener("pointerup",c=>{r&&c.isPrimary&&Math.hypot(c.clientX-r.x,c.clientY-r.y)<GR&&n(a(c)),r=null});let o=new Ws;function a(c){let h=s.getBoundingClientRect(),u=new ue(2*(c.clientX-h.left)/h.width-1,1-2*(c.clientY-h.top)/h.height);o.setFromCamera(u,i.camera);let f=o.intersectObjects([e.root,t],!0).flatMap(v=>{let g=WR(v.object)?e.said(v):null;return g?[{said:g,distance:v.distance,size:l(g)}]:[]}),p=f[0];return p?(f.find(({said:v,distance:g,size:m})=>v.kind!=="body"&&g<p.distance+.02*m)??p).said:null}function l(c){let h=c.kind==="joint"&&e.stage.joints.find(({name:u})=>u===c.name);return h?e.nearness.joint(h):e.stage.size}}function WR(i){for(let e=i;e;e=e.parent)if(!e.visible)return!1;return!0}var Zo=class extends _r{constructor(){super(),this.isLineGeometry=!0,this.type="LineGeometry"}setPositions(e){let t=e.length-3,n=new Float32Array(2*t);for(let s=0;s<t;s+=3)n[2*s]=e[s],n[2*s+1]=e[s+1],n[2*s+2]=e[s+2],n[2*s+3]=e[s+3],n[2*s+4]=e[s+4],n[2*s+5]=e[s+5];return super.setPositions(n),this}setColors(e){let t=e.length-3,n=new Float32Array(2*t);for(let s=0;s<t;s+=3)n[2*s]=e[s],n[2*s+1]=e[s+1],n[2*s+2]=e[s+2],n[2*s+3]=e[s+3],n[2*s+4]=e[s+4],n[2*s+5]=e[s+5];return super.setColors(n),this}setFromPoints(e){let t=e.length-1,n=new Float32Array(6*t);for(let s=0;s<t;s++)n[6*s]=e[s].x,n[6*s+1]=e[s].y,n[6*s+2]=e[s].z||0,n[6*s+3]=e[s+1].x,n[6*s+4]=e[s+1].y,n[6*s+5]=e[s+1].z||0;return super.setPositions(n),this}fromLine(e){let t=e.geometry;return this.setPositions(t.attributes.position.array),this}};var $u=class extends Yo{constructor(e=new Zo,t=new ys({color:Math.random()*16777215})){super(e,t),this.isLine2=!0,this.type="Line2"}};var XR=6e3,ju=class{constructor(e,t,n){this.actor=e;this.motion=t;this.look=n}actor;motion;look;root=new Nt;paths=new Map;get keys(){return[...this.paths.keys()]}has(e){return this.paths.has(e)}toggle(e){let t=this.paths.get(e.key);if(t){for(let n of[t.whole,t.past,t.dot])n.removeFromParent();this.paths.delete(e.key)}else this.motion&&this.paths.set(e.key,this.make(e,this.motion))}clear(){this.root.clear(),this.paths.clear()}recolour(e){this.look=e,[...this.paths.values()].forEach((t,n)=>this.paint(t,n))}update(e){for(let t of this.paths.values()){let n=0;for(;n<t.frames.length&&t.frames[n]<=e;)n++;t.past.geometry.instanceCount=Math.max(n-1,0),this.actor.place(t.of.body,t.of.point,t.dot.position),t.dot.visible=!this.actor.isBad[t.of.body]}}make(e,t){let n=Math.max(Math.ceil(t.count/XR),1),s=[],r=[],o=new Float32Array(t.layout.width),a=new nt,l=new S;for(let p=0;p<t.count;p+=n){let v=t.time[p];t.sample(v,o);let[g,m,y,b,x,T,M]=o.subarray(7*e.body,7*e.body+7);a.set(x,T,M,b),this.actor.bent(e.body,e.point,o,l).applyQuaternion(a).add(new S(g,m,y)),Number.isFinite(l.x+l.y+l.z)&&(s.push(l.x,l.y,l.z),r.push(p))}let c=new ms(new St,new Zn({transparent:!0,opacity:.4}));c.geometry.setAttribute("position",new ot(s,3));let h=new Zo;h.setPositions(s.length>=6?s:[...s,...s,0,0,0,0,0,0].slice(0,6));let u=new $u(h,new ys({linewidth:2.2})),d=new wt(new on(.011*this.actor.nearness.body(e.body),16,12),new Rn);for(let p of[c,u])p.frustumCulled=!1;this.root.add(c,u,d);let f={of:e,whole:c,past:u,dot:d,frames:r};return this.paint(f,this.paths.size),f}paint(e,t){let n=this.look.trace[(t+1)%this.look.trace.length];e.whole.material.color.set(n),e.past.material.color.set(n),e.dot.material.color.set(n)}};var qR="#858e98";function Iv(i,e){let t=new Nt;t.position.set(...i.origin).negate();let n=new Zn({color:"#1b2430",transparent:!0,opacity:.35}),s=new Map;for(let r of i.surroundings){let o=r.colour||qR,a=s.get(o)??new ai({color:o,polygonOffset:!0,polygonOffsetFactor:1,polygonOffsetUnits:1});s.set(o,a);let l=Fl(r,e),c=new wt(l,a);c.castShadow=c.receiveShadow=!0,t.add(c);let h=wu(r,l);h&&t.add(new Hs(h,n))}return t}var Lv=new et("#a39781"),Dv=new et("#694f35"),YR=.5,Zu=class{constructor(e,t,n){this.ground=e;this.actor=n;let s=t.floats(e.heights),r=s.length,[o,a]=[new S(...e.along),new S(...e.across)];this.cell=o.length(),this.columns=e.heights.shape[1],this.normal=o.clone().cross(a).normalize(),this.at=new Float32Array(3*r),s.forEach((h,u)=>{let d=u%this.columns;Gl.set(...e.corner).addScaledVector(o,d).addScaledVector(a,(u-d)/this.columns),Gl.addScaledVector(this.normal,h).toArray(this.at,3*u)});let l=Dl(this.at,JR(r,this.columns));l.computeVertexNormals(),this.normals=l.getAttribute("normal").array,this.colours=new Float32Array(3*r);for(let h=0;h<r;h++)Lv.toArray(this.colours,3*h);l.setAttribute("color",new kt(this.colours,3)),this.steps=new Int32Array(r),this.marked=new Uint8Array(r),this.mesh=new wt(l,new ai({vertexColors:!0,side:wn})),this.mesh.position.set(...n.stage.origin).negate(),this.mesh.castShadow=this.mesh.receiveShadow=!0,this.mesh.frustumCulled=!1,this.heaps=e.loads.map(KR);let c=t.indices(e.nodes);for(let h=1;h<c.length;h++)c[h]+=c[h-1];this.course={time:t.times(e.time),ends:t.indices(e.ends),carried:t.floats(e.carried),nodes:c,moves:t.signed(e.moves)}}ground;actor;mesh;heaps;cell;columns;normal;at;normals;colours;steps;course;marked;waiting=[];passed=0;carried=new Float32Array;goTo(e){let{course:t}=this;if(!t.time.length)return;let n=t.carried.length/t.time.length;for(;this.passed<t.time.length&&t.time[this.passed]<=e;)this.pass(this.passed++,1);for(;this.passed>0&&t.time[this.passed-1]>e;)this.pass(--this.passed,-1);let s=n*Math.max(this.passed-1,0);this.carried=t.carried.subarray(s,s+n),this.settle()}take({carried:e,nodes:t,moves:n}){t.forEach((s,r)=>this.move(s,n[r])),this.carried=e,this.settle()}update(){this.ground.loads.forEach((e,t)=>this.place(e,this.heaps[t]))}place({slot:e,body:t,point:n,half:s},r){let o=this.carried[e]??0;if(r.visible=o>this.cell**3&&!this.actor.isBad[t],!r.visible)return;let a=Math.hypot(...s),l=Math.sqrt(3*o/(4*Math.PI*a));r.scale.set(a,l,l),r.quaternion.copy(this.actor.holder(t).quaternion).multiply($R.setFromUnitVectors(jR,Gl.set(...s).normalize())),this.actor.place(t,n,r.position)}pass(e,t){let{ends:n,nodes:s,moves:r}=this.course;for(let o=e?n[e-1]:0;o<n[e];o++)this.move(s[o],t*r[o])}move(e,t){let{columns:n,normal:s,at:r}=this,o=t*this.ground.step;this.steps[e]+=t,r[3*e]+=o*s.x,r[3*e+1]+=o*s.y,r[3*e+2]+=o*s.z;for(let a of[e,e-1,e+1,e-n,e+n])a<0||a>=this.marked.length||this.marked[a]||(this.marked[a]=1,this.waiting.push(a))}settle(){if(!this.waiting.length)return;let{columns:e,cell:t}=this,n=this.marked.length/e-1;for(let s of this.waiting){this.marked[s]=0;let r=s%e,o=(s-r)/e;this.between(s-+(r>0),s+ +(r<e-1),Gl),this.between(s-e*+(o>0),s+e*+(o<n),Nv),Gl.cross(Nv).normalize().toArray(this.normals,3*s),ZR.copy(Lv).lerp(Dv,Math.min(Math.abs(this.steps[s]*this.ground.step)/(YR*t),1)).toArray(this.colours,3*s)}this.waiting=[];for(let s of["position","normal","color"])this.mesh.geometry.getAttribute(s).needsUpdate=!0}between(e,t,n){let{at:s}=this;n.set(s[3*t]-s[3*e],s[3*t+1]-s[3*e+1],s[3*t+2]-s[3*e+2])}},Gl=new S,Nv=new S,$R=new nt,jR=new S(1,0,0),ZR=new et;function JR(i,e){let t=new Uint32Array(6*(e-1)*(i/e-1)),n=0;for(let s=0;s<i-e;s++)(s+1)%e!==0&&(t.set([s,s+1,s+e+1,s,s+e+1,s+e],n),n+=6);return t}function KR(){let i=new wt(new on(1,32,24),new ai({color:Dv}));return i.castShadow=i.receiveShadow=!0,i.visible=!1,i}var Fv=1500,QR=14247979,Ju=class{constructor(e,t,n){this.actor=e;this.traced=t;this.gaugeCount=n;this.frame=new Float32Array(e.stage.layout.width);for(let{body:s,point:r}of e.stage.markers){if(!t.includes(s))continue;let o=new St;o.setAttribute("position",new kt(new Float32Array(3*Fv),3)),o.setDrawRange(0,0);let a=new ms(o,new Zn({color:QR}));a.frustumCulled=!1,this.root.add(a),this.lines.push({line:a,body:s,point:r,count:0})}}actor;traced;gaugeCount;root=new Nt;lines=[];frame;time=-1/0;add({width:e,values:t}){let{bodies:n}=this.actor.stage.layout,s=1+this.gaugeCount;for(let r=0;r<t.length;r+=e){if(t[r]<this.time)for(let o of this.lines)o.count=0;this.time=t[r],this.traced.forEach((o,a)=>this.frame.set(t.subarray(r+s+7*a,r+s+7*a+7),7*o)),this.frame.set(t.subarray(r+s+7*this.traced.length,r+e),7*n);for(let o of this.lines)this.lengthen(o)}for(let{line:r,count:o}of this.lines)r.geometry.getAttribute("position").needsUpdate=!0,r.geometry.setDrawRange(0,o)}lengthen(e){let t=e.line.geometry.getAttribute("position").array;e.count===Fv?t.copyWithin(0,3):e.count++,this.actor.placeIn(this.frame,e.body,e.point,eC).toArray(t,3*(e.count-1))}},eC=new S;var tC=.12,nC=400,Ku=class{constructor(e,t){this.actor=e;let n=e.stage.size;this.joints=e.stage.joints.filter(r=>r.violation>=0);let s=this.joints.map(({name:r})=>({kind:"joint",name:r}));this.lines=new es(new Jt(.004*n,.004*n,1,8).translate(0,.5,0),this.material,s),this.axes=new es(new Jt(.003,.003,.16,8),this.material,s),this.dots=new es(new on(.011,16,12),this.material,s);for(let{mesh:r}of[this.lines,this.axes,this.dots])this.root.add(r);this.root.visible=!1,this.recolour(t)}actor;root=new Nt;exaggeration=1;on=!1;material=new Rn;joints;lines;dots;axes;get isKnown(){return this.joints.length>0}recolour(e){this.material.color.set(e.dark?"#ff7a70":"#d0312a")}proposed(e){let{bodies:t,modes:n}=this.actor.stage.layout,s=Math.max(1,Math.floor(e.count/nC)),r=0;for(let{violation:o}of this.joints)for(let[a,l]of[[o,1],[o+1,.3*this.actor.stage.size]]){let c=7*t+n+3*a;for(let h=0;h<e.count;h+=s){let u=l*Math.hypot(e.value(c,h),e.value(c+1,h),e.value(c+2,h));Number.isFinite(u)&&(r=Math.max(r,u))}}return r>0?10**Math.round(Math.log10(tC*this.actor.stage.size/r)):1}update(){if(this.root.visible=this.on,!this.on)return;let[e,t,n,s,r]=[0,1,2,3,4].map(()=>new S),o=new nt;this.joints.forEach((a,l)=>{if(a.bodies.some(d=>this.actor.isBad[d])){for(let d of[this.lines,this.dots,this.axes])d.hide(l);return}let c=this.actor.nearness.joint(a);this.actor.place(a.bodies[0],a.points[0],n),this.actor.vector(a.violation,e).multiplyScalar(this.exaggeration).clampLength(0,3*this.actor.stage.size),this.actor.vector(a.violation+1,t).multiplyScalar(this.exaggeration);let h=e.length();h>0&&o.setFromUnitVectors(Ov,s.copy(e).divideScalar(h)),this.lines.set(l,n,o,r.set(1,Math.max(h,1e-9),1)),n.add(e),s.set(...a.axes[0]).applyQuaternion(this.actor.holder(a.bodies[0]).quaternion);let u=Math.min(t.length(),Math.PI);u>0&&s.applyAxisAngle(t.normalize(),u),r.setScalar(c),this.axes.set(l,n,o.setFromUnitVectors(Ov,s.normalize()),r),this.dots.set(l,n,o,r)});for(let a of[this.lines,this.dots,this.axes])a.done()}},Ov=new S(0,1,0);var Uv={type:"change"},rm={type:"start"},Bv={type:"end"},Qu=new cr,kv=new si,iC=Math.cos(70*ci.DEG2RAD),In=new S,vi=2*Math.PI,Bt={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},sm=1e-6,ed=class extends yl{constructor(e,t=null){super(e,t),this.state=Bt.NONE,this.target=new S,this.cursor=new S,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.keyRotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:mr.ROTATE,MIDDLE:mr.DOLLY,RIGHT:mr.PAN},this.touches={ONE:gr.ROTATE,TWO:gr.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._cursorStyle="auto",this._domElementKeyEvents=null,this._lastPosition=new S,this._lastQuaternion=new nt,this._lastTargetPosition=new S,this._quat=new nt().setFromUnitVectors(e.up,new S(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new Ho,this._sphericalDelta=new Ho,this._scale=1,this._panOffset=new S,this._rotateStart=new ue,this._rotateEnd=new ue,this._rotateDelta=new ue,this._panStart=new ue,this._panEnd=new ue,this._panDelta=new ue,this._dollyStart=new ue,this._dollyEnd=new ue,this._dollyDelta=new ue,this._dollyDirection=new S,this._mouse=new ue,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=rC.bind(this),this._onPointerDown=sC.bind(this),this._onPointerUp=oC.bind(this),this._onContextMenu=fC.bind(this),this._onMouseWheel=cC.bind(this),this._onKeyDown=hC.bind(this),this._onTouchStart=uC.bind(this),this._onTouchMove=dC.bind(this),this._onMouseDown=aC.bind(this),this._onMouseMove=lC.bind(this),this._interceptControlDown=pC.bind(this),this._interceptControlUp=mC.bind(this),this.domElement!==null&&this.connect(this.domElement),this.update()}set cursorStyle(e){this._cursorStyle=e,e==="grab"?this.domElement.style.cursor="grab":this.domElement.style.cursor="auto"}get cursorStyle(){return this._cursorStyle}connect(e){super.connect(e),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.ownerDocument.addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.state=Bt.NONE,this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.ownerDocument.removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{capture:!0}),this._controlActive=!1,this._pointers.length=0,this._pointerPositions={},this.domElement.style.touchAction="",this.domElement.style.cursor="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(e){e.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=e}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(Uv),this.update(),this.state=Bt.NONE}pan(e,t){this._pan(e,t),this.update()}dollyIn(e){this._dollyIn(e),this.update()}dollyOut(e){this._dollyOut(e),this.update()}rotateLeft(e){this._rotateLeft(e),this.update()}rotateUp(e){this._rotateUp(e),this.update()}update(e=null){let t=this.object.position;In.copy(t).sub(this.target),In.applyQuaternion(this._quat),this._spherical.setFromVector3(In),this.autoRotate&&this.state===Bt.NONE&&this._rotateLeft(this._getAutoRotationAngle(e)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let n=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(n)&&isFinite(s)&&(n<-Math.PI?n+=vi:n>Math.PI&&(n-=vi),s<-Math.PI?s+=vi:s>Math.PI&&(s-=vi),n<=s?this._spherical.theta=Math.max(n,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(n+s)/2?Math.max(n,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{let o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=o!=this._spherical.radius}if(In.setFromSpherical(this._spherical),In.applyQuaternion(this._quatInverse),t.copy(this.target).add(In),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){let a=In.length();o=this._clampDistance(a*this._scale);let l=a-o;this.object.position.addScaledVector(this._dollyDirection,l),this.object.updateMatrixWorld(),r=!!l}else if(this.object.isOrthographicCamera){let a=new S(this._mouse.x,this._mouse.y,0);a.unproject(this.object);let l=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=l!==this.object.zoom;let c=new S(this._mouse.x,this._mouse.y,0);c.unproject(this.object),this.object.position.sub(c).add(a),this.object.updateMatrixWorld(),o=In.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):(Qu.origin.copy(this.object.position),Qu.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(Qu.direction))<iC?this.object.lookAt(this.target):(kv.setFromNormalAndCoplanarPoint(this.object.up,this.target),Qu.intersectPlane(kv,this.target))))}else if(this.object.isOrthographicCamera){let o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>sm||8*(1-this._lastQuaternion.dot(this.object.quaternion))>sm||this._lastTargetPosition.distanceToSquared(this.target)>sm?(this.dispatchEvent(Uv),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(e){return e!==null?vi/60*this.autoRotateSpeed*e:vi/60/60*this.autoRotateSpeed}_getZoomScale(e){let t=Math.abs(e*.01);return Math.pow(.95,this.zoomSpeed*t)}_rotateLeft(e){this._sphericalDelta.theta-=e}_rotateUp(e){this._sphericalDelta.phi-=e}_panLeft(e,t){In.setFromMatrixColumn(t,0),In.multiplyScalar(-e),this._panOffset.add(In)}_panUp(e,t){this.screenSpacePanning===!0?In.setFromMatrixColumn(t,1):(In.setFromMatrixColumn(t,0),In.crossVectors(this.object.up,In)),In.multiplyScalar(e),this._panOffset.add(In)}_pan(e,t){let n=this.domElement;if(this.object.isPerspectiveCamera){let s=this.object.position;In.copy(s).sub(this.target);let r=In.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*e*r/n.clientHeight,this.object.matrix),this._panUp(2*t*r/n.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(e*(this.object.right-this.object.left)/this.object.zoom/n.clientWidth,this.object.matrix),this._panUp(t*(this.object.top-this.object.bottom)/this.object.zoom/n.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(e){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=e:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(e){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=e:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(e,t){if(!this.zoomToCursor)return;this._performCursorZoom=!0;let n=this.domElement.getBoundingClientRect(),s=e-n.left,r=t-n.top,o=n.width,a=n.height;this._mouse.x=s/o*2-1,this._mouse.y=-(r/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(e){return Math.max(this.minDistance,Math.min(this.maxDistance,e))}_handleMouseDownRotate(e){this._rotateStart.set(e.clientX,e.clientY)}_handleMouseDownDolly(e){this._updateZoomParameters(e.clientX,e.clientY),this._dollyStart.set(e.clientX,e.clientY)}_handleMouseDownPan(e){this._panStart.set(e.clientX,e.clientY)}_handleMouseMoveRotate(e){this._rotateEnd.set(e.clientX,e.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let t=this.domElement;this._rotateLeft(vi*this._rotateDelta.x/t.clientHeight),this._rotateUp(vi*this._rotateDelta.y/t.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(e){this._dollyEnd.set(e.clientX,e.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.zoomToCursor&&(this._performCursorZoom=!0,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()),this.update()}_handleMouseMovePan(e){this._panEnd.set(e.clientX,e.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(e){this._updateZoomParameters(e.clientX,e.clientY),e.deltaY<0?this._dollyIn(this._getZoomScale(e.deltaY)):e.deltaY>0&&this._dollyOut(this._getZoomScale(e.deltaY)),this.update()}_handleKeyDown(e){let t=!1;switch(e.code){case this.keys.UP:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateUp(vi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,this.keyPanSpeed),t=!0;break;case this.keys.BOTTOM:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateUp(-vi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,-this.keyPanSpeed),t=!0;break;case this.keys.LEFT:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateLeft(vi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(this.keyPanSpeed,0),t=!0;break;case this.keys.RIGHT:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateLeft(-vi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(-this.keyPanSpeed,0),t=!0;break}t&&(e.preventDefault(),this.update())}_handleTouchStartRotate(e){if(this._pointers.length===1)this._rotateStart.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),n=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._rotateStart.set(n,s)}}_handleTouchStartPan(e){if(this._pointers.length===1)this._panStart.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),n=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._panStart.set(n,s)}}_handleTouchStartDolly(e){let t=this._getSecondPointerPosition(e),n=e.pageX-t.x,s=e.pageY-t.y,r=Math.sqrt(n*n+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(e){this.enableZoom&&this._handleTouchStartDolly(e),this.enablePan&&this._handleTouchStartPan(e)}_handleTouchStartDollyRotate(e){this.enableZoom&&this._handleTouchStartDolly(e),this.enableRotate&&this._handleTouchStartRotate(e)}_handleTouchMoveRotate(e){if(this._pointers.length==1)this._rotateEnd.set(e.pageX,e.pageY);else{let n=this._getSecondPointerPosition(e),s=.5*(e.pageX+n.x),r=.5*(e.pageY+n.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let t=this.domElement;this._rotateLeft(vi*this._rotateDelta.x/t.clientHeight),this._rotateUp(vi*this._rotateDelta.y/t.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(e){if(this._pointers.length===1)this._panEnd.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),n=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._panEnd.set(n,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(e){let t=this._getSecondPointerPosition(e),n=e.pageX-t.x,s=e.pageY-t.y,r=Math.sqrt(n*n+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);let o=(e.pageX+t.x)*.5,a=(e.pageY+t.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(e){this.enableZoom&&this._handleTouchMoveDolly(e),this.enablePan&&this._handleTouchMovePan(e)}_handleTouchMoveDollyRotate(e){this.enableZoom&&this._handleTouchMoveDolly(e),this.enableRotate&&this._handleTouchMoveRotate(e)}_addPointer(e){this._pointers.push(e.pointerId)}_removePointer(e){delete this._pointerPositions[e.pointerId];for(let t=0;t<this._pointers.length;t++)if(this._pointers[t]==e.pointerId){this._pointers.splice(t,1);return}}_isTrackingPointer(e){for(let t=0;t<this._pointers.length;t++)if(this._pointers[t]==e.pointerId)return!0;return!1}_trackPointer(e){let t=this._pointerPositions[e.pointerId];t===void 0&&(t=new ue,this._pointerPositions[e.pointerId]=t),t.set(e.pageX,e.pageY)}_getSecondPointerPosition(e){let t=e.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[t]}_customWheelEvent(e){let t=e.deltaMode,n={clientX:e.clientX,clientY:e.clientY,deltaY:e.deltaY};switch(t){case 1:n.deltaY*=16;break;case 2:n.deltaY*=100;break}return e.ctrlKey&&!this._controlActive&&(n.deltaY*=10),n}};function sC(i){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(i.pointerId),this.domElement.ownerDocument.addEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(i)&&(this._addPointer(i),i.pointerType==="touch"?this._onTouchStart(i):this._onMouseDown(i),this._cursorStyle==="grab"&&(this.domElement.style.cursor="grabbing")))}function rC(i){this.enabled!==!1&&(i.pointerType==="touch"?this._onTouchMove(i):this._onMouseMove(i))}function oC(i){switch(this._removePointer(i),this._pointers.length){case 0:this.domElement.releasePointerCapture(i.pointerId),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(Bv),this.state=Bt.NONE,this._cursorStyle==="grab"&&(this.domElement.style.cursor="grab");break;case 1:let e=this._pointers[0],t=this._pointerPositions[e];this._onTouchStart({pointerId:e,pageX:t.x,pageY:t.y});break}}function aC(i){let e;switch(i.button){case 0:e=this.mouseButtons.LEFT;break;case 1:e=this.mouseButtons.MIDDLE;break;case 2:e=this.mouseButtons.RIGHT;break;default:e=-1}switch(e){case mr.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(i),this.state=Bt.DOLLY;break;case mr.ROTATE:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=Bt.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=Bt.ROTATE}break;case mr.PAN:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=Bt.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=Bt.PAN}break;default:this.state=Bt.NONE}this.state!==Bt.NONE&&this.dispatchEvent(rm)}function lC(i){switch(this.state){case Bt.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(i);break;case Bt.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(i);break;case Bt.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(i);break}}function cC(i){this.enabled===!1||this.enableZoom===!1||this.state!==Bt.NONE||(i.preventDefault(),this.dispatchEvent(rm),this._handleMouseWheel(this._customWheelEvent(i)),this.dispatchEvent(Bv))}function hC(i){this.enabled!==!1&&this._handleKeyDown(i)}function uC(i){switch(this._trackPointer(i),this._pointers.length){case 1:switch(this.touches.ONE){case gr.ROTATE:if(this.enableRotate===!1){this.state=Bt.NONE;break}this._handleTouchStartRotate(i),this.state=Bt.TOUCH_ROTATE;break;case gr.PAN:if(this.enablePan===!1){this.state=Bt.NONE;break}this._handleTouchStartPan(i),this.state=Bt.TOUCH_PAN;break;default:this.state=Bt.NONE}break;case 2:switch(this.touches.TWO){case gr.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(i),this.state=Bt.TOUCH_DOLLY_PAN;break;case gr.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(i),this.state=Bt.TOUCH_DOLLY_ROTATE;break;default:this.state=Bt.NONE}break;default:this.state=Bt.NONE}this.state!==Bt.NONE&&this.dispatchEvent(rm)}function dC(i){switch(this._trackPointer(i),this.state){case Bt.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(i),this.update();break;case Bt.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(i),this.update();break;case Bt.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(i),this.update();break;case Bt.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(i),this.update();break;default:this.state=Bt.NONE}}function fC(i){this.enabled!==!1&&i.preventDefault()}function pC(i){i.key==="Control"&&(this._controlActive=!0,this.domElement.ownerDocument.addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function mC(i){i.key==="Control"&&(this._controlActive=!1,this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}var gC=260,td=class{constructor(e,t,n,s){this.from=e;this.target=t;this.to=n;this.aim=s}from;target;to;aim;start=performance.now();shift(e){this.to.add(e),this.aim.add(e)}bring(e,t,n){let s=Math.min(Math.max((n-this.start)/gC,0),1),r=s*s*(3-2*s);t.lerpVectors(this.target,this.aim,r);let o=this.from.clone().sub(this.target),a=this.to.clone().sub(this.aim),l=ci.lerp(o.length(),a.length(),r),c=new nt().setFromUnitVectors(o.clone().normalize(),a.clone().normalize());return e.copy(o.applyQuaternion(new nt().slerp(c,r)).setLength(l)).add(t),s>=1}};var yC=26,vC=30,Hv=12,xC=3,_C=300,nd=class{constructor(e,t){this.holder=e;this.stage=t;let n=bC();document.body.classList.toggle("plain",n),this.renderer=new uu({antialias:!n,powerPreference:"high-performance"}),this.renderer.shadowMap.enabled=!0,this.renderer.shadowMap.type=n?Vf:yr,this.renderer.toneMapping=Hi,this.finest=n?1:Math.min(devicePixelRatio,2),this.ratio=this.finest;let s=this.renderer.domElement;s.setAttribute("aria-label",`${t.name} in three dimensions: drag to turn, two fingers or right button to move, wheel to zoom`),s.setAttribute("role","img"),s.tabIndex=0,e.append(s),this.up=$o(t.up),this.low=$o(t.low),this.high=$o(t.high),this.cloud=zl(new Ut(this.low,this.high)),this.camera.up.copy(this.up),this.controls=new ed(this.camera,s),this.controls.enableDamping=!1,this.controls.zoomToCursor=!0,this.controls.addEventListener("change",()=>this.invalidate()),this.controls.addEventListener("start",()=>{this.flight=null,this.fitted=!1}),this.floor=new Bu(t,this.look),this.floor.group.visible=!t.surroundings.length&&!t.terrains.length,this.scene.add(this.floor.group,this.sky,this.sun,this.sun.target),this.light(),this.recolour(),matchMedia("(prefers-color-scheme: dark)").addEventListener("change",()=>this.recolour()),new ResizeObserver(()=>{this.resize(),this.fitted&&this.fit(!1)}).observe(e),this.resize(),this.view("first",!1),requestAnimationFrame(r=>this.tick(r))}holder;stage;scene=new ka;renderer;camera=new ri(yC,1,.01,1e3);controls;floor;look=Bp();onBeforeRender=()=>{};onEdges=()=>{};onRecolour=()=>{};around=null;now=null;frameCount=0;sun=new pl(16777215,2.1);sky=new ul(16777215,8950688,1.55);low;high;up;cloud;free={left:0,top:0,right:0,bottom:0};dirty=!0;finest;ratio;shadows=!0;fitted=!0;level=0;learnt=0;last=0;paces=[];flight=null;running=!1;invalidate(){this.dirty=!0}keepFree(e){this.free=e,this.resize(),this.fitted&&this.fit(!1)}setShadows(e){this.shadows=e,this.sun.castShadow=e&&this.level<1,this.floor.setShadows(this.sun.castShadow),this.invalidate()}drawFinely(){document.body.classList.remove("plain"),this.renderer.shadowMap.type=yr,this.finest=this.ratio=2,this.scene.traverse(e=>{if(e instanceof wt)for(let t of[e.material].flat())t.needsUpdate=!0}),this.resize()}view(e,t=!0){let{towards:n,up:s}=Jp(e,this.stage.viewpoint,this.up);this.fitted=!0,this.around&&this.see(this.around()),this.flyTo(n,s,t)}fit(e=!0){this.fitted=!0,this.around&&this.see(this.around());let t=this.camera.position.clone().sub(this.controls.target).normalize();this.flyTo(t,this.up,e)}fitNow(){if(this.around||!this.now)return this.fit();let e=this.cloud;this.see(this.now()),this.fit(),this.cloud=e,this.fitted=!1}get isFitted(){return this.fitted}holds(e){return this.flight?!0:(this.camera.updateMatrixWorld(),e.every(t=>{let{x:n,y:s,z:r}=t.clone().project(this.camera);return Math.abs(n)<=1&&Math.abs(s)<=1&&Math.abs(r)<=1}))}orbit(e,t){let n=this.camera.position.clone().sub(this.controls.target);n.applyAxisAngle(this.up,e);let s=new S().crossVectors(this.up,n).normalize(),r=n.clone().applyAxisAngle(s,-t);Math.abs(r.clone().normalize().dot(this.up))<.995&&n.copy(r),this.camera.position.copy(this.controls.target).add(n),this.controls.update(),this.invalidate()}zoom(e){this.fitted=!1,this.camera.position.sub(this.controls.target).multiplyScalar(e).add(this.controls.target),this.controls.update(),this.invalidate()}shift(e){if(this.fitted=!1,this.camera.position.add(e),this.controls.target.add(e),this.flight?.shift(e),this.controls.update(),!!this.around){for(let t of this.cloud)t.add(e);this.floor.under(this.controls.target),this.light()}}tick(e){requestAnimationFrame(t=>this.tick(t)),this.flight&&this.fly(e),this.onBeforeRender(e),this.running?this.draw(this.learnt):this.level&&e-this.last>_C&&this.draw(0),this.dirty&&(this.dirty=!1,this.near(),this.renderer.render(this.scene,this.camera),this.frameCount++,this.pace(e))}pace(e){let t=e-this.last;if(this.last=e,!this.running||t>500||(this.paces.push(t),this.paces.length<Hv))return;let n=this.paces.sort((s,r)=>s-r)[Hv>>1];this.paces.length=0,n>vC&&this.learnt<xC&&this.draw(++this.learnt)}draw(e){e!==this.level&&(this.level=e,this.sun.castShadow=this.shadows&&e<1,this.floor.setShadows(this.sun.castShadow),this.onEdges(e<2),this.ratio=e<3?this.finest:.6*this.finest,this.resize())}see(e){e.length&&(this.cloud=e)}middle(){return new Ut().setFromPoints(this.cloud).getCenter(new S)}framed(e,t){let{width:n,height:s}=this.size(),r={height:s,across:n-this.free.left-this.free.right,down:s-this.free.top-this.free.bottom};return Sv(this.cloud,e,t,r,this.camera.fov,this.stage.size)}flyTo(e,t,n){let{aim:s,distance:r}=this.framed(e,t),o=e.clone().normalize();Math.abs(o.dot(this.up))>.9999&&o.addScaledVector(t,-.001*Math.sign(o.dot(this.up))).normalize();let a=s.clone().addScaledVector(o,r),l=matchMedia("(prefers-reduced-motion: reduce)").matches;if(!n||l){this.flight=null,this.camera.position.copy(a),this.controls.target.copy(s),this.controls.update(),this.invalidate();return}this.flight=new td(this.camera.position.clone(),this.controls.target.clone(),a,s.clone())}fly(e){this.flight.bring(this.camera.position,this.controls.target,e)&&(this.flight=null),this.controls.update(),this.invalidate()}near(){let e=this.camera.position.distanceTo(this.middle()),t=.5*this.low.distanceTo(this.high)+12*this.stage.size,n=this.camera.position.distanceTo(this.controls.target);this.camera.near=Math.max(e-t,.02*Math.min(n,.2*this.stage.size)),this.camera.far=e+4*t,this.camera.updateProjectionMatrix()}light(){let e=this.middle(),t=Math.max(.75*this.low.distanceTo(this.high),.75*this.stage.size),{towards:n}=Jp("first",this.stage.viewpoint,this.up),s=new S().crossVectors(this.up,n),r=this.up.clone().multiplyScalar(1.5).addScaledVector(n,.5).addScaledVector(s,-.55).normalize();this.sun.position.copy(e).addScaledVector(r,3*t),this.sun.target.position.copy(e),this.sun.castShadow=this.shadows&&this.level<1,this.sun.shadow.mapSize.set(2048,2048),this.sun.shadow.radius=3,this.sun.shadow.normalBias=.004*this.stage.size;let o=this.sun.shadow.camera;o.left=o.bottom=-1.25*t,o.right=o.top=1.25*t,o.near=.5*t,o.far=8*t,this.sky.position.copy(this.up)}recolour(){this.look=Bp(),this.scene.background=new et(this.look.sky),this.sky.intensity=this.look.dark?1.75:1.7,this.sun.intensity=this.look.dark?2.2:1.9,this.floor.recolour(this.look),this.onRecolour(this.look),this.invalidate()}size(){return{width:Math.max(this.holder.clientWidth,1),height:Math.max(this.holder.clientHeight,1)}}resize(){let{width:e,height:t}=this.size();this.renderer.setPixelRatio(this.ratio),this.renderer.setSize(e,t),this.camera.aspect=e/t;let{left:n,top:s,right:r,bottom:o}=this.free;this.camera.setViewOffset(e,t,(r-n)/2,(o-s)/2,e,t),this.camera.updateProjectionMatrix(),this.invalidate()}};function bC(){let i=document.createElement("canvas").getContext("webgl2"),e=i?.getExtension("WEBGL_debug_renderer_info"),t=i&&e?String(i.getParameter(e.UNMASKED_RENDERER_WEBGL)):"";return i?.getExtension("WEBGL_lose_context")?.loseContext(),/swiftshader|llvmpipe|softpipe|software|basic render/i.test(t)}function W(i,e={},...t){let n=document.createElement(i);for(let[s,r]of Object.entries(e))r===void 0||r===!1||(typeof r=="function"?n.addEventListener(s.slice(2),r):n.setAttribute(s,r===!0?"":String(r)));return n.append(...t.filter(s=>s!=null&&s!==!1)),n}var EC={play:'<path d="M6.5 4.2v11.6l9-5.8z" fill="currentColor" stroke-linejoin="round"/>',pause:'<path d="M6.8 4.5v11M13.2 4.5v11" stroke-width="2.6"/>',back:'<path d="M13.5 5l-6 5 6 5zM6 5v10" />',forward:'<path d="M6.5 5l6 5-6 5zM14 5v10"/>',loop:'<path d="M4 9.5a5 5 0 0 1 5-5h5.5M12 2l2.7 2.5L12 7M16 10.5a5 5 0 0 1-5 5H5.5M8 18l-2.7-2.5L8 13"/>',tree:'<path d="M4 4.5h6M4 4.5v11h4M4 10h4M11 10h5M11 15.5h5"/>',plot:'<path d="M3.5 3.5v13h13M6 13l3.2-4.5 2.6 2.6L16 5.5"/>',eye:'<path d="M2 10s3-5 8-5 8 5 8 5-3 5-8 5-8-5-8-5z"/><circle cx="10" cy="10" r="2.4"/>',cube:'<path d="M10 2.8l6.2 3.5v7.4L10 17.2l-6.2-3.5V6.3zM3.8 6.3L10 9.9l6.2-3.6M10 9.9v7.3"/>',help:'<circle cx="10" cy="10" r="7.2"/><path d="M7.8 7.8a2.2 2.2 0 1 1 3.2 2c-.7.4-1 .8-1 1.6M10 14.2v.1"/>',close:'<path d="M5.5 5.5l9 9M14.5 5.5l-9 9"/>',fit:'<path d="M3.5 7V3.5H7M13 3.5h3.5V7M16.5 13v3.5H13M7 16.5H3.5V13"/>',target:'<circle cx="10" cy="10" r="5.2"/><path d="M10 2v4M10 14v4M2 10h4M14 10h4"/>',path:'<path d="M3 15c3-9 6-9 7-4s4 4 7-6"/><circle cx="17" cy="5" r="1.6" fill="currentColor"/>',reset:'<path d="M4.5 10a5.5 5.5 0 1 0 1.8-4.1M6.5 2.5v3.7h3.7"/>'};function Er(i){let e=document.createElement("template");return e.innerHTML=`<svg viewBox="0 0 20 20" width="20" height="20" fill="none" stroke="currentColor" stroke-width="1.6" stroke-linecap="round" stroke-linejoin="round" aria-hidden="true">${EC[i]}</svg>`,e.content.firstElementChild}function Mn(i,e,t,n=""){return W("button",{type:"button",class:"icon-button","aria-label":e,title:n?`${e} (${n})`:e,onclick:t},Er(i))}function id(i,e,t,n=""){i.getAttribute("aria-label")!==t&&(i.replaceChildren(Er(e)),i.setAttribute("aria-label",t),i.title=n?`${t} (${n})`:t)}function sd(i,e){let t=W("dialog",{class:"large-diagram"},W("form",{method:"dialog"},W("button",{class:"chip"},Er("close"),"Close"))),n=document.createComment(""),s=()=>{e.replaceWith(n),t.append(e),t.showModal()};return t.addEventListener("close",()=>n.replaceWith(e)),document.body.append(t),W("button",{type:"button",class:"chip",onclick:s},Er("fit"),i)}function ui(i,e,t){let n=W("input",{type:"checkbox",role:"switch",checked:e});return n.addEventListener("change",()=>t(n.checked)),W("label",{class:"toggle"},n,W("span",{},i))}function om(i,e,t,n){let s=W("select",{},...e.map(r=>W("option",{value:r},r||t)));return s.addEventListener("change",()=>n(s.value)),W("label",{class:"choice"},W("span",{},i),s)}function bs(i){return i.split(/(?<=[._-])/).flatMap((e,t)=>t?[document.createElement("wbr"),e]:[e])}var wC=1e-9,MC=.001,SC=["m","rad","deg","m/s","rad/s","m/s^2","rad/s^2","N","N m"];function Gr(i,e){let t=SC.includes(e)?MC:0;for(let n of i)n!==null&&Math.abs(n)>t&&(t=Math.abs(n));return Number.isFinite(t)?t:0}function mn(i,e=0){if(!Number.isFinite(i))return"–";let t=Math.abs(i);return t<=wC*e?"0":(t>=.001&&t<1e6?String(+i.toPrecision(5)):i.toExponential(2).replace(/\.?0+e/,"e").replace("e+","e")).replace(/^-/,"−").replace("e-","e−")}var TC=["N","N m","Pa","J","W"],AC=[[1e9,"G"],[1e6,"M"],[1e3,"k"]];function Jo(i,e,t=Gr(i,e)){let n=Math.max(...i.map(Math.abs)),[s,r]=TC.includes(e)&&AC.find(([o])=>n>=o)||[1,""];return{texts:i.map(o=>mn(+(o/s).toPrecision(4),t/s)),unit:e==="1"?"":r+e}}var rd=class{constructor(e,t,n){this.move=t;let r=e.filter(o=>o.free).map(o=>this.row(o));this.element=W("div",{class:"coordinates"},W("header",{},W("h3",{},"Move the machine"),Mn("reset","Back to the assembled position",n,"R")),this.problem,r.length?W("ul",{},...r):W("p",{class:"note"},"Nothing of this machine can move."))}move;element;rows=[];problem=W("p",{class:"problem",role:"status"});update(e,t,n){let s=new Map(t.map((r,o)=>[r.name,e[o]]));for(let r of this.rows){let o=s.get(r.record.name);o!==void 0&&((document.activeElement!==r.slider||n)&&(r.slider.value=String(o)),r.value.textContent=zv(o,r.record))}this.problem.textContent=n}row(e){let t=W("output",{},zv(e.value,e)),n=W("input",{type:"range",min:e.low,max:e.high,step:"any",value:e.value,"aria-label":e.name});return n.addEventListener("input",()=>this.move(e.name,Number(n.value))),this.rows.push({record:e,slider:n,value:t}),W("li",{},W("label",{},W("span",{class:"name"},...bs(e.name)),t,n))}};function zv(i,{unit:e,low:t,high:n}){return e==="rad"?`${(i*180/Math.PI).toFixed(1)}°`.replace(/^-0\.0°/,"0.0°").replace("-","−"):`${mn(i,Gr([t,n],e))} ${e}`}var RC=[["first","First","0"],["front","Front","1"],["right","Right","2"],["top","Top","3"],["back","Back","4"],["left","Left","5"],["below","Below","6"]],CC={"applied-force":"Applied forces","applied-torque":"Applied torques","reaction-force":"Reaction forces","reaction-torque":"Reaction torques"},od=class{constructor(e){this.app=e;let t=RC.map(([n,s,r])=>W("button",{type:"button",class:"chip",title:`${s} (${r})`,onclick:()=>e.look(n)},s));this.element=W("div",{class:"display"},Wr("Look from",W("div",{class:"chips"},...t)),this.colours(),Wr("Show",...this.shown()),this.arrows(),this.violations(),this.flexible(),this.ghost())}app;element;shown(){let{app:e}=this,{stage:t}=e.actor;return[ui("Names of bodies",e.labels.shown.body,n=>e.name("body",n)),ui("Names of joints",e.labels.shown.joint,n=>e.name("joint",n)),...t.forces.length+t.drivers.length+t.couplings.length?[ui(t.couplings.length?"Names of forces and couplings":"Names of forces",e.labels.shown.force,n=>e.name("force",n))]:[],ui("Joint symbols",!e.live,n=>e.show("signs",n)),...t.joints.length?[ui("Joint axes",!1,n=>e.show("axes",n)),ui("Joint frames",!1,n=>e.show("joints",n))]:[],...t.markers.length?[ui("Marker frames",!1,n=>e.show("markers",n))]:[],ui("Body frames",!1,n=>e.show("triads",n)),ui("Centres of mass",!1,n=>e.show("centres",n)),ui("Grid",!0,n=>e.change(()=>e.world.floor.setGrid(n))),ui("Shadows",!0,n=>e.world.setShadows(n))]}arrows(){let{app:e}=this,t=Fu.filter(c=>e.arrows.has(c));if(!t.length)return null;let n=c=>mn(+c.toPrecision(2)),s=n(e.actor.stage.size*.1),r=W("p",{class:"note"}),o=()=>{let h=["force","torque"].filter(u=>e.arrows.unit(u)>0).map(u=>`${n(e.arrows.unit(u))} ${u==="force"?"N":"N m"}`);r.textContent=`${s} m of arrow: ${h.join(", ")}`},a=am("Length of arrows",-1,2,0,c=>{e.change(()=>e.arrows.scale=10**c),o()});o();let l=t.map(c=>ui(CC[c],e.arrows.shown.has(c),h=>e.change(()=>h?e.arrows.shown.add(c):e.arrows.shown.delete(c))));for(let[c,h]of t.entries())l[c].classList.add(h);return Wr("Arrows",...l,a,r)}violations(){let{app:e}=this;if(!e.violations.isKnown||!e.motion)return null;let t=W("output",{}),n=Math.log10(e.violations.proposed(e.motion)),s=o=>{let a=10**Math.round(o);e.change(()=>e.violations.exaggeration=a),t.textContent=`× ${mn(a)}`},r=am("Exaggeration",Math.min(0,n-4),Math.max(n+3,3),n,s,1);return s(n),Wr("Open joints",ui("Constraint violations",!1,o=>e.change(()=>e.violations.on=o)),r,W("p",{class:"note"},"Exaggerated ",t))}colours(){let{app:e}=this,{ofBeams:t,ofBodies:n}=e.colours,s=e.actor.stage.colourless.map(a=>W("p",{class:"note"},a)),r=t.length?om("Beams by",["",...t],"nothing",a=>e.change(()=>e.colours.beams(a))):null,o=n.length?om("Bodies by",n,"",a=>e.change(()=>e.colours.bodies(a))):null;return r||o||s.length?Wr("Colours",r,o,...s):null}flexible(){let{app:e}=this;if(!e.actor.deforming.length)return null;let t=W("output",{},"× 1"),n=am("Exaggerate the deformation",0,3,0,s=>{for(let r of e.actor.deforming)r.exaggeration=10**s;t.textContent=`× ${mn(10**s)}`,e.refreshFrame()});return Wr("Deformation",n,W("p",{class:"note"},"Drawn ",t))}ghost(){let{app:e}=this;return e.ghosts.length?Wr("Second result",ui(e.ghosts.map(t=>t.actor.stage.title).join(", "),!0,t=>e.showGhosts(t)),...e.ghosts.flatMap(t=>t.actor.stage.notes.map(n=>W("p",{class:"note"},n)))):null}};function Wr(i,...e){return W("section",{},W("h3",{},i),...e)}function am(i,e,t,n,s,r="any"){let o=W("input",{type:"range",min:e,max:t,step:r,value:n});return o.addEventListener("input",()=>s(Number(o.value))),W("label",{class:"range"},W("span",{},i),o)}var Vv="hydraulics.",Gv=1e5,PC=220;function IC(i){return`hsl(${Math.round(PC*(1-Math.min(Math.max(i,0),1)))} 80% 42%)`}var ad=class{element;shown=[];levels=[];key;highest=0;frame=0;constructor(e,t,n){let s=W("div",{class:"diagram"});s.innerHTML=e,this.element=W("section",{class:"circuits"},W("h3",{},"Hydraulics"),sd("Large",s),s),this.key=s.querySelector("[data-highest]");for(let r of s.querySelectorAll("[data-level]"))t.get(0,Vv+r.getAttribute("data-level")).then(o=>{if(typeof o!="string"){this.levels.push({line:r,values:o});for(let a of o)this.highest=Math.max(this.highest,a);this.moveTo(this.frame)}});for(let r of s.querySelectorAll("[data-pressure]")){let o=Vv+r.getAttribute("data-pressure"),a={place:r,values:null};this.shown.push(a),r.textContent="",r.closest("text")?.addEventListener("click",()=>n.toggle(o)),t.get(0,o).then(l=>{typeof l!="string"&&(a.values=l,this.moveTo(this.frame))})}}moveTo(e){this.frame=e;for(let{place:t,values:n}of this.shown){let s=n?.[e];s!==void 0&&(t.textContent=`${+(s/Gv).toPrecision(4)} bar`)}for(let{line:t,values:n}of this.levels){let s=n[e];s!==void 0&&this.highest>0&&(t.style.stroke=IC(s/this.highest))}this.key&&this.highest>0&&(this.key.textContent=`${+(this.highest/Gv).toPrecision(4)}`)}};var hx=Object.defineProperty,LC=(i,e,t)=>e in i?hx(i,e,{enumerable:!0,configurable:!0,writable:!0,value:t}):i[e]=t,NC=(i,e)=>{for(var t in e)hx(i,t,{get:e[t],enumerable:!0})},DC=(i,e,t)=>LC(i,typeof e!="symbol"?e+"":e,t),FC={};NC(FC,{Graph:()=>Vi,alg:()=>gm});var OC=Object.defineProperty,ux=(i,e)=>{for(var t in e)OC(i,t,{get:e[t],enumerable:!0})},mm=class{constructor(i){this._isDirected=!0,this._isMultigraph=!1,this._isCompound=!1,this._nodes={},this._in={},this._preds={},this._out={},this._sucs={},this._edgeObjs={},this._edgeLabels={},this._nodeCount=0,this._edgeCount=0,this._defaultNodeLabelFn=()=>{},this._defaultEdgeLabelFn=()=>{},i&&(this._isDirected="directed"in i?i.directed:!0,this._isMultigraph="multigraph"in i?i.multigraph:!1,this._isCompound="compound"in i?i.compound:!1),this._isCompound&&(this._parent={},this._children={},this._children["\0"]={})}isDirected(){return this._isDirected}isMultigraph(){return this._isMultigraph}isCompound(){return this._isCompound}setGraph(i){return this._label=i,this}graph(){return this._label}setDefaultNodeLabel(i){return typeof i!="function"?this._defaultNodeLabelFn=()=>i:this._defaultNodeLabelFn=i,this}nodeCount(){return this._nodeCount}nodes(){return Object.keys(this._nodes)}sources(){return this.nodes().filter(i=>Object.keys(this._in[i]).length===0)}sinks(){return this.nodes().filter(i=>Object.keys(this._out[i]).length===0)}setNodes(i,e){return i.forEach(t=>{e!==void 0?this.setNode(t,e):this.setNode(t)}),this}setNode(i,e){return i in this._nodes?(arguments.length>1&&(this._nodes[i]=e),this):(this._nodes[i]=arguments.length>1?e:this._defaultNodeLabelFn(i),this._isCompound&&(this._parent[i]="\0",this._children[i]={},this._children["\0"][i]=!0),this._in[i]={},this._preds[i]={},this._out[i]={},this._sucs[i]={},++this._nodeCount,this)}node(i){return this._nodes[i]}hasNode(i){return i in this._nodes}removeNode(i){if(i in this._nodes){let e=t=>this.removeEdge(this._edgeObjs[t]);delete this._nodes[i],this._isCompound&&(this._removeFromParentsChildList(i),delete this._parent[i],this.children(i).forEach(t=>{this.setParent(t)}),delete this._children[i]),Object.keys(this._in[i]).forEach(e),delete this._in[i],delete this._preds[i],Object.keys(this._out[i]).forEach(e),delete this._out[i],delete this._sucs[i],--this._nodeCount}return this}setParent(i,e){if(!this._isCompound)throw new Error("Cannot set parent in a non-compound graph");if(e===void 0)e="\0";else{e+="";for(let t=e;t!==void 0;t=this.parent(t))if(t===i)throw new Error("Setting "+e+" as parent of "+i+" would create a cycle");this.setNode(e)}return this.setNode(i),this._removeFromParentsChildList(i),this._parent[i]=e,this._children[e][i]=!0,this}parent(i){if(this._isCompound){let e=this._parent[i];if(e!=="\0")return e}}children(i="\0"){if(this._isCompound){let e=this._children[i];if(e)return Object.keys(e)}else{if(i==="\0")return this.nodes();if(this.hasNode(i))return[]}return[]}predecessors(i){let e=this._preds[i];if(e)return Object.keys(e)}successors(i){let e=this._sucs[i];if(e)return Object.keys(e)}neighbors(i){let e=this.predecessors(i);if(e){let t=new Set(e),n=this.successors(i);if(n)for(let s of n)t.add(s);return Array.from(t.values())}}isLeaf(i){var e;let t;return this.isDirected()?t=this.successors(i):t=this.neighbors(i),((e=t?.length)!=null?e:0)===0}filterNodes(i){let e=new this.constructor({directed:this._isDirected,multigraph:this._isMultigraph,compound:this._isCompound});e.setGraph(this.graph()),Object.entries(this._nodes).forEach(([s,r])=>{i(s)&&e.setNode(s,r)}),Object.values(this._edgeObjs).forEach(s=>{e.hasNode(s.v)&&e.hasNode(s.w)&&e.setEdge(s,this.edge(s))});let t={},n=s=>{let r=this.parent(s);return!r||e.hasNode(r)?(t[s]=r,r):r in t?t[r]:n(r)};return this._isCompound&&e.nodes().forEach(s=>e.setParent(s,n(s))),e}setDefaultEdgeLabel(i){return typeof i!="function"?this._defaultEdgeLabelFn=()=>i:this._defaultEdgeLabelFn=i,this}edgeCount(){return this._edgeCount}edges(){return Object.values(this._edgeObjs)}setPath(i,e){return i.reduce((t,n)=>(e!==void 0?this.setEdge(t,n,e):this.setEdge(t,n),n)),this}setEdge(i,e,t,n){let s,r,o,a,l=!1;typeof i=="object"&&i!==null&&"v"in i?(s=i.v,r=i.w,o=i.name,arguments.length===2&&(a=e,l=!0)):(s=i,r=e,o=n,arguments.length>2&&(a=t,l=!0)),s=""+s,r=""+r,o!==void 0&&(o=""+o);let c=Wl(this._isDirected,s,r,o);if(c in this._edgeLabels)return l&&(this._edgeLabels[c]=a),this;if(o!==void 0&&!this._isMultigraph)throw new Error("Cannot set a named edge when isMultigraph = false");this.setNode(s),this.setNode(r),this._edgeLabels[c]=l?a:this._defaultEdgeLabelFn(s,r,o);let h=UC(this._isDirected,s,r,o);return s=h.v,r=h.w,Object.freeze(h),this._edgeObjs[c]=h,Wv(this._preds[r],s),Wv(this._sucs[s],r),this._in[r][c]=h,this._out[s][c]=h,this._edgeCount++,this}edge(i,e,t){let n=arguments.length===1?lm(this._isDirected,i):Wl(this._isDirected,i,e,t);return this._edgeLabels[n]}edgeAsObj(i,e,t){let n=arguments.length===1?this.edge(i):this.edge(i,e,t);return typeof n!="object"||n===null?{label:n}:n}hasEdge(i,e,t){return(arguments.length===1?lm(this._isDirected,i):Wl(this._isDirected,i,e,t))in this._edgeLabels}removeEdge(i,e,t){let n=arguments.length===1?lm(this._isDirected,i):Wl(this._isDirected,i,e,t),s=this._edgeObjs[n];if(s){let r=s.v,o=s.w;delete this._edgeLabels[n],delete this._edgeObjs[n],Xv(this._preds[o],r),Xv(this._sucs[r],o),delete this._in[o][n],delete this._out[r][n],this._edgeCount--}return this}inEdges(i,e){return this.isDirected()?this.filterEdges(this._in[i],i,e):this.nodeEdges(i,e)}outEdges(i,e){return this.isDirected()?this.filterEdges(this._out[i],i,e):this.nodeEdges(i,e)}nodeEdges(i,e){if(i in this._nodes)return this.filterEdges({...this._in[i],...this._out[i]},i,e)}_removeFromParentsChildList(i){delete this._children[this._parent[i]][i]}filterEdges(i,e,t){if(!i)return;let n=Object.values(i);return t?n.filter(s=>s.v===e&&s.w===t||s.v===t&&s.w===e):n}};function Wv(i,e){i[e]?i[e]++:i[e]=1}function Xv(i,e){i[e]!==void 0&&!--i[e]&&delete i[e]}function Wl(i,e,t,n){let s=""+e,r=""+t;if(!i&&s>r){let o=s;s=r,r=o}return s+""+r+""+(n===void 0?"\0":n)}function UC(i,e,t,n){let s=""+e,r=""+t;if(!i&&s>r){let a=s;s=r,r=a}let o={v:s,w:r};return n&&(o.name=n),o}function lm(i,e){return Wl(i,e.v,e.w,e.name)}var kC={};ux(kC,{read:()=>VC,write:()=>BC});function BC(i){let e={options:{directed:i.isDirected(),multigraph:i.isMultigraph(),compound:i.isCompound()},nodes:HC(i),edges:zC(i)},t=i.graph();return t!==void 0&&(e.value=structuredClone(t)),e}function HC(i){return i.nodes().map(e=>{let t=i.node(e),n=i.parent(e),s={v:e};return t!==void 0&&(s.value=t),n!==void 0&&(s.parent=n),s})}function zC(i){return i.edges().map(e=>{let t=i.edge(e),n={v:e.v,w:e.w};return e.name!==void 0&&(n.name=e.name),t!==void 0&&(n.value=t),n})}function VC(i){let e=new mm(i.options);return i.value!==void 0&&e.setGraph(i.value),i.nodes.forEach(t=>{e.setNode(t.v,t.value),t.parent&&e.setParent(t.v,t.parent)}),i.edges.forEach(t=>{e.setEdge({v:t.v,w:t.w,name:t.name},t.value)}),e}var gm={};ux(gm,{CycleException:()=>cd,bellmanFord:()=>dx,components:()=>XC,dijkstra:()=>ld,dijkstraAll:()=>$C,findCycles:()=>jC,floydWarshall:()=>JC,isAcyclic:()=>QC,postorder:()=>tP,preorder:()=>nP,prim:()=>iP,shortestPaths:()=>sP,tarjan:()=>px,topsort:()=>mx});var GC=()=>1;function dx(i,e,t,n){return WC(i,String(e),t||GC,n||function(s){var r;return(r=i.outEdges(s))!=null?r:[]})}function WC(i,e,t,n){let s={},r,o=0,a=i.nodes(),l=function(u){let d=s[u.v],f=s[u.w];if(!d||!f)return;let p=t(u);d.distance+p<f.distance&&(s[u.w]={distance:d.distance+p,predecessor:u.v},r=!0)},c=function(){a.forEach(function(u){n(u).forEach(function(d){let f=d.v===u?d.v:d.w,p=f===d.v?d.w:d.v;l({v:f,w:p})})})};a.forEach(function(u){let d=u===e?0:Number.POSITIVE_INFINITY;s[u]={distance:d,predecessor:""}});let h=a.length;for(let u=1;u<h&&(r=!1,o++,c(),!!r);u++);if(o===h-1&&(r=!1,c(),r))throw new Error("The graph contains a negative weight cycle");return s}function XC(i){let e={},t=[],n;function s(r){var o,a;r in e||(e[r]=!0,n.push(r),(o=i.successors(r))==null||o.forEach(s),(a=i.predecessors(r))==null||a.forEach(s))}return i.nodes().forEach(function(r){n=[],s(r),n.length&&t.push(n)}),t}var fx=class{constructor(){this._arr=[],this._keyIndices={}}size(){return this._arr.length}keys(){return this._arr.map(i=>i.key)}has(i){return i in this._keyIndices}priority(i){let e=this._keyIndices[i];if(e!==void 0)return this._arr[e].priority}min(){if(this.size()===0)throw new Error("Queue underflow");return this._arr[0].key}add(i,e){let t=this._keyIndices,n=String(i);if(!(n in t)){let s=this._arr,r=s.length;return t[n]=r,s.push({key:n,priority:e}),this._decrease(r),!0}return!1}removeMin(){if(this.size()===0)throw new Error("Queue underflow");this._swap(0,this._arr.length-1);let i=this._arr.pop();return delete this._keyIndices[i.key],this._heapify(0),i.key}decrease(i,e){let t=this._keyIndices[i];if(t===void 0)throw new Error(`Key not found: ${i}`);let n=this._arr[t].priority;if(e>n)throw new Error(`New priority is greater than current priority. Key: ${i} Old: ${n} New: ${e}`);this._arr[t].priority=e,this._decrease(t)}_heapify(i){let e=this._arr,t=2*i,n=t+1,s=i;t<e.length&&(s=e[t].priority<e[s].priority?t:s,n<e.length&&(s=e[n].priority<e[s].priority?n:s),s!==i&&(this._swap(i,s),this._heapify(s)))}_decrease(i){let e=this._arr,t=e[i].priority,n;for(;i!==0&&(n=i>>1,!(e[n].priority<t));)this._swap(i,n),i=n}_swap(i,e){let t=this._arr,n=this._keyIndices,s=t[i],r=t[e];t[i]=r,t[e]=s,n[r.key]=i,n[s.key]=e}},qC=()=>1;function ld(i,e,t,n){let s=function(r){var o;return(o=i.outEdges(r))!=null?o:[]};return YC(i,String(e),t||qC,n||s)}function YC(i,e,t,n){let s={},r=new fx,o,a,l=function(c){let h=c.v!==o?c.v:c.w,u=s[h];if(!u)return;let d=t(c),f=a.distance+d;if(d<0)throw new Error("dijkstra does not allow negative edge weights. Bad edge: "+c+" Weight: "+d);f<u.distance&&(u.distance=f,u.predecessor=o,r.decrease(h,f))};for(i.nodes().forEach(function(c){let h=c===e?0:Number.POSITIVE_INFINITY;s[c]={distance:h,predecessor:""},r.add(c,h)});r.size()>0;){o=r.removeMin();let c=s[o];if(!c||c.distance===Number.POSITIVE_INFINITY)break;a=c,n(o).forEach(l)}return s}function $C(i,e,t){return i.nodes().reduce(function(n,s){return n[s]=ld(i,s,e,t),n},{})}function px(i){let e=0,t=[],n={},s=[];function r(o){var a;let l=n[o]={onStack:!0,lowlink:e,index:e++};if(t.push(o),(a=i.successors(o))==null||a.forEach(function(c){if(c in n){let h=n[c];h!=null&&h.onStack&&(l.lowlink=Math.min(l.lowlink,h.index))}else{r(c);let h=n[c];h&&(l.lowlink=Math.min(l.lowlink,h.lowlink))}}),l.lowlink===l.index){let c=[],h;do{h=t.pop();let u=n[h];u&&(u.onStack=!1),c.push(h)}while(o!==h);s.push(c)}}return i.nodes().forEach(function(o){o in n||r(o)}),s}function jC(i){return px(i).filter(function(e){var t;let n=e[0];return n?e.length>1||e.length===1&&((t=i.outEdges(n,n))!=null?t:[]).length>0:!1})}var ZC=()=>1;function JC(i,e,t){return KC(i,e||ZC,t||function(n){var s;return(s=i.outEdges(n))!=null?s:[]})}function KC(i,e,t){let n={},s=i.nodes();return s.forEach(function(r){let o={};n[r]=o,o[r]={distance:0,predecessor:""},s.forEach(function(a){r!==a&&(o[a]={distance:Number.POSITIVE_INFINITY,predecessor:""})}),t(r).forEach(function(a){let l=a.v===r?a.w:a.v,c=e(a);o[l]={distance:c,predecessor:r}})}),s.forEach(function(r){let o=n[r];o&&s.forEach(function(a){let l=n[a];l&&s.forEach(function(c){let h=l[r],u=o[c],d=l[c];if(h&&u&&d){let f=h.distance+u.distance;f<d.distance&&(d.distance=f,d.predecessor=u.predecessor)}})})}),n}var cd=class extends Error{constructor(i){super(i),this.name="CycleException"}};function mx(i){let e={},t={},n=[];function s(r){var o;if(r in t)throw new cd;r in e||(t[r]=!0,e[r]=!0,(o=i.predecessors(r))==null||o.forEach(s),delete t[r],n.push(r))}if(i.sinks().forEach(s),Object.keys(e).length!==i.nodeCount())throw new cd;return n}function QC(i){try{mx(i)}catch(e){if(e instanceof cd)return!1;throw e}return!0}function eP(i,e,t,n,s){Array.isArray(e)||(e=[e]);let r=(a=>{var l;return(l=i.isDirected()?i.successors(a):i.neighbors(a))!=null?l:[]}),o={};return e.forEach(function(a){if(!i.hasNode(a))throw new Error("Graph does not have node: "+a);s=gx(i,a,t==="post",o,r,n,s)}),s}function gx(i,e,t,n,s,r,o){return e in n||(n[e]=!0,t||(o=r(o,e)),s(e).forEach(function(a){o=gx(i,a,t,n,s,r,o)}),t&&(o=r(o,e))),o}function yx(i,e,t){return eP(i,e,t,function(n,s){return n.push(s),n},[])}function tP(i,e){return yx(i,e,"post")}function nP(i,e){return yx(i,e,"pre")}function iP(i,e){var t;let n=new mm,s={},r=new fx,o;function a(h){let u=h.v===o?h.w:h.v,d=r.priority(u);if(d!==void 0){let f=e(h);f<d&&(s[u]=o,r.decrease(u,f))}}if(i.nodeCount()===0)return n;i.nodes().forEach(function(h){r.add(h,Number.POSITIVE_INFINITY),n.setNode(h)});let l=i.nodes()[0];l!==void 0&&r.decrease(l,0);let c=!1;for(;r.size()>0;){if(o=r.removeMin(),o in s)n.setEdge(o,s[o]);else{if(c)throw new Error("Input graph is not connected: "+i);c=!0}(t=i.nodeEdges(o))==null||t.forEach(a)}return n}function sP(i,e,t,n){return rP(i,e,t,n??(s=>{var r;return(r=i.outEdges(s))!=null?r:[]}))}function rP(i,e,t,n){if(t===void 0)return ld(i,e,t,n);let s=!1,r=i.nodes();for(let o=0;o<r.length;o++){let a=r[o];if(a===void 0)continue;let l=n(a);for(let c=0;c<l.length;c++){let h=l[c];if(!h)continue;let u=h.v===a?h.v:h.w,d=u===h.v?h.w:h.v;t({v:u,w:d})<0&&(s=!0)}if(s)return dx(i,e,t,n)}return ld(i,e,t,n)}var Vi=mm;function Qo(i,e,t,n){let s=n;for(;i.hasNode(s);)s=ym(n);return t.dummy=e,i.setNode(s,t),s}function oP(i){let e=new Vi().setGraph(i.graph());return i.nodes().forEach(t=>e.setNode(t,i.node(t))),i.edges().forEach(t=>{let n=e.edge(t.v,t.w)||{weight:0,minlen:1},s=i.edge(t);e.setEdge(t.v,t.w,{weight:n.weight+s.weight,minlen:Math.max(n.minlen,s.minlen)})}),e}function vx(i){let e=new Vi({multigraph:i.isMultigraph()}).setGraph(i.graph());return i.nodes().forEach(t=>{i.children(t).length||e.setNode(t,i.node(t))}),i.edges().forEach(t=>{e.setEdge(t,i.edge(t))}),e}function qv(i,e){let t=i.x,n=i.y,s=e.x-t,r=e.y-n,o=i.width/2,a=i.height/2;if(!s&&!r)throw new Error("Not possible to find intersection inside of the rectangle");let l,c;return s===0||Math.abs(r)*o>Math.abs(s)*a?(r<0&&(a=-a),l=a*s/r,c=a):(s<0&&(o=-o),l=o,c=o*r/s),{x:t+l,y:n+c}}function ud(i){let e=Xl(_x(i)+1).map(()=>[]);return i.nodes().forEach(t=>{let n=i.node(t),s=n.rank;s!==void 0&&(e[s]||(e[s]=[]),e[s][n.order]=t)}),e}function aP(i){let e=i.nodes().map(n=>{let s=i.node(n).rank;return s===void 0?Number.MAX_VALUE:s}),t=Es(Math.min,e);i.nodes().forEach(n=>{let s=i.node(n);Object.hasOwn(s,"rank")&&(s.rank-=t)})}function lP(i){let e=i.nodes().map(o=>i.node(o).rank).filter(o=>o!==void 0),t=Es(Math.min,e),n=[];i.nodes().forEach(o=>{let a=i.node(o).rank-t;n[a]||(n[a]=[]),n[a].push(o)});let s=0,r=i.graph().nodeRankFactor;Array.from(n).forEach((o,a)=>{o===void 0&&a%r!==0?--s:o!==void 0&&s&&o.forEach(l=>i.node(l).rank+=s)})}function Yv(i,e,t,n){let s={width:0,height:0};return arguments.length>=4&&(s.rank=t,s.order=n),Qo(i,"border",s,e)}function cP(i,e=xx){let t=[];for(let n=0;n<i.length;n+=e){let s=i.slice(n,n+e);t.push(s)}return t}var xx=65535;function Es(i,e){if(e.length>xx){let t=cP(e);return i(...t.map(n=>i(...n)))}else return i(...e)}function _x(i){let e=i.nodes().map(t=>{let n=i.node(t).rank;return n===void 0?Number.MIN_VALUE:n});return Es(Math.max,e)}function hP(i,e){let t={lhs:[],rhs:[]};return i.forEach(n=>{e(n)?t.lhs.push(n):t.rhs.push(n)}),t}function uP(i,e){return e()}var dP=0;function ym(i){let e=++dP;return i+(""+e)}function Xl(i,e,t=1){e==null&&(e=i,i=0);let n=r=>r<e;t<0&&(n=r=>e<r);let s=[];for(let r=i;n(r);r+=t)s.push(r);return s}function hd(i,e){let t={};for(let n of e)i[n]!==void 0&&(t[n]=i[n]);return t}function dd(i,e){let t;return typeof e=="string"?t=n=>n[e]:t=e,Object.entries(i).reduce((n,[s,r])=>(n[s]=t(r,s),n),{})}function fP(i,e){return i.reduce((t,n,s)=>(t[n]=e[s],t),{})}var fd="\0";function bx(i,e,t){var n,s,r,o,a,l;if(!(i&&e&&t&&e.dummy==="edge"&&t.dummy==="edge"&&e.edgeObj&&t.edgeObj&&i[e.edgeObj.v]&&i[t.edgeObj.v]&&i[e.edgeObj.w]&&i[t.edgeObj.w]))return 0;let c=!0;e.edgeObj.w===t.edgeObj.w&&(c=!1);let h=c?(s=(n=i[e.edgeObj.v])==null?void 0:n.rank)!=null?s:NaN+1:(o=(r=i[e.edgeObj.w])==null?void 0:r.rank)!=null?o:NaN-1,u=Object.entries(i).find(v=>{var g,m;return((g=v[1].edgeObj)==null?void 0:g.v)===e.edgeObj.v&&((m=v[1].edgeObj)==null?void 0:m.w)===e.edgeObj.w&&v[1].rank===h}),d=Object.entries(i).find(v=>{var g,m;return((g=v[1].edgeObj)==null?void 0:g.v)===t.edgeObj.v&&((m=v[1].edgeObj)==null?void 0:m.w)===t.edgeObj.w&&v[1].rank===h});if(!u||!d)return 0;let f=(a=u[1].order)!=null?a:NaN,p=(l=d[1].order)!=null?l:NaN;return isNaN(f-p)?0:f-p}var pP=class{constructor(){DC(this,"_sentinel");let i={};i._next=i._prev=i,this._sentinel=i}dequeue(){let i=this._sentinel,e=i._prev;if(e!==i)return $v(e),e}enqueue(i){let e=this._sentinel;i._prev&&i._next&&$v(i),i._next=e._next,e._next._prev=i,e._next=i,i._prev=e}toString(){let i=[],e=this._sentinel,t=e._prev;for(;t!==e;)i.push(JSON.stringify(t,mP)),t=t._prev;return"["+i.join(", ")+"]"}};function $v(i){i._prev._next=i._next,i._next._prev=i._prev,delete i._next,delete i._prev}function mP(i,e){if(i!=="_next"&&i!=="_prev")return e}var gP=pP,yP=()=>1;function vP(i,e){if(i.nodeCount()<=1)return[];let t=_P(i,e||yP);return xP(t.graph,t.buckets,t.zeroIdx).flatMap(n=>i.outEdges(n.v,n.w)||[])}function xP(i,e,t){var n;let s=[],r=e[e.length-1],o=e[0],a;for(;i.nodeCount();){for(;a=o.dequeue();)cm(i,e,t,a);for(;a=r.dequeue();)cm(i,e,t,a);if(i.nodeCount()){for(let l=e.length-2;l>0;--l)if(a=(n=e[l])==null?void 0:n.dequeue(),a){s=s.concat(cm(i,e,t,a,!0)||[]);break}}}return s}function cm(i,e,t,n,s){let r=[],o=s?r:void 0;return(i.inEdges(n.v)||[]).forEach(a=>{let l=i.edge(a),c=i.node(a.v);s&&r.push({v:a.v,w:a.w}),c.out-=l,pm(e,t,c)}),(i.outEdges(n.v)||[]).forEach(a=>{let l=i.edge(a),c=a.w,h=i.node(c);h.in-=l,pm(e,t,h)}),i.removeNode(n.v),o}function _P(i,e){let t=new Vi,n=0,s=0;i.nodes().forEach(a=>{t.setNode(a,{v:a,in:0,out:0})}),i.edges().forEach(a=>{let l=t.edge(a.v,a.w)||0,c=e(a),h=l+c;t.setEdge(a.v,a.w,h);let u=t.node(a.v),d=t.node(a.w);s=Math.max(s,u.out+=c),n=Math.max(n,d.in+=c)});let r=bP(s+n+3).map(()=>new gP),o=n+1;return t.nodes().forEach(a=>{pm(r,o,t.node(a))}),{graph:t,buckets:r,zeroIdx:o}}function pm(i,e,t){var n,s,r;t.out?t.in?(r=i[t.out-t.in+e])==null||r.enqueue(t):(s=i[i.length-1])==null||s.enqueue(t):(n=i[0])==null||n.enqueue(t)}function bP(i){let e=[];for(let t=0;t<i;t++)e.push(t);return e}function EP(i,e){(i.graph().acyclicer==="greedy"?vP(i,t(i)):wP(i,e??null)).forEach(n=>{let s=i.edge(n);i.removeEdge(n),s.forwardName=n.name,s.reversed=!0,i.setEdge(n.w,n.v,s,ym("rev"))});function t(n){return s=>n.edge(s).weight}}function wP(i,e){let t=[],n={},s={};function r(l){Object.hasOwn(s,l)||(s[l]=!0,n[l]=!0,i.outEdges(l).forEach(c=>{Object.hasOwn(n,c.w)?t.push(c):r(c.w)}),delete n[l])}function o(l){var c;Object.hasOwn(s,l)||(s[l]=!0,n[l]=!0,(c=i.outEdges(l))==null||c.forEach(h=>{var u,d;Object.hasOwn(n,h.w)||((u=e.node(l))==null?void 0:u.rank)>((d=e.node(h.w))==null?void 0:d.rank)&&SP(i,h.w,h)?t.push(h):o(h.w)}),delete n[l])}let a=r;return e&&typeof e.node=="function"&&(a=o),i.sources().forEach(a),i.nodes().forEach(a),t}function MP(i){i.edges().forEach(e=>{let t=i.edge(e);if(t.reversed){i.removeEdge(e);let n=t.forwardName;delete t.reversed,delete t.forwardName,i.setEdge(e.w,e.v,t,n)}})}function SP(i,e,t){let n=new Set;function s(r){var o;if(i.sources().includes(r))return!0;n.add(r);for(let a of(o=i.inEdges(r))!=null?o:[])if(!(a.v===t.v&&a.w===t.w)&&!n.has(a.v)&&s(a.v))return!0;return!1}return s(e)}function TP(i){i.graph().dummyChains=[],i.edges().forEach(e=>AP(i,e))}function AP(i,e){let t=e.v,n=i.node(t).rank,s=e.w,r=i.node(s).rank,o=e.name,a=i.edge(e),l=a.labelRank;if(r===n+1)return;i.removeEdge(e);let c,h,u;for(u=0,++n;n<r;++u,++n)a.points=[],h={width:0,height:0,edgeLabel:a,edgeObj:e,rank:n},c=Qo(i,"edge",h,"_d"),n===l&&(h.width=a.width,h.height=a.height,h.dummy="edge-label",h.labelpos=a.labelpos),i.setEdge(t,c,{weight:a.weight},o),u===0&&i.graph().dummyChains.push(c),t=c;i.setEdge(t,s,{weight:a.weight},o)}function RP(i){i.graph().dummyChains.forEach(e=>{let t=i.node(e),n=t.edgeLabel,s;for(i.setEdge(t.edgeObj,n);t.dummy;)s=i.successors(e)[0],i.removeNode(e),n.points.push({x:t.x,y:t.y}),t.dummy==="edge-label"&&(n.x=t.x,n.y=t.y,n.width=t.width,n.height=t.height),e=s,t=i.node(e)})}function vm(i){let e={};function t(n){let s=i.node(n);if(Object.hasOwn(e,n))return s.rank;e[n]=!0;let r=i.outEdges(n),o=r?r.map(l=>l==null?Number.POSITIVE_INFINITY:t(l.w)-i.edge(l).minlen):[],a=Es(Math.min,o);return a===Number.POSITIVE_INFINITY&&(a=0),s.rank=a}i.sources().forEach(t)}function Ko(i,e){return i.node(e.w).rank-i.node(e.v).rank-i.edge(e).minlen}var Ex=CP;function CP(i){let e=new Vi({directed:!1}),t=i.nodes();if(t.length===0)throw new Error("Graph must have at least one node");let n=t[0],s=i.nodeCount();e.setNode(n,{});let r,o;for(;PP(e,i)<s&&(r=IP(e,i),!!r);)o=e.hasNode(r.v)?Ko(i,r):-Ko(i,r),LP(e,i,o);return e}function PP(i,e){function t(n){let s=e.nodeEdges(n);s&&s.forEach(r=>{let o=r.v,a=n===o?r.w:o;!i.hasNode(a)&&!Ko(e,r)&&(i.setNode(a,{}),i.setEdge(n,a,{}),t(a))})}return i.nodes().forEach(t),i.nodeCount()}function IP(i,e){return e.edges().reduce((t,n)=>{let s=Number.POSITIVE_INFINITY;return i.hasNode(n.v)!==i.hasNode(n.w)&&(s=Ko(e,n)),s<t[0]?[s,n]:t},[Number.POSITIVE_INFINITY,null])[1]}function LP(i,e,t){i.nodes().forEach(n=>e.node(n).rank+=t)}var{preorder:NP,postorder:DP}=gm,FP=Xr;Xr.initLowLimValues=_m;Xr.initCutValues=xm;Xr.calcCutValue=wx;Xr.leaveEdge=Sx;Xr.enterEdge=Tx;Xr.exchangeEdges=Ax;function Xr(i){i=oP(i),vm(i);let e=Ex(i);_m(e),xm(e,i);let t,n;for(;t=Sx(e);)n=Tx(e,i,t),Ax(e,i,t,n)}function xm(i,e){let t=DP(i,i.nodes());t=t.slice(0,t.length-1),t.forEach(n=>OP(i,e,n))}function OP(i,e,t){let n=i.node(t).parent,s=i.edge(t,n);s.cutvalue=wx(i,e,t)}function wx(i,e,t){let n=i.node(t).parent,s=!0,r=e.edge(t,n),o=0;r||(s=!1,r=e.edge(n,t)),o=r.weight;let a=e.nodeEdges(t);return a&&a.forEach(l=>{let c=l.v===t,h=c?l.w:l.v;if(h!==n){let u=c===s,d=e.edge(l).weight;if(o+=u?d:-d,kP(i,t,h)){let f=i.edge(t,h).cutvalue;o+=u?-f:f}}}),o}function _m(i,e){arguments.length<2&&(e=i.nodes()[0]),Mx(i,{},1,e)}function Mx(i,e,t,n,s){let r=t,o=i.node(n);e[n]=!0;let a=i.neighbors(n);return a&&a.forEach(l=>{Object.hasOwn(e,l)||(t=Mx(i,e,t,l,n))}),o.low=r,o.lim=t++,s?o.parent=s:delete o.parent,t}function Sx(i){return i.edges().find(e=>i.edge(e).cutvalue<0)}function Tx(i,e,t){let n=t.v,s=t.w;e.hasEdge(n,s)||(n=t.w,s=t.v);let r=i.node(n),o=i.node(s),a=r,l=!1;return r.lim>o.lim&&(a=o,l=!0),e.edges().filter(c=>l===jv(i,i.node(c.v),a)&&l!==jv(i,i.node(c.w),a)).reduce((c,h)=>Ko(e,h)<Ko(e,c)?h:c)}function Ax(i,e,t,n){let s=t.v,r=t.w;i.removeEdge(s,r),i.setEdge(n.v,n.w,{}),_m(i),xm(i,e),UP(i,e)}function UP(i,e){let t=i.nodes().find(s=>!i.node(s).parent);if(!t)return;let n=NP(i,[t]);n=n.slice(1),n.forEach(s=>{let r=i.node(s).parent,o=e.edge(s,r),a=!1;o||(o=e.edge(r,s),a=!0),e.node(s).rank=e.node(r).rank+(a?o.minlen:-o.minlen)})}function kP(i,e,t){return i.hasEdge(e,t)}function jv(i,e,t){return t.low<=e.lim&&e.lim<=t.lim}var BP=HP;function HP(i){let e=i.graph().ranker;if(typeof e=="function")return e(i);switch(e){case"network-simplex":Zv(i);break;case"tight-tree":VP(i);break;case"longest-path":zP(i);break;case"none":break;default:Zv(i)}}var zP=vm;function VP(i){vm(i),Ex(i)}function Zv(i){FP(i)}var GP=WP;function WP(i){let e=qP(i),t=i.graph();Array.isArray(t.dummyChains)&&t.dummyChains.forEach(n=>{let s=i.node(n),r=s.edgeObj,o=XP(i,e,r.v,r.w),a=o.path,l=o.lca,c=0,h=a[c],u=!0;for(;n!==r.w;){if(s=i.node(n),u){for(;(h=a[c])!==l&&i.node(h).maxRank<s.rank;)c++;h===l&&(u=!1)}if(!u){for(;c<a.length-1&&i.node(a[c+1]).minRank<=s.rank;)c++;h=a[c]}h!==void 0&&i.setParent(n,h),n=i.successors(n)[0]}})}function XP(i,e,t,n){let s=[],r=[],o=Math.min(e[t].low,e[n].low),a=Math.max(e[t].lim,e[n].lim),l;l=t;do l=i.parent(l),s.push(l);while(l&&(e[l].low>o||a>e[l].lim));let c=l,h=n;for(;(h=i.parent(h))!==c;)r.push(h);return{path:s.concat(r.reverse()),lca:c}}function qP(i){let e={},t=0;function n(s){let r=t;i.children(s).forEach(n),e[s]={low:r,lim:t++}}return i.children(fd).forEach(n),e}function YP(i){let e=Qo(i,"root",{},"_root"),t=$P(i),n=Object.values(t),s=Es(Math.max,n)-1,r=2*s+1;i.graph().nestingRoot=e,i.edges().forEach(a=>i.edge(a).minlen*=r);let o=jP(i)+1;i.children(fd).forEach(a=>{Rx(i,e,r,o,s,t,a)}),i.graph().nodeRankFactor=r}function Rx(i,e,t,n,s,r,o){var a;let l=i.children(o);if(!l.length){o!==e&&i.setEdge(e,o,{weight:0,minlen:t});return}let c=Yv(i,"_bt"),h=Yv(i,"_bb"),u=i.node(o);i.setParent(c,o),u.borderTop=c,i.setParent(h,o),u.borderBottom=h,l.forEach(d=>{var f;Rx(i,e,t,n,s,r,d);let p=i.node(d),v=p.borderTop?p.borderTop:d,g=p.borderBottom?p.borderBottom:d,m=p.borderTop?n:2*n,y=v!==g?1:s-((f=r[o])!=null?f:0)+1;i.setEdge(c,v,{weight:m,minlen:y,nestingEdge:!0}),i.setEdge(g,h,{weight:m,minlen:y,nestingEdge:!0})}),i.parent(o)||i.setEdge(e,c,{weight:0,minlen:s+((a=r[o])!=null?a:0)})}function $P(i){let e={};function t(n,s){let r=i.children(n);r&&r.length&&r.forEach(o=>t(o,s+1)),e[n]=s}return i.children(fd).forEach(n=>t(n,1)),e}function jP(i){return i.edges().reduce((e,t)=>e+i.edge(t).weight,0)}function ZP(i){let e=i.graph();i.removeNode(e.nestingRoot),delete e.nestingRoot,i.edges().forEach(t=>{i.edge(t).nestingEdge&&i.removeEdge(t)})}var JP=KP;function KP(i){function e(t){let n=i.children(t),s=i.node(t);if(n.length&&n.forEach(e),s&&Object.hasOwn(s,"minRank")){s.borderLeft=[],s.borderRight=[];for(let r=s.minRank,o=s.maxRank+1;r<o;++r)Jv(i,"borderLeft","_bl",t,s,r),Jv(i,"borderRight","_br",t,s,r)}}i.children(fd).forEach(e)}function Jv(i,e,t,n,s,r){let o={width:0,height:0,rank:r,borderType:e},a=s[e][r-1],l=Qo(i,"border",o,t);s[e][r]=l,i.setParent(l,n),a&&i.setEdge(a,l,{weight:1})}function QP(i){var e;let t=(e=i.graph().rankdir)==null?void 0:e.toLowerCase();(t==="lr"||t==="rl")&&Cx(i)}function e3(i){var e;let t=(e=i.graph().rankdir)==null?void 0:e.toLowerCase();(t==="bt"||t==="rl")&&t3(i),(t==="lr"||t==="rl")&&(n3(i),Cx(i))}function Cx(i){i.nodes().forEach(e=>Kv(i.node(e))),i.edges().forEach(e=>Kv(i.edge(e)))}function Kv(i){let e=i.width;i.width=i.height,i.height=e}function t3(i){i.nodes().forEach(e=>hm(i.node(e))),i.edges().forEach(e=>{var t;let n=i.edge(e);(t=n.points)==null||t.forEach(hm),Object.hasOwn(n,"y")&&hm(n)})}function hm(i){i.y=-i.y}function n3(i){i.nodes().forEach(e=>um(i.node(e))),i.edges().forEach(e=>{var t;let n=i.edge(e);(t=n.points)==null||t.forEach(um),Object.hasOwn(n,"x")&&um(n)})}function um(i){let e=i.x;i.x=i.y,i.y=e}function i3(i,e=null){let t={},n=i.nodes().filter(c=>!i.children(c).length),s=n.map(c=>i.node(c).rank),r=Es(Math.max,s),o=Xl(r+1).map(()=>[]);function a(c){if(t[c])return;t[c]=!0;let h=i.node(c);o[h.rank].push(c);let u=i.successors(c);u&&[...u].sort((d,f)=>l(d,f)).forEach(a)}n.sort((c,h)=>i.node(c).rank-i.node(h).rank).forEach(a);function l(c,h){let u=i.node(c),d=i.node(h);return bx(e,u,d)}return o}function s3(i,e){let t=0;for(let n=1;n<e.length;++n)t+=r3(i,e[n-1],e[n]);return t}function r3(i,e,t){let n=fP(t,t.map((c,h)=>h)),s=e.flatMap(c=>{let h=i.outEdges(c);return h?h.map(u=>({pos:n[u.w],weight:i.edge(u).weight})).sort((u,d)=>u.pos-d.pos):[]}),r=1;for(;r<t.length;)r<<=1;let o=2*r-1;r-=1;let a=new Array(o).fill(0),l=0;return s.forEach(c=>{let h=c.pos+r;a[h]+=c.weight;let u=0;for(;h>0;)h%2&&(u+=a[h+1]),h=h-1>>1,a[h]+=c.weight;l+=c.weight*u}),l}function o3(i,e=[]){return e.map(t=>{let n=i.inEdges(t);if(!n||!n.length)return{v:t};{let s=n.reduce((r,o)=>{let a=i.edge(o),l=i.node(o.v);return{sum:r.sum+a.weight*l.order,weight:r.weight+a.weight}},{sum:0,weight:0});return{v:t,barycenter:s.sum/s.weight,weight:s.weight}}})}function a3(i,e){let t={};i.forEach((s,r)=>{let o={indegree:0,in:[],out:[],vs:[s.v],i:r};s.barycenter!==void 0&&(o.barycenter=s.barycenter,o.weight=s.weight),t[s.v]=o}),e.edges().forEach(s=>{let r=t[s.v],o=t[s.w];r!==void 0&&o!==void 0&&(o.indegree++,r.out.push(o))});let n=Object.values(t).filter(s=>!s.indegree);return l3(n)}function l3(i){let e=[];function t(s){return r=>{r.merged||(r.barycenter===void 0||s.barycenter===void 0||r.barycenter>=s.barycenter)&&c3(s,r)}}function n(s){return r=>{r.in.push(s),--r.indegree===0&&i.push(r)}}for(;i.length;){let s=i.pop();e.push(s),s.in.reverse().forEach(t(s)),s.out.forEach(n(s))}return e.filter(s=>!s.merged).map(s=>hd(s,["vs","i","barycenter","weight"]))}function c3(i,e){let t=0,n=0;i.weight&&(t+=i.barycenter*i.weight,n+=i.weight),e.weight&&(t+=e.barycenter*e.weight,n+=e.weight),i.vs=e.vs.concat(i.vs),i.barycenter=t/n,i.weight=n,i.i=Math.min(e.i,i.i),e.merged=!0}function h3(i,e,t,n,s){let r={},o=null,a=null,l=s;typeof e=="boolean"?(l=e,r={}):e&&(r=e,o=t??null,a=n??null);let c=hP(i,m=>Object.hasOwn(m,"barycenter")),h=c.lhs,u=c.rhs.sort((m,y)=>y.i-m.i),d=[],f=0,p=0,v=0;h.sort(u3(a,o,!!l));for(let[m,y]of Object.entries(r)){let b=h.findIndex(x=>x.vs[0]===m);h.splice(b+1,0,y)}v=Qv(d,u,v),h.forEach(m=>{v+=m.vs.length,d.push(m.vs),f+=m.barycenter*m.weight,p+=m.weight,v=Qv(d,u,v)});let g={vs:d.flat(1)};return p&&(g.barycenter=f/p,g.weight=p),g}function Qv(i,e,t){let n;for(;e.length&&(n=e[e.length-1]).i<=t;)e.pop(),i.push(n.vs),t++;return t}function u3(i,e,t){return(n,s)=>{if(n.barycenter<s.barycenter)return-1;if(n.barycenter>s.barycenter)return 1;if(i&&(typeof n.vs[0]=="string"||typeof s.vs[0]=="string")){let r=i.node(n.vs[0]),o=i.node(s.vs[0]),a=bx(e,r,o);if(a!==0)return a}return t?s.i-n.i:n.i-s.i}}function Px(i,e,t,n,s){var r,o,a,l,c,h,u,d,f,p,v;let g=null,m=s;typeof n=="boolean"?(m=n,g=null):n!==void 0&&(g=n);let y=i.children(e),b=i.node(e),x=b?b.borderLeft:void 0,T=b?b.borderRight:void 0,M={};x&&(y=y.filter(U=>U!==x&&U!==T));let _=o3(i,y);_.forEach(U=>{if(i.children(U.v).length){let{result:H}=Px(i,U.v,t,g,m);M[U.v]=H,Object.hasOwn(H,"barycenter")&&f3(U,H)}});let w=a3(_,t);d3(w,M);let N={},P=!1;for(let U=0;U<w.length;U++)for(let H=U+1;H<w.length;H++)if(!(!w[U]||!w[H]||!((r=w[U])!=null&&r.barycenter)||!((o=w[H])!=null&&o.barycenter))&&((a=w[U])==null?void 0:a.barycenter)===w[H].barycenter){let L=(c=(l=w[U])==null?void 0:l.vs[0])!=null?c:"",k=(u=(h=w[H])==null?void 0:h.vs[0])!=null?u:"",q=i.node(L),V=i.node(k);if(q.dummy==="edge"&&V.dummy==="edge"&&((d=q.edgeObj)==null?void 0:d.v)===((f=V.edgeObj)==null?void 0:f.v)&&((p=q.edgeObj)==null?void 0:p.w)===((v=V.edgeObj)==null?void 0:v.w))if(q.edgeLabel.reversed){N[k]=w[U],w.splice(U,1),U--;break}else N[L]||(N[L]=w[H],w.splice(H,1),H--);else P=!0}let I=h3(w,N,g,i,m);if(x&&T){I.vs=[x,I.vs,T].flat(1);let U=i.predecessors(x);if(U&&U.length){let H=i.node(U[0]),L=i.predecessors(T),k=i.node(L[0]);Object.hasOwn(I,"barycenter")||(I.barycenter=0,I.weight=0),I.barycenter=(I.barycenter*I.weight+H.order+k.order)/(I.weight+2),I.weight+=2}}return Object.defineProperty(I,"result",{value:I,enumerable:!1,configurable:!0,writable:!0}),Object.defineProperty(I,"usedBias",{value:P,enumerable:!1,configurable:!0,writable:!0}),I}function d3(i,e){i.forEach(t=>{t.vs=t.vs.flatMap(n=>e[n]?e[n].vs:n)})}function f3(i,e){i.barycenter!==void 0?(i.barycenter=(i.barycenter*i.weight+e.barycenter*e.weight)/(i.weight+e.weight),i.weight+=e.weight):(i.barycenter=e.barycenter,i.weight=e.weight)}function p3(i,e,t,n){n||(n=i.nodes());let s=m3(i),r=new Vi({compound:!0}).setGraph({root:s}).setDefaultNodeLabel(o=>i.node(o));return n.forEach(o=>{let a=i.node(o),l=i.parent(o);if(a.rank===e||a.minRank<=e&&e<=a.maxRank){r.setNode(o),r.setParent(o,l||s);let c=i[t](o);c&&c.forEach(h=>{let u=h.v===o?h.w:h.v,d=r.edge(u,o),f=d!==void 0?d.weight:0;r.setEdge(u,o,{weight:i.edge(h).weight+f})}),Object.hasOwn(a,"minRank")&&r.setNode(o,{borderLeft:a.borderLeft[e],borderRight:a.borderRight[e]})}}),r}function m3(i){let e;for(;i.hasNode(e=ym("_root")););return e}function g3(i,e,t){let n={},s;t.forEach(r=>{let o=i.parent(r),a,l;for(;o;){if(a=i.parent(o),a?(l=n[a],n[a]=o):(l=s,s=o),l&&l!==o){e.setEdge(l,o);return}o=a}})}function Ix(i,e={},t=null){if(typeof e.customOrder=="function"){e.customOrder(i,Ix);return}let n=_x(i),s=ex(i,Xl(1,n+1),"inEdges"),r=ex(i,Xl(n-1,-1,-1),"outEdges"),o=i3(i,t);if(tx(i,o),e.disableOptimalOrderHeuristic)return;let a=Number.POSITIVE_INFINITY,l,c=e.constraints||[];for(let h=0,u=0;u<4;++h,++u){y3(h%2?s:r,h%4>=2,c,t),o=ud(i);let d=s3(i,o);d<a?(u=0,l=Object.assign({},o),a=d):d===a&&(l=structuredClone(o))}tx(i,l)}function ex(i,e,t){let n=new Map,s=(r,o)=>{n.has(r)||n.set(r,[]),n.get(r).push(o)};for(let r of i.nodes()){let o=i.node(r);if(typeof o.rank=="number"&&s(o.rank,r),typeof o.minRank=="number"&&typeof o.maxRank=="number")for(let a=o.minRank;a<=o.maxRank;a++)a!==o.rank&&s(a,r)}return e.map(function(r){return p3(i,r,t,n.get(r)||[])})}function y3(i,e,t,n){let s=!0,r=new Vi;i.forEach(function(o){t.forEach(h=>r.setEdge(h.left,h.right));let a=o.graph().root,{result:l,usedBias:c}=Px(o,a,r,n,s);e&&c&&(s=!s),l.vs.forEach((h,u)=>o.node(h).order=u),g3(o,r,l.vs)})}function tx(i,e){Object.values(e).forEach(t=>t.forEach((n,s)=>i.node(n).order=s))}function v3(i,e){let t={};function n(s,r){let o=0,a=0,l=s.length,c=r[r.length-1];return r.forEach((h,u)=>{let d=_3(i,h),f=d?i.node(d).order:l;(d||h===c)&&(r.slice(a,u+1).forEach(p=>{let v=i.predecessors(p);v&&v.forEach(g=>{let m=i.node(g),y=m.order;(y<o||f<y)&&!(m.dummy&&i.node(p).dummy)&&Lx(t,g,p)})}),a=u+1,o=f)}),r}return e.length&&e.reduce(n),t}function x3(i,e){let t={};function n(o){var a;return((a=i.node(o))==null?void 0:a.dummy)==="border"}if(!i.nodes().some(n))return t;function s(o,a,l,c,h){Xl(a,l).forEach(u=>{let d=o[u];if(d!==void 0&&i.node(d).dummy){let f=i.predecessors(d);f&&f.forEach(p=>{if(p===void 0)return;let v=i.node(p);v.dummy&&(v.order<c||v.order>h)&&Lx(t,p,d)})}})}function r(o,a){let l=-1,c=-1,h=0;return a.forEach((u,d)=>{if(n(u)){let f=i.predecessors(u);if(f&&f.length){let p=f[0];if(p===void 0)return;c=i.node(p).order,s(a,h,d,l,c),h=d,l=c}}s(a,h,a.length,c,o.length)}),a}return e.length&&e.reduce(r),t}function _3(i,e){if(i.node(e).dummy){let t=i.predecessors(e);if(t)return t.find(n=>i.node(n).dummy)}}function Lx(i,e,t){if(e>t){let s=e;e=t,t=s}let n=i[e];n||(i[e]=n={}),n[t]=!0}function b3(i,e,t){if(e>t){let s=e;e=t,t=s}let n=i[e];return n!==void 0&&Object.hasOwn(n,t)}function E3(i,e,t,n,s){let r={},o={},a={};return e.forEach(l=>{l.forEach((c,h)=>{r[c]=c,o[c]=c,a[c]=h})}),e.forEach(l=>{let c=-1,h=-1,u=!1,d=l,f=l.findIndex(p=>s?.includes(p)||nx(p,i,s));f>0&&(d=[l[f],...l.slice(0,f),...l.slice(f+1)],u=!0),d.forEach(p=>{var v;let g=n(p);if(g&&g.length){s!=null&&s.includes(p)&&(g=g.filter(b=>nx(b,i,s)));let m=g.sort((b,x)=>{let T=a[b],M=a[x];return(T!==void 0?T:0)-(M!==void 0?M:0)}),y=(m.length-1)/2;for(let b=Math.floor(y),x=Math.ceil(y);b<=x;++b){let T=m[b];if(T===void 0)continue;let M=a[T];if(M!==void 0&&o[p]===p&&c<M&&a[T]!==h&&!b3(t,p,T)){let _=r[T];_!==void 0&&(o[T]=p,o[p]=r[p]=_,c=M,u&&(c=-1,h=(v=a[T])!=null?v:-1,u=!1))}}}})}),{root:r,align:o}}function w3(i,e,t,n,s=!1){let r={},o=M3(i,e,t,s),a=s?"borderLeft":"borderRight";function l(f,p){let v=o.nodes().slice(),g={},m=v.pop();for(;m;){if(g[m])f(m);else{g[m]=!0,v.push(m);for(let y of p(m))v.push(y)}m=v.pop()}}function c(f){let p=o.inEdges(f);p?r[f]=p.reduce((v,g)=>{var m;let y=(m=r[g.v])!=null?m:0,b=o.edge(g);return Math.max(v,y+(b!==void 0?b:0))},0):r[f]=0}function h(f){let p=o.outEdges(f),v=Number.POSITIVE_INFINITY;p&&(v=p.reduce((m,y)=>{let b=r[y.w],x=o.edge(y);return Math.min(m,(b!==void 0?b:0)-(x!==void 0?x:0))},Number.POSITIVE_INFINITY));let g=i.node(f);v!==Number.POSITIVE_INFINITY&&g.borderType!==a&&(r[f]=Math.max(r[f]!==void 0?r[f]:0,v))}function u(f){return o.predecessors(f)||[]}function d(f){return o.successors(f)||[]}return l(c,u),l(h,d),Object.keys(n).forEach(f=>{var p;let v=t[f];v!==void 0&&(r[f]=(p=r[v])!=null?p:0)}),r}function M3(i,e,t,n){let s=new Vi,r=i.graph(),o=C3(r.nodesep,r.edgesep,n);return e.forEach(a=>{let l;a.forEach(c=>{let h=t[c];if(h!==void 0){if(s.setNode(h),l!==void 0){let u=t[l];if(u!==void 0){let d=s.edge(u,h);s.setEdge(u,h,Math.max(o(i,c,l),d||0))}}l=c}})}),s}function S3(i,e){return Object.values(e).reduce((t,n)=>{let s=Number.NEGATIVE_INFINITY,r=Number.POSITIVE_INFINITY;Object.entries(n).forEach(([a,l])=>{let c=P3(i,a)/2;s=Math.max(l+c,s),r=Math.min(l-c,r)});let o=s-r;return o<t[0]&&(t=[o,n]),t},[Number.POSITIVE_INFINITY,null])[1]}function T3(i,e){let t=Object.values(e),n=Es(Math.min,t),s=Es(Math.max,t);["u","d"].forEach(r=>{["l","r"].forEach(o=>{let a=r+o,l=i[a];if(!l||l===e)return;let c=Object.values(l),h=n-Es(Math.min,c);o!=="l"&&(h=s-Es(Math.max,c)),h&&(i[a]=dd(l,u=>u+h))})})}function A3(i,e=void 0){let t=i.ul;return t?dd(t,(n,s)=>{var r,o;if(e){let l=e.toLowerCase(),c=i[l];if(c&&c[s]!==void 0)return c[s]}let a=Object.values(i).map(l=>{let c=l[s];return c!==void 0?c:0}).sort((l,c)=>l-c);return(((r=a[1])!=null?r:0)+((o=a[2])!=null?o:0))/2}):{}}function R3(i,e){let t=ud(i),n=Object.assign(v3(i,t),x3(i,t)),s={},r;["u","d"].forEach(a=>{r=a==="u"?t:Object.values(t).reverse(),["l","r"].forEach(l=>{l==="r"&&(r=r.map(u=>Object.values(u).reverse()));let c=E3(i,r,n,u=>(a==="u"?i.predecessors(u):i.successors(u))||[],e),h=w3(i,r,c.root,c.align,l==="r");l==="r"&&(h=dd(h,u=>-u)),s[a+l]=h})});let o=S3(i,s);return T3(s,o),A3(s,i.graph().align)}function C3(i,e,t){return(n,s,r)=>{let o=n.node(s),a=n.node(r),l=0,c;if(l+=o.width/2,Object.hasOwn(o,"labelpos"))switch(o.labelpos.toLowerCase()){case"l":c=-o.width/2;break;case"r":c=o.width/2;break}if(c&&(l+=t?c:-c),c=void 0,l+=(o.dummy?e:i)/2,l+=(a.dummy?e:i)/2,l+=a.width/2,Object.hasOwn(a,"labelpos"))switch(a.labelpos.toLowerCase()){case"l":c=a.width/2;break;case"r":c=-a.width/2;break}return c&&(l+=t?c:-c),l}}function P3(i,e){return i.node(e).width}function nx(i,e,t){var n;if(!t)return!1;let s=(n=e.node(i))==null?void 0:n.edgeObj;if(!s||e.node(i).edgeLabel.reversed)return!1;let r=t.indexOf(s?.v),o=t.indexOf(s?.w);return r!==-1&&o!==-1&&r===(o+1)%t.length||r===(o-1)%t.length}function I3(i,e){i=vx(i),L3(i),Object.entries(R3(i,e)).forEach(([t,n])=>i.node(t).x=n)}function L3(i){let e=ud(i),t=i.graph(),n=t.ranksep,s=t.rankalign,r=0;e.forEach(o=>{let a=o.reduce((l,c)=>{var h;let u=(h=i.node(c).height)!=null?h:0;return l>u?l:u},0);o.forEach(l=>{let c=i.node(l);s==="top"?c.y=r+c.height/2:s==="bottom"?c.y=r+a-c.height/2:c.y=r+a/2}),r+=a+n})}var ix=new WeakMap;function Nx(i,e={}){return Dx(i,uP,e),i}function sx(i,e,t){let n=e;for(;n!==void 0;){let s=i.parent(n);if(s===t)return n;n=s}}function Dx(i,e,t){var n;let s=i.nodes().filter(y=>i.children(y).length),r={};s.forEach(y=>{let b=i.node(y);if(b&&b.rankdir){let x=new Vi({multigraph:!0,compound:!0});x.setGraph({rankdir:b.rankdir});let T=i.children(y);T.forEach(L=>{let k={...i.node(L)};x.setNode(L,k);let q=i.parent(L);q&&q!==y&&T.includes(q)&&x.setParent(L,q)});let M=new Set;i.edges().forEach(L=>{let k=sx(i,L.v,y),q=sx(i,L.w,y);if(k===L.v&&q===L.w)x.setEdge(L,{...i.edge(L)});else if(k&&q&&k!==q){let V=`${k}\0${q}`;M.has(V)||(M.add(V),x.setEdge(k,q,{...i.edge(L)}))}}),Dx(x,e,t);let _=cx(x);ox(_,e,t,null),ax(x,_);let w=1/0,N=1/0,P=-1/0,I=-1/0;x.nodes().forEach(L=>{if(L===y)return;let k=x.node(L);k&&typeof k.x=="number"&&typeof k.y=="number"&&typeof k.width=="number"&&typeof k.height=="number"&&(w=Math.min(w,k.x-k.width/2),P=Math.max(P,k.x+k.width/2),N=Math.min(N,k.y-k.height/2),I=Math.max(I,k.y+k.height/2))}),(!isFinite(w)||!isFinite(N)||!isFinite(P)||!isFinite(I))&&(w=N=0,P=I=0);let U=P-w,H=I-N;r[y]={minX:w,minY:N,maxX:P,maxY:I,width:U,height:H,offsetX:w,offsetY:N},b._dagreClusterSubgraph=x}});let o=[],a=y=>{let b=[],x=(i.children(y)||[]).filter(T=>T!==y);for(;x.length>0;){let T=x.shift();b.push(T),(i.children(T)||[]).filter(M=>M!==T).forEach(M=>x.push(M))}return b},l=new Map;s.forEach(y=>{let b=i.node(y);b&&b.rankdir&&r[y]&&l.set(y,(i.children(y)||[]).filter(x=>x!==y))});let c=new Set([...l.values()].flat()),h=new Map;l.forEach((y,b)=>{c.has(b)||h.set(b,a(b))});let u=new Set([...h.values()].flat()),d=y=>{for(let[b,x]of h)if(x.includes(y))return b;return y},f=[];i.edges().forEach(y=>{(u.has(y.v)||u.has(y.w))&&f.push({edge:y,label:i.edge(y)})});let p=new Map;u.forEach(y=>{let b=i.parent(y);p.set(y,typeof b=="string"?b:void 0)}),h.forEach((y,b)=>{let x=i.node(b),T=[];y.forEach(w=>{let N=i.node(w);N&&(T.push({id:w,node:N,parent:p.get(w)}),i.removeNode(w))});let M=f.filter(({edge:w})=>y.includes(w.v)||y.includes(w.w)),_=r[b];x&&(o.push({clusterId:b,subgraph:x._dagreClusterSubgraph,bounds:_,children:y,removedNodes:T,removedEdges:M}),x.width=_.width,x.height=_.height)});let v=new Set;f.forEach(({edge:y,label:b})=>{let x=d(y.v),T=d(y.w);if(x!==T&&i.hasNode(x)&&i.hasNode(T)){let M=`${x}\0${T}`;v.has(M)||(v.add(M),i.setEdge(x,T,{...b,width:0,height:0}))}});let g=cx(i),m=ox(g,e,t,(n=ix.get(i))!=null?n:null);ix.set(i,m),ax(i,g),v.forEach(y=>{let b=y.indexOf("\0"),x=y.slice(0,b),T=y.slice(b+1);i.hasEdge(x,T)&&i.removeEdge(x,T)}),o.forEach(({clusterId:y,subgraph:b,bounds:x,removedNodes:T,removedEdges:M})=>{var _,w;let N=i.node(y),P=(_=N?.x)!=null?_:0,I=(w=N?.y)!=null?w:0,U=(x.minX+x.maxX)/2,H=(x.minY+x.maxY)/2;T.forEach(({id:L,node:k,parent:q})=>{i.setNode(L,k),q!==void 0&&i.setParent(L,q)}),M.forEach(({edge:L,label:k})=>{i.setEdge(L,k)}),b.nodes().forEach(L=>{if(L===y)return;let k=b.node(L),q=i.node(L);q&&k&&typeof k.x=="number"&&typeof k.y=="number"&&(q.x=P+(k.x-U),q.y=I+(k.y-H))}),rx(i,b,P-U,I-H),delete N._dagreClusterSubgraph}),s.forEach(y=>{var b,x;let T=i.node(y),M=r[y];if(T&&T.rankdir&&T._dagreClusterSubgraph&&M){let _=T._dagreClusterSubgraph,w=(b=T.x)!=null?b:0,N=(x=T.y)!=null?x:0,P=(M.minX+M.maxX)/2,I=(M.minY+M.maxY)/2;_.nodes().forEach(U=>{if(U===y)return;let H=_.node(U),L=i.node(U);if(L&&H&&typeof H.x=="number"&&typeof H.y=="number"){let k=H.x-P,q=H.y-I;L.x=w+k,L.y=N+q}}),rx(i,_,w-P,N-I),delete T._dagreClusterSubgraph}})}function rx(i,e,t,n){e.edges().forEach(s=>{if(!i.hasEdge(s))return;let r=e.edge(s),o=i.edge(s);o.points=r.points.map(a=>({x:a.x+t,y:a.y+n})),Object.hasOwn(r,"x")&&(o.x=r.x+t,o.y=r.y+n)})}function ox(i,e,t,n=null){var s,r;let o=t?.useDynamic!==!1,a=o&&(s=n?.graph)!=null?s:null,l=o&&(r=n?.rawNodes)!=null?r:null;e("    makeSpaceForEdgeLabels",()=>H3(i)),e("    removeSelfEdges",()=>j3(i)),e("    acyclic",()=>EP(i,a)),e("    nestingGraph.run",()=>YP(i)),e("    rank",()=>BP(vx(i))),e("    injectEdgeLabelProxies",()=>z3(i)),e("    removeEmptyRanks",()=>lP(i)),e("    nestingGraph.cleanup",()=>ZP(i)),e("    normalizeRanks",()=>aP(i)),e("    assignRankMinMax",()=>V3(i)),e("    removeEdgeLabelProxies",()=>G3(i)),e("    normalize.run",()=>TP(i)),e("    parentDummyChains",()=>GP(i)),e("    addBorderSegments",()=>JP(i)),e("    order",()=>Ix(i,t,l)),e("    insertSelfEdges",()=>Z3(i)),e("    adjustCoordinateSystem",()=>QP(i)),e("    position",()=>I3(i,t.corePath)),e("    positionSelfEdges",()=>J3(i));let c=JSON.parse(JSON.stringify(i._nodes));return e("    removeBorderNodes",()=>$3(i)),e("    normalize.undo",()=>RP(i)),e("    fixupEdgeLabelCoords",()=>q3(i)),e("    undoCoordinateSystem",()=>e3(i)),e("    translateGraph",()=>W3(i)),e("    assignNodeIntersects",()=>X3(i)),e("    reversePoints",()=>Y3(i)),e("    acyclic.undo",()=>MP(i)),{graph:i,rawNodes:c}}function ax(i,e){i.nodes().forEach(t=>{let n=i.node(t),s=e.node(t);n&&(n.x=s.x,n.y=s.y,n.order=s.order,n.rank=s.rank,e.children(t).length&&(n.width=s.width,n.height=s.height))}),i.edges().forEach(t=>{let n=i.edge(t),s=e.edge(t);n.points=s.points,Object.hasOwn(s,"x")&&(n.x=s.x,n.y=s.y)}),i.graph().width=e.graph().width,i.graph().height=e.graph().height}var N3=["nodesep","edgesep","ranksep","marginx","marginy"],D3={ranksep:50,edgesep:20,nodesep:50,rankdir:"TB",rankalign:"center"},F3=["acyclicer","ranker","rankdir","align","rankalign"],O3=["width","height","rank"],lx={width:0,height:0},U3=["minlen","weight","width","height","labeloffset"],k3={minlen:1,weight:1,width:0,height:0,labeloffset:10,labelpos:"r"},B3=["labelpos"];function cx(i){let e=new Vi({multigraph:!0,compound:!0}),t=fm(i.graph());return e.setGraph(Object.assign({},D3,dm(t,N3),hd(t,F3))),i.nodes().forEach(n=>{let s=fm(i.node(n)),r=dm(s,O3);Object.keys(lx).forEach(a=>{r[a]===void 0&&(r[a]=lx[a])}),e.setNode(n,r);let o=i.parent(n);o!==void 0&&e.setParent(n,o)}),i.edges().forEach(n=>{let s=fm(i.edge(n));e.setEdge(n,Object.assign({},k3,dm(s,U3),hd(s,B3)))}),e}function H3(i){let e=i.graph();e.ranksep/=2,i.edges().forEach(t=>{var n;let s=i.edge(t);s.minlen*=2,((n=s.labelpos)!=null?n:"r").toLowerCase()!=="c"&&(e.rankdir==="TB"||e.rankdir==="BT"?s.width+=s.labeloffset:s.height+=s.labeloffset)})}function z3(i){i.edges().forEach(e=>{let t=i.edge(e);if(t.width&&t.height){let n=i.node(e.v),s={rank:(i.node(e.w).rank-n.rank)/2+n.rank,e};Qo(i,"edge-proxy",s,"_ep")}})}function V3(i){let e=0;i.nodes().forEach(t=>{let n=i.node(t);n.borderTop&&(n.minRank=i.node(n.borderTop).rank,n.maxRank=i.node(n.borderBottom).rank,e=Math.max(e,n.maxRank))}),i.graph().maxRank=e}function G3(i){i.nodes().forEach(e=>{let t=i.node(e);if(t.dummy==="edge-proxy"){let n=t;i.edge(n.e).labelRank=t.rank,i.removeNode(e)}})}function W3(i){let e=Number.POSITIVE_INFINITY,t=0,n=Number.POSITIVE_INFINITY,s=0,r=i.graph(),o=r.marginx||0,a=r.marginy||0;function l(c){let h=c.x,u=c.y,d=c.width,f=c.height;e=Math.min(e,h-d/2),t=Math.max(t,h+d/2),n=Math.min(n,u-f/2),s=Math.max(s,u+f/2)}i.nodes().forEach(c=>l(i.node(c))),i.edges().forEach(c=>{let h=i.edge(c);Object.hasOwn(h,"x")&&l(h)}),e-=o,n-=a,i.nodes().forEach(c=>{let h=i.node(c);h.x-=e,h.y-=n}),i.edges().forEach(c=>{let h=i.edge(c);h.points.forEach(u=>{u.x-=e,u.y-=n}),Object.hasOwn(h,"x")&&(h.x-=e),Object.hasOwn(h,"y")&&(h.y-=n)}),r.width=t-e+o,r.height=s-n+a}function X3(i){i.edges().forEach(e=>{if(e.v===e.w)return;let t=i.edge(e),n=i.node(e.v),s=i.node(e.w),r,o;t.points?(r=t.points[0],o=t.points[t.points.length-1]):(t.points=[],r=s,o=n),t.points.unshift(qv(n,r)),t.points.push(qv(s,o))})}function q3(i){i.edges().forEach(e=>{let t=i.edge(e);if(Object.hasOwn(t,"x"))switch((t.labelpos==="l"||t.labelpos==="r")&&(t.width-=t.labeloffset),t.labelpos){case"l":t.x-=t.width/2+t.labeloffset;break;case"r":t.x+=t.width/2+t.labeloffset;break}})}function Y3(i){i.edges().forEach(e=>{let t=i.edge(e);t.reversed&&t.points.reverse()})}function $3(i){i.nodes().forEach(e=>{if(i.children(e).length){let t=i.node(e),n=i.node(t.borderTop),s=i.node(t.borderBottom),r=i.node(t.borderLeft[t.borderLeft.length-1]),o=i.node(t.borderRight[t.borderRight.length-1]);t.width=Math.abs(o.x-r.x),t.height=Math.abs(s.y-n.y),t.x=r.x+t.width/2,t.y=n.y+t.height/2}}),i.nodes().forEach(e=>{i.node(e).dummy==="border"&&i.removeNode(e)})}function j3(i){i.edges().forEach(e=>{if(e.v===e.w){let t=i.node(e.v);t.selfEdges||(t.selfEdges=[]),t.selfEdges.push({e,label:i.edge(e)}),i.removeEdge(e)}})}function Z3(i){ud(i).forEach(e=>{let t=0;e.forEach((n,s)=>{let r=i.node(n);typeof r.rank!="number"&&(r.rank=0),r.order=s+t,(r.selfEdges||[]).forEach(o=>{Qo(i,"selfedge",{width:o.label.width,height:o.label.height,rank:r.rank,order:s+ ++t,e:o.e,edgeLabel:o.label},"_se"),(!Array.isArray(o.label.points)||o.label.points.length!==7)&&(o.label.points=[{x:0,y:-10},{x:0,y:-10},{x:0,y:0},{x:0,y:10},{x:0,y:10},{x:0,y:0},{x:0,y:0}])}),delete r.selfEdges})})}function J3(i){i.nodes().forEach(e=>{let t=i.node(e),n=s=>typeof s=="number"&&isFinite(s);if(t.dummy==="selfedge"){let s=t,r=i.node(s.e.v),o=n(r?.x)?r.x:0,a=n(r?.y)?r.y:0,l=n(r?.width)?r.width:0,c=n(r?.height)?r.height:0,h=n(t.x)?t.x:o,u=n(t.y)?t.y:a,d=l/2,f=c/2;s.edgeLabel.points=[{x:h+d,y:u-f},{x:h+d,y:u-f},{x:h,y:u},{x:h-d,y:u+f},{x:h-d,y:u+f},{x:h,y:u},{x:h,y:u}],s.edgeLabel.x=h,s.edgeLabel.y=u,i.setEdge(s.e,s.edgeLabel),i.removeNode(e)}else t&&Array.isArray(t.selfEdges)&&t.selfEdges.forEach(s=>{if(!Array.isArray(s.label.points)||s.label.points.length!==7){let r=n(t.x)?t.x:0,o=n(t.y)?t.y:0,a=n(t.width)?t.width:0,l=n(t.height)?t.height:0,c=a/2,h=l/2;s.label.points=[{x:r+c,y:o-h},{x:r+c,y:o-h},{x:r,y:o},{x:r-c,y:o+h},{x:r-c,y:o+h},{x:r,y:o},{x:r,y:o}]}})})}function dm(i,e){return dd(hd(i,e),Number)}function fm(i){let e={};return i&&Object.entries(i).forEach(([t,n])=>{typeof t=="string"&&(t=t.toLowerCase()),e[t]=n}),e}var K3=38,Q3=7.3,bm=24,ws=(i,e,...t)=>{let n=document.createElementNS("http://www.w3.org/2000/svg",i);for(let[s,r]of Object.entries(e))n.setAttribute(s,String(r));return n.append(...t),n};function e2(i){let e=n=>i[Math.min(n,i.length-1)],t=`M${e(0).x.toFixed(1)} ${e(0).y.toFixed(1)}`;for(let n=1;n<i.length-1;n+=1){let[s,r]=[e(n),e(n+1)],o=n===i.length-2?r:{x:(s.x+r.x)/2,y:(s.y+r.y)/2};t+=` Q${s.x.toFixed(1)} ${s.y.toFixed(1)} ${o.x.toFixed(1)} ${o.y.toFixed(1)}`}return t}function t2(i,e){let{x:t,y:n,width:s,height:r}=e,o=i.name.length>bm?`${i.name.slice(0,bm-1)}…`:i.name,a=ws("rect",{x:t-s/2,y:n-r/2,width:s,height:r,rx:i.kind==="joint"?r/2:6}),l=[ws("text",{x:t,y:i.words?n-2:n+4.5},o)];i.words&&l.push(ws("text",{class:"kind",x:t,y:n+12.5},i.words));let c=`${i.name}${i.line?`, line ${i.line}`:""}`;return ws("g",{class:i.kind,...i.line?{tabindex:0,role:"button","aria-label":c}:{}},ws("title",{},c),a,...l)}function Fx(i){let e=new Vi({multigraph:!0});e.setGraph({rankdir:"LR",nodesep:14,ranksep:44,marginx:6,marginy:6}),i.forEach((l,c)=>{if(c===0&&!i.some(u=>u.joins.includes(0)))return;let h=Q3*Math.max(Math.min(l.name.length,bm),.86*l.words.length)+24;e.setNode(String(c),{width:Math.max(h,64),height:K3})}),i.forEach((l,c)=>{let[h,...u]=l.joins;l.kind==="joint"&&h!==void 0&&e.setEdge(String(h),String(c),{kind:"join",weight:4},"join");for(let d of l.kind==="joint"?u:l.joins)e.setEdge(String(c),String(d),{kind:"join",weight:l.kind==="joint"?4:1},"join");for(let d of l.reads)e.setEdge(String(d),String(c),{kind:"signal",weight:1},"signal")}),Nx(e);let{width:t=0,height:n=0}=e.graph(),s=ws("marker",{id:"signal-tip",viewBox:"0 0 7 7",refX:7,refY:3.5,markerWidth:7,markerHeight:7,orient:"auto"},ws("path",{d:"M0 0 7 3.5 0 7z",class:"tip"})),r=e.edges().map(l=>{let{points:c,kind:h}=e.edge(l);return ws("path",{class:h,d:e2(c),"data-from":l.v,"data-to":l.w,...h==="signal"?{"marker-end":"url(#signal-tip)"}:{}})}),o=ws("svg",{class:"block-diagram",viewBox:`0 0 ${t.toFixed(0)} ${n.toFixed(0)}`,width:t.toFixed(0),role:"group","aria-label":"block diagram of the machine"},ws("defs",{},s),...r),a=W("pre",{class:"lines",hidden:!0});for(let l of e.nodes()){let c=i[Number(l)],h=t2(c,e.node(l)),u=f=>r.filter(p=>[p.getAttribute("data-from"),p.getAttribute("data-to")].includes(l)).forEach(p=>p.classList.toggle("marked",f));h.addEventListener("pointerenter",()=>u(!0)),h.addEventListener("pointerleave",()=>u(!1));let d=()=>{for(let f of o.querySelectorAll(".chosen"))f.classList.remove("chosen");h.classList.add("chosen"),a.hidden=!c.line,a.textContent=c.lines.split(`
`).map((f,p)=>`${String(c.line+p).padStart(4)}  ${f}`).join(`
`)};h.addEventListener("click",d),h.addEventListener("keydown",f=>{(f.key==="Enter"||f.key===" ")&&d()}),o.append(h)}return W("div",{class:"blocks"},W("div",{class:"diagram"},o),a)}var n2=60,pd=class{constructor(e,t,n,s,r){this.stage=e;this.columns=t;this.plots=n;this.traces=s;this.actions=r;this.search.addEventListener("input",()=>this.list()),this.element.append(this.head,n.element),t.list().length&&this.element.append(W("section",{class:"all"},W("h3",{},"Variables"),this.search,this.found)),this.select(null)}stage;columns;plots;traces;actions;element=W("div",{class:"inspector"});numbers=[];picked=null;frame=0;head=W("div",{class:"chosen"});found=W("div",{class:"variables"});search=W("input",{type:"search",class:"search",placeholder:"Find a variable","aria-label":"Find a variable"});put(e){this.plots.element.after(e)}select(e){this.picked=e,this.describe(),this.list()}refresh(){this.describe(),this.list()}moveTo(e){this.frame=e;for(let{element:t,values:n,scale:s}of this.numbers)n&&(t.textContent=mn(n[e]??NaN,s))}describe(){let{picked:e}=this;if(!e){this.head.replaceChildren(W("p",{class:"note"},"Choose a part in the picture or the list to see its data."));return}let t=this.stage.bodies.findIndex(p=>p.name===e.name),{bodies:n,joints:s,forces:r,drivers:o,couplings:a}=this.stage,h={body:n,joint:s,force:r,driver:o,coupling:a}[e.kind].find(p=>p.name===e.name)?.facts??[],u=e.kind==="body"&&W("button",{type:"button",class:"chip","aria-pressed":String(this.actions.isFollowed(e)),onclick:()=>this.actions.follow()},Er("target"),"Follow"),f=(this.actions.canPlay?s2(this.stage,e,t):[]).map(p=>W("button",{type:"button",class:"chip","aria-pressed":String(this.traces.has(p.key)),onclick:()=>this.trace(p)},Er("path"),`Trace ${p.label}`));this.head.replaceChildren(W("h2",{},...bs(e.name)),W("dl",{},...h.flatMap(([p,v])=>[W("dt",{},p),W("dd",{},v)])),W("div",{class:"chips"},u,...f))}trace(e){this.traces.toggle(e),this.actions.change(),this.describe()}list(){let e=this.search.value.trim().toLowerCase(),t=this.columns.list(),n=a=>this.picked?a.owner===this.picked.name:a.owner==="",s=e?t.filter(a=>a.name.toLowerCase().includes(e)):t.filter(n);this.numbers.length=0;let r=s.slice(0,n2).map(a=>this.row(a)),o=s.length-r.length;this.found.replaceChildren(W("ul",{},...r),o>0?W("p",{class:"note"},`and ${o} more: write more of the name`):"",r.length?"":W("p",{class:"note"},e?"No variable has this in its name.":"None of its own.")),this.moveTo(this.frame)}row(e){let t=W("output",{}),n={element:t,values:null,scale:0};this.numbers.push(n),this.columns.get(0,e.name).then(r=>{typeof r!="string"&&(n.values=r,n.scale=Gr(r,e.unit),t.textContent=mn(r[this.frame]??NaN,n.scale))});let s=this.picked&&e.owner===this.picked.name?i2(e.name,e.owner):e.name;return W("li",{},W("button",{type:"button","aria-pressed":String(this.plots.has(e.name)),title:`Plot ${e.name}`,"aria-label":`Plot ${e.name}`,onclick:()=>this.plots.toggle(e.name)},Er("plot"),W("span",{class:"name"},...bs(s))),t,W("small",{},e.unit==="1"?"":e.unit))}};function i2(i,e){let t=["","force.","driver.","coupling."].map(n=>`${n}${e}.`).find(n=>i.startsWith(n));return t?i.slice(t.length):i}function s2(i,e,t){if(e.kind==="joint"){let r=i.joints.find(a=>a.name===e.name);if(!r)return[];let o=r.bodies[r.place]>=0?r.place:r.bodies[0]>=0?0:1;return r.bodies[o]<0?[]:[{key:`joint ${r.name}`,label:"its point",body:r.bodies[o],point:r.points[o]}]}let n=i.bodies[t];if(e.kind!=="body"||!n)return[];let s=i.markers.filter(r=>r.body===t).map(r=>({key:`marker ${r.name}`,label:r.name,body:t,point:r.point}));return[{key:`body ${n.name}`,label:"centre of mass",body:t,point:n.centre_of_mass},...s]}var md=class{element=W("div",{class:"legend",role:"group","aria-label":"Colours"});said="";nows=[];show(e){let t=JSON.stringify(e.map(({now:n,...s})=>s));t!==this.said&&(this.nows.length=0,this.element.replaceChildren(...e.map(n=>this.row(n))),this.said=t),e.forEach((n,s)=>{let r=n.now===null?"":r2(n);this.nows[s].textContent!==r&&(this.nows[s].textContent=r)})}row({quantity:e,unit:t,low:n,high:s}){let r=W("div",{class:"ramp"});r.style.background=Vy();let{texts:o,unit:a}=Jo([n,s],t),l=W("span");return this.nows.push(l),W("div",{class:"scale"},W("p",{class:"of"},`${e}${a?` [${a}]`:""}`),r,W("p",{class:"ends"},W("span",{},o[0]),l,W("span",{},o[1])))}};function r2({low:i,high:e,now:t,unit:n}){return`now up to ${Jo([i,e,t],n).texts[2]}`}var Ox=[["space","play and pause"],["← →","one frame; ten with shift"],["home end","to the start, to the end"],["+ −","faster, slower"],["L","repeat"],["0 to 6","first view, front, right, top, back, left, below"],["F","follow the chosen body; fit everything where none is chosen"],["alt + arrows","turn the view; with page up and down, zoom"],["N","names"],["S, D","structure, display"],["P","data and plots"],["esc","close, choose nothing"],["?","this list"]],o2=[["space","run and pause"],["R","back to the start"],...Ox.filter(([i])=>!/^(space|← →|home end|\+ −|L)$/.test(i))];function Ux(i){let e=new Set(i?.flatMap(([s])=>s.split(" "))),t=i?o2.filter(([s])=>!s.split(/,? /).some(r=>e.has(r))):Ox,n=W("dialog",{class:"help","aria-label":"Keys and mouse"},W("header",{},W("h2",{},"Keys and mouse"),Mn("close","Close",()=>n.close())),W("dl",{},...[...i??[],...t].flatMap(([s,r])=>[W("dt",{},s),W("dd",{},r)])),W("p",{class:"note"},"Drag to turn, right button or two fingers to move, wheel or pinch to zoom, click a part to choose it, click a plot to go to its time. Of a live machine, shift and drag pulls a body."));return n}function a2(i,e){return i instanceof HTMLElement?i instanceof HTMLInputElement&&(i.type==="search"||i.type==="text")?e!=="Escape":i instanceof HTMLInputElement&&i.type==="range"?!i.classList.contains("scrub")&&/Arrow|Home|End|Page/.test(e):i instanceof HTMLSelectElement?e!=="Escape":i instanceof HTMLButtonElement||i instanceof HTMLInputElement||i.tagName==="SUMMARY"?e===" "||e==="Enter":!1:!1}function kx(i){addEventListener("keydown",e=>{e.ctrlKey||e.metaKey||a2(e.target,e.key)||l2(i,e)&&e.preventDefault()})}function l2(i,e){let{key:t}=e,n=e.shiftKey?10:1;if(e.altKey)return c2(i,t);let s=Mv[Number(t)];if(/^[0-6]$/.test(t)&&s)return Sn(i.look(s));if(t==="?")return Sn(i.help());if(t==="Escape")return Sn(i.escape());if(/^f$/i.test(t))return Sn(i.followOrFit());if(/^n$/i.test(t))return Sn(i.toggleNames());if(/^s$/i.test(t))return Sn(i.togglePanel("structure"));if(/^d$/i.test(t))return Sn(i.togglePanel("display"));if(/^p$/i.test(t))return Sn(i.togglePanel("data"));if(/^r$/i.test(t))return Sn(i.reset());let{player:r,live:o}=i;return o&&t===" "?Sn(o.toggle()):r?t===" "?Sn(r.toggle()):t==="ArrowLeft"?Sn(r.step(-n)):t==="ArrowRight"?Sn(r.step(n)):t==="Home"||t==="End"?(r.toggle(!1),Sn(r.seek(t==="Home"?r.motion.start:r.motion.end))):t==="+"||t==="="?Sn(r.faster(1)):t==="-"||t==="−"?Sn(r.faster(-1)):/^l$/i.test(t)?(r.loop=!r.loop,Sn(r.onChange())):!1:!1}function c2(i,e){let t=Math.PI/24,s={ArrowLeft:[-t,0],ArrowRight:[t,0],ArrowUp:[0,t],ArrowDown:[0,-t]}[e];return s?Sn(i.world.orbit(...s)):e==="PageUp"?Sn(i.world.zoom(.87)):e==="PageDown"?Sn(i.world.zoom(1.15)):!1}function Sn(i){return!0}var gd=class{constructor(e,t,n){this.controls=e;this.send=t;this.take=n;this.values=e.map(s=>s.rest),this.hand=e.map(()=>null),this.keys=new Set(e.flatMap(s=>[s.raises,s.lowers]).filter(Boolean)),addEventListener("keydown",s=>this.press(s),!0),addEventListener("keyup",s=>this.held.delete(Bx(s.key))&&this.refresh(),!0),addEventListener("blur",()=>this.letGo()),document.addEventListener("visibilitychange",()=>document.hidden&&this.letGo()),setInterval(()=>this.refresh(),20)}controls;send;take;values;driving=!1;onValues=()=>{};held=new Set;hand;sticks=new Map;keys;last=performance.now();asked=-1e3;move(e,t){this.begin(),!(t===null&&this.controls[e].hold)&&(this.hand[e]=t)}deflect(e,t){t&&this.begin(),this.sticks.set(e,t)}follow(e){this.controls.forEach((t,n)=>{t.hold&&(this.hand[n]=this.values[n]=e[n]??t.rest)})}rest(){this.letGo(),this.controls.forEach((e,t)=>{this.hand[t]=null,this.values[t]=e.rest})}letGo(){this.held.clear(),this.sticks.clear(),this.controls.forEach((e,t)=>e.hold||(this.hand[t]=null))}begin(){this.driving||this.take()}askWithPad(){let e=performance.now();e-this.asked<1e3||(this.asked=e,this.take())}press(e){let t=Bx(e.key);e.ctrlKey||e.metaKey||e.altKey||!this.keys.has(t)||u2(e.target)||(e.preventDefault(),e.stopImmediatePropagation(),!this.held.has(t)&&(this.begin(),this.held.add(t),this.refresh()))}refresh(){let e=performance.now(),t=Math.min(e-this.last,100)/1e3;this.last=e;let n=[...navigator.getGamepads?.()??[]].find(s=>s?.connected)??null;this.controls.forEach((s,r)=>this.values[r]=this.wanted(s,r,n,t)),this.driving&&this.send(this.values),this.onValues()}wanted(e,t,n,s){let{low:r,high:o,rest:a,hold:l}=e,c=Number(this.held.has(e.raises))-Number(this.held.has(e.lowers)),h=c||this.sticks.get(e.stick)||h2(e,n);if(!c&&h&&n&&!this.driving&&this.askWithPad(),l){let u=this.hand[t]??this.values[t],d=Math.min(Math.max(u+h*s*(o-r)/1.5,r),o);return this.hand[t]=d,d}return h?h>0?a+h*(o-a):a+h*(a-r):this.hand[t]??a}};function h2(i,e){if(!e)return 0;let t=i.axis>=0?e.axes[i.axis]??0:i.button>=0?e.buttons[i.button]?.value??0:0,n=(Math.abs(t)-i.dead_zone)/(1-i.dead_zone),s=n>0?Math.min(n,1)**i.exponent:0;return(i.reverse?-1:1)*Math.sign(t)*s}function Bx(i){return i.length===1?i.toLowerCase():i}function u2(i){return i instanceof HTMLInputElement&&(i.type==="search"||i.type==="text")}var yd=38,vd=class{constructor(e,t,n){this.moved=n;let s=W("div",{class:"stick",role:"application","aria-label":t.join(", ")},this.knob);this.element=W("figure",{},s,W("figcaption",{},...t.map(a=>W("span",{},a))));let r=(a,l)=>{this.knob.style.transform=`translate(${a*yd}px, ${-l*yd}px)`,this.moved(`${e}-x`,a),this.moved(`${e}-y`,l)},o=a=>{let l=s.getBoundingClientRect(),c=h=>Math.min(Math.max(h,-1),1);r(c((a.clientX-l.left-l.width/2)/yd),c((l.top+l.height/2-a.clientY)/yd))};s.addEventListener("pointerdown",a=>{s.setPointerCapture(a.pointerId),o(a)}),s.addEventListener("pointermove",a=>a.buttons&&o(a));for(let a of["pointerup","pointercancel","lostpointercapture"])s.addEventListener(a,()=>r(0,0))}moved;element;knob=W("i",{})};var Hx=15,zx=1e-6,d2=284,f2=40,Vx=4,xd=class{constructor(e){this.gauge=e;let t=p2(e);this.element=W("li",{class:"strip",title:e.name},W("span",{class:"name"},e.label),this.output,this.canvas,t?W("small",{class:"scale"},t):null)}gauge;element;times=[];numbers=[];value=NaN;output=W("output",{});canvas=W("canvas",{width:2*d2,height:2*f2,"aria-hidden":"true"});show(e){this.value=e}add(e,t){let n=this.times.at(-1);for(n!==void 0&&e<n&&(this.times.length=this.numbers.length=0),this.times.push(e),this.numbers.push(Math.abs(t)<.001*zx?0:t);this.times[0]<e-Hx;)this.times.shift(),this.numbers.shift()}draw(){let{low:e,high:t,limit:n}=this.gauge,s=Math.max(...this.numbers.map(Math.abs),Math.abs(e??0),Math.abs(t??0),.001),{texts:r,unit:o}=wm(this.gauge,[this.value],s);this.output.textContent=Em(r[0],o),this.element.classList.toggle("beyond",n!==null&&Math.abs(this.value)>n);let a=this.canvas.getContext("2d"),l=this.times.at(-1);if(!a||l===void 0)return;let{width:c,height:h}=this.canvas,u=Math.min(...this.numbers,e??1/0),d=Math.max(...this.numbers,t??-1/0),f=Math.max(d-u,zx*Math.max(Math.abs(u),Math.abs(d),1)),p=g=>h-Vx-(g-u)/f*(h-2*Vx),v=getComputedStyle(this.element);if(a.clearRect(0,0,c,h),n!==null){a.strokeStyle=v.getPropertyValue("--limit"),a.lineWidth=2,a.setLineDash([8,6]);for(let g of[n,-n].filter(m=>m<=d&&m>=u))a.beginPath(),a.moveTo(0,p(g)),a.lineTo(c,p(g)),a.stroke();a.setLineDash([])}a.strokeStyle=v.getPropertyValue("--accent"),a.lineWidth=2.5,a.beginPath(),this.numbers.forEach((g,m)=>{let y=c*(1-(l-this.times[m])/Hx);m?a.lineTo(y,p(g)):a.moveTo(y,p(g))}),a.stroke()}};function p2(i){let{low:e,high:t,limit:n}=i,s=[];if(e!==null&&t!==null){let{texts:r,unit:o}=wm(i,[e,t]);s.push(Em(r.join(" … "),o))}if(n!==null){let{texts:r,unit:o}=wm(i,[n]);s.push(`limit ${Em(r[0],o)}`)}return s.join(", ")}function Em(i,e){return e==="°"?`${i}°`:`${i} ${e}`.trim()}function wm({unit:i},e,t){if(i!=="rad"&&i!=="deg")return Jo(e,i,t);let n=s=>i==="deg"?s:s*180/Math.PI;return{...Jo(e.map(n),"deg",t&&n(t)),unit:"°"}}var m2=[.05,.1,.25,.5,1],g2={you:"You operate",other:"Somebody operates",program:"A program operates",nobody:"Take the controls"},Mm=3,y2=100,_d=class{constructor(e,t,n,s,r){this.controls=e;this.gauges=t;this.send=n;this.alone=s;this.operator=new gd(e,f=>n({type:"drive",values:f}),()=>this.take(!0)),this.run=Mn("play","Run",()=>this.toggle(),"space"),this.run.classList.add("main-button"),this.seat=W("button",{type:"button",class:"chip seat",onclick:()=>this.take(this.status?.driver!=="you")},"Take the controls"),this.speed=W("select",{"aria-label":"Speed",title:"Simulated over real time"},...m2.map(f=>W("option",{value:f,selected:f===1},`${f}×`))),this.speed.addEventListener("change",()=>this.say("speed",Number(this.speed.value)));let o=W("button",{type:"button",class:"chip",title:"Drag a body with the mouse; shift does it too","aria-pressed":"false"},"Pick up");o.addEventListener("click",()=>{let f=o.getAttribute("aria-pressed")!=="true";o.setAttribute("aria-pressed",String(f)),this.onHand(f)});let a=Mn("forward","One tick",()=>this.say("step")),l=Mn("reset","Back to the start",()=>this.say("reset")),c=W("button",{type:"button",class:"chip",onclick:()=>this.say("save")},"Save state"),h=W("button",{type:"button",class:"chip",onclick:()=>this.say("restore")},"Restore"),u=W("button",{type:"button",class:"chip",title:"Save all frames of this motion as a table (CSV)",onclick:()=>n({type:"command",word:"table",number:0})},"Save table");this.commands=[this.run,a,l,o,c,h,this.speed,this.seat],this.bar=W("footer",{class:"timeline live-bar",role:"group","aria-label":"Live"},W("div",{class:"transport"},this.run,a,l),W("div",{class:"clock"},this.clock),W("span",{class:"of load"},this.light,this.load),W("div",{class:"pace"},o,c,h,s?u:null,this.speed,this.seat)),this.hint=W("p",{class:"note"},_2(e)),this.rows=e.map((f,p)=>this.row(f,p)),this.strips=t.map(f=>new xd(f));let d=["left","right"].filter(f=>e.some(p=>p.stick.startsWith(f)));this.panel=W("div",{class:"live"},this.problem,this.reasons,e.length?W("h3",{},"Controls"):null,e.length?this.hint:null,d.length?W("div",{class:"sticks"},...d.map(f=>new vd(f,b2(f,e),(p,v)=>this.operator.deflect(p,v)).element)):null,W("ul",{class:"controls"},...this.rows.map(f=>f.output.closest("li"))),r.length?W("h3",{},"Parameters"):null,r.length?W("p",{class:"note"},"With another value the machine goes back to its start."):null,W("ul",{class:"controls"},...r.map((f,p)=>this.parameter(f,p))),t.length?W("h3",{},"Gauges"):null,W("ul",{class:"strips"},...this.strips.map(f=>f.element)))}controls;gauges;send;alone;bar;panel;operator;status=null;onHand=()=>{};strips;rows;run;seat;speed;clock=W("output",{class:"time","aria-live":"off"});load=W("span",{});light=W("span",{class:"light",role:"img"});reasons=W("ul",{class:"reasons"});problem=W("p",{class:"problem",role:"status"});hint;commands;chosen=[];drawn=0;resumes=!1;toggle(){this.say(this.status?.mode==="running"?"pause":"run")}take(e){this.send({type:"take",on:e?1:0}),e||this.operator.rest(),this.operator.driving=e&&this.status?.driver!=="other"}say(e,t=0){this.status?.watches||(!this.operator.driving&&this.status?.driver!=="program"&&this.take(!0),this.send({type:"command",word:e,number:t}))}lose(){this.resumes||=this.operator.driving,this.operator.driving=!1}get keys(){return this.controls.filter(e=>e.lowers||e.raises).map(e=>[[e.lowers,e.raises].filter(Boolean).map(Wx).join(" "),e.description?`${e.label}: ${e.description}`:e.label])}update(e){this.status=e,this.operator.driving=e.driver==="you",this.resumes&&e.driver==="nobody"&&this.take(!0),this.resumes=!1;let t=e.mode==="running";id(this.run,t?"pause":"play",t?"Pause":"Run","space"),this.seat.textContent=g2[e.driver],this.seat.setAttribute("aria-pressed",String(e.driver==="you")),this.clock.textContent=`${e.time.toFixed(2)} s`;let n=100*e.computing/e.tick;this.load.textContent=`${t?"":`${e.mode} · `}${mn(+e.computing.toPrecision(2))} µs a tick, ${n.toPrecision(2)} %${e.overruns?`, ${e.overruns} late`:""}`,this.load.title=`99 % of the ticks are computed in at most this time, and begin at most ${mn(+e.late.toPrecision(2))} µs after their deadlines. ${e.overruns} ended after the next deadline, ${e.own} of them by their own computing.`,this.problem.textContent=e.text,this.judge(e),this.allow(e),document.activeElement!==this.speed&&(this.speed.value=String(e.speed)),this.hint.hidden=e.driver==="you"||e.driver==="program"}judge(e){this.light.dataset.verdict=e.light;let t=`Energy, joints, circuits and computing time are ${e.light} so far.`;this.light.title=[t,`Not verified: the errors of the steps are not examined${this.alone?"":"; nivel replay estimates them"}.`,...e.reasons].join(`
`),this.light.setAttribute("aria-label",`trust: ${e.light}, not verified`);let n=e.text?e.reasons.filter(s=>!s.includes(e.text)):e.reasons;this.reasons.dataset.shown!==n.join(`
`)&&(this.reasons.dataset.shown=n.join(`
`),this.reasons.dataset.verdict=e.light,this.reasons.replaceChildren(...n.map(s=>W("li",{},s))))}allow(e){for(let t of this.commands)t.disabled=!!e.watches||t===this.seat&&e.driver==="program";for(let{slider:t}of this.rows)t&&(t.disabled=e.driver==="program");this.bar.title=e.watches,e.watches&&!e.text&&(this.problem.textContent=`${e.watches[0].toUpperCase()}${e.watches.slice(1)}.`),this.problem.classList.toggle("watching",!!e.watches&&!e.text)}sample({width:e,values:t}){for(let n=0;n<t.length;n+=e)this.strips.forEach((s,r)=>s.add(t[n],t[n+1+r]))}show(e,t){this.clock.textContent=`${e.toFixed(2)} s`,this.strips.forEach((s,r)=>s.show(t[r]??NaN)),this.operator.driving||this.operator.follow(t.subarray(this.gauges.length));let n=performance.now();if(!(n-this.drawn<y2)){this.drawn=n;for(let s of this.strips)s.draw();this.rows.forEach((s,r)=>{let o=t[this.gauges.length+r]??NaN;s.output.textContent=Gx(s.control,o),s.slider&&document.activeElement!==s.slider&&(s.slider.value=String(this.operator.driving?this.operator.values[r]:o))})}}parameter(e,t){let{name:n,unit:s,value:r,least:o}=e,[a,l]=v2(e),c=W("input",{type:"range",min:a,max:l,step:"any",value:r,"aria-label":n}),h=W("input",{type:"number",step:"any",value:r,"aria-label":`${n}, as a number`}),u=d=>{let f=d>=o?d:this.chosen[t];[c.value,h.value]=[String(f),String(+f.toPrecision(6))],f!==this.chosen[t]&&this.send({type:"adjust",parameter:t,value:f}),this.chosen[t]=f};return this.chosen[t]=r,c.addEventListener("input",()=>h.value=String(+Number(c.value).toPrecision(6))),c.addEventListener("change",()=>u(Number(c.value))),h.addEventListener("change",()=>u(h.value?Number(h.value):r)),W("li",{class:"parameter"},W("span",{class:"name"},n),W("span",{},h,` ${s}`),c)}row(e,t){let n=W("output",{},Gx(e,e.rest)),s=[e.lowers,e.raises].filter(Boolean).map(l=>W("kbd",{},Wx(l))),r=e.description?W("small",{},e.description):null,o=W("span",{class:"name"},e.label,...s,r);if(e.look==="button"){let l=W("button",{type:"button",class:"chip"},"Press"),c=()=>this.operator.move(t,e.high),h=()=>this.operator.driving&&this.operator.move(t,null);l.addEventListener("pointerdown",c),l.addEventListener("keydown",u=>(u.key===" "||u.key==="Enter")&&c());for(let u of["pointerup","pointerleave","pointercancel","keyup","blur"])l.addEventListener(u,h);return W("li",{},o,n,l),{control:e,slider:null,output:n}}let a=W("input",{type:"range",min:e.low,max:e.high,step:"any",value:e.rest,"aria-label":e.label});return a.addEventListener("input",()=>this.operator.move(t,Number(a.value))),a.addEventListener("change",()=>{this.operator.move(t,null),e.hold||(a.value=String(e.rest),a.blur())}),W("li",{},W("label",{},o,n,a)),{control:e,slider:a,output:n}}};function v2({value:i,least:e}){if(i<0)return[Mm*i,0];let t=i?0:-1;return[e>0?i/Mm**2:Math.max(t,e),i?Mm*i:1]}function Gx({unit:i,low:e,high:t},n){let s=Math.max(Math.abs(e),Math.abs(t));return!i&&s===1?`${mn(Math.round(100*n))} %`:`${mn(+n.toPrecision(3),s)} ${i}`.trim()}var x2={ArrowLeft:"←",ArrowRight:"→",ArrowUp:"↑",ArrowDown:"↓"," ":"space"};function Wx(i){return x2[i]??i.toUpperCase()}function _2(i){let e=[...i.some(n=>n.raises||n.lowers)?["hold a key"]:[],"move a slider",...i.some(n=>n.stick)?["a stick"]:[],...i.some(n=>n.axis>=0||n.button>=0)?["a gamepad"]:[]];return`To operate the machine, ${e.length>1?`${e.slice(0,-1).join(", ")} or ${e.at(-1)}`:e[0]}.`}function b2(i,e){return e.filter(t=>t.stick.startsWith(i)).map(t=>`${t.stick.endsWith("x")?"↔":"↕"} ${t.label}`)}var ql={structure:"Structure",data:"Data and plots",display:"Display"},E2={structure:"tree",data:"plot",display:"eye"},Xx={structure:"S",data:"P",display:"D"},bd=760,w2=60,M2=1080,Ed=class{constructor(e,t,n,s,r,o,a){this.world=n;this.timeline=r;let l=Object.keys(ql);this.buttons=Object.fromEntries(l.map(d=>[d,Mn(E2[d],ql[d],()=>this.toggle(d),Xx[d])])),this.panels=Object.fromEntries(l.map(d=>[d,this.panel(d,s[d])]));let c=t.map(d=>W("li",{class:"ghost"},W("i",{}),S2(d,e))),h=e.notes.length+c.length?W("ul",{class:"notes"},...e.notes.map(d=>W("li",{},d)),...c):null;this.bar=W("header",{class:"top"},this.buttons.structure,W("div",{class:"title"},W("h1",{},e.name),h,o),W("nav",{"aria-label":"Panels"},Mn("fit","Fit to the present position",()=>n.fitNow(),"F"),this.buttons.display,this.buttons.data,Mn("help","Keys and mouse",a,"?"))),this.elements=[this.bar,...l.map(d=>this.panels[d]),...r?[r]:[]],document.body.classList.toggle("has-timeline",!!r);let u=new ResizeObserver(()=>this.arrange());u.observe(this.bar),r&&u.observe(r),addEventListener("resize",()=>{this.makeRoom(),this.arrange()})}world;timeline;elements;panels;buttons;bar;latest="data";settle(e,t=!0){e&&this.rename("data","Joints and data"),innerWidth>=M2&&innerHeight>480?(this.set("structure",t),this.set("data",!0)):e&&this.set("data",!0),this.arrange(),this.world.view("first",!1)}toggle(e){let t=this.panels[e].hidden===!0;t&&(this.latest=e),t&&innerWidth<bd&&this.close(),t&&e==="data"&&this.set("display",!1),t&&e==="display"&&this.set("data",!1),this.set(e,t),this.arrange()}offer(e){innerWidth<bd||!this.panels[e].hidden||!this.panels.display.hidden||this.toggle(e)}closeTop(){for(let e of["display","data","structure"])if(!this.panels[e].hidden){this.toggle(e);return}}close(){for(let e of Object.keys(this.panels))this.set(e,!1)}makeRoom(){let e=this.open();if(innerWidth>=bd||e.length<2)return;let t=e.includes(this.latest)?this.latest:e[0];for(let n of e)n!==t&&this.set(n,!1)}open(){return Object.keys(this.panels).filter(e=>!this.panels[e].hidden)}rename(e,t){this.panels[e].setAttribute("aria-label",t),this.panels[e].querySelector("h2").textContent=t,this.buttons[e].setAttribute("aria-label",t),this.buttons[e].title=`${t} (${Xx[e]})`}set(e,t){this.panels[e].hidden=!t,this.buttons[e].setAttribute("aria-pressed",String(t))}arrange(){this.panels.structure.style.setProperty("--top",`${Math.max(w2,this.bar.offsetHeight)}px`),document.body.style.setProperty("--foot",`${this.timeline?.offsetHeight??0}px`);let e={left:0,top:this.bar.offsetHeight,right:0,bottom:this.timeline?.offsetHeight?innerHeight-this.timeline.getBoundingClientRect().top:0};for(let t of this.open()){let n=this.panels[t].getBoundingClientRect();innerWidth<bd?e.bottom+=n.height:t==="structure"?e.left=n.right:e.right=innerWidth-n.left}this.world.keepFree(e)}panel(e,t){return W("aside",{class:`panel ${e==="structure"?"left":"right"} ${e}`,hidden:!0,"aria-label":ql[e]},W("div",{class:"panel-head"},W("h2",{},ql[e]),Mn("close",`Close ${ql[e].toLowerCase()}`,()=>this.toggle(e))),W("div",{class:"panel-body"},t))}};function S2(i,e){let t=s=>s.bodies.map(r=>r.name).join(`
`),n=i.name===e.name&&t(i)===t(e);return`Ghost: ${i.title}${n?"":i.title===i.name?", another machine":`, another machine: ${i.name}`}`}var T2="uplot",A2="u-hz",R2="u-vt",C2="u-title",P2="u-wrap",I2="u-under",L2="u-over",N2="u-axis",$r="u-off",D2="u-select",F2="u-cursor-x",O2="u-cursor-y",U2="u-cursor-pt",k2="u-legend",B2="u-live",H2="u-inline",z2="u-series",V2="u-marker",qx="u-label",G2="u-value",$l="width",jl="height";var Yx="bottom",ea="left",Sm="right",Vm="#000",$x=Vm+"0",Tm="mousemove",jx="mousedown",Am="mouseup",Zx="mouseenter",Jx="mouseleave",Kx="dblclick",W2="resize",X2="scroll",Qx="change",Ad="dppxchange",Gm="--",aa=typeof window<"u",Lm=aa?document:null,na=aa?window:null,q2=aa?navigator:null,Ht,wd;function Nm(){let i=devicePixelRatio;Ht!=i&&(Ht=i,wd&&Fm(Qx,wd,Nm),wd=matchMedia(`(min-resolution: ${Ht-.001}dppx) and (max-resolution: ${Ht+.001}dppx)`),jr(Qx,wd,Nm),na.dispatchEvent(new CustomEvent(Ad)))}function Ii(i,e){if(e!=null){let t=i.classList;!t.contains(e)&&t.add(e)}}function Dm(i,e){let t=i.classList;t.contains(e)&&t.remove(e)}function sn(i,e,t){i.style[e]=t+"px"}function ts(i,e,t,n){let s=Lm.createElement(i);return e!=null&&Ii(s,e),t?.insertBefore(s,n),s}function Gi(i,e){return ts("div",i,e)}var e_=new WeakMap;function Ms(i,e,t,n,s){let r="translate("+e+"px,"+t+"px)",o=e_.get(i);r!=o&&(i.style.transform=r,e_.set(i,r),e<0||t<0||e>n||t>s?Ii(i,$r):Dm(i,$r))}var t_=new WeakMap;function n_(i,e,t){let n=e+t,s=t_.get(i);n!=s&&(t_.set(i,n),i.style.background=e,i.style.borderColor=t)}var i_=new WeakMap;function s_(i,e,t,n){let s=e+""+t,r=i_.get(i);s!=r&&(i_.set(i,s),i.style.height=t+"px",i.style.width=e+"px",i.style.marginLeft=n?-e/2+"px":0,i.style.marginTop=n?-t/2+"px":0)}var Wm={passive:!0},Y2={...Wm,capture:!0};function jr(i,e,t,n){e.addEventListener(i,t,n?Y2:Wm)}function Fm(i,e,t,n){e.removeEventListener(i,t,Wm)}aa&&Nm();function ns(i,e,t,n){let s;t=t||0,n=n||e.length-1;let r=n<=2147483647;for(;n-t>1;)s=r?t+n>>1:Li((t+n)/2),e[s]<i?t=s:n=s;return i-e[t]<=e[n]-i?t:n}function L_(i){return(t,n,s)=>{let r=-1,o=-1;for(let a=n;a<=s;a++)if(i(t[a])){r=a;break}for(let a=s;a>=n;a--)if(i(t[a])){o=a;break}return[r,o]}}var N_=i=>i!=null,D_=i=>i!=null&&i>0,Pd=L_(N_),$2=L_(D_);function j2(i,e,t,n=0,s=!1){let r=s?$2:Pd,o=s?D_:N_;[e,t]=r(i,e,t);let a=i[e],l=i[e];if(e>-1)if(n==1)a=i[e],l=i[t];else if(n==-1)a=i[t],l=i[e];else for(let c=e;c<=t;c++){let h=i[c];o(h)&&(h<a?a=h:h>l&&(l=h))}return[a??jt,l??-jt]}function Id(i,e,t,n){let s=a_(i),r=a_(e);i==e&&(s==-1?(i*=t,e/=t):(i/=t,e*=t));let o=t==10?js:F_,a=s==1?Li:Wi,l=r==1?Wi:Li,c=a(o(Nn(i))),h=l(o(Nn(e))),u=ia(t,c),d=ia(t,h);return t==10&&(c<0&&(u=Zt(u,-c)),h<0&&(d=Zt(d,-h))),n||t==2?(i=u*s,e=d*r):(i=B_(i,u),e=Ld(e,d)),[i,e]}function Xm(i,e,t,n){let s=Id(i,e,t,n);return i==0&&(s[0]=0),e==0&&(s[1]=0),s}var qm=.1,r_={mode:3,pad:qm},Jl={pad:0,soft:null,mode:0},Z2={min:Jl,max:Jl};function Rd(i,e,t,n){return Nd(t)?o_(i,e,t):(Jl.pad=t,Jl.soft=n?0:null,Jl.mode=n?3:0,o_(i,e,Z2))}function Ft(i,e){return i??e}function J2(i,e,t){for(e=Ft(e,0),t=Ft(t,i.length-1);e<=t;){if(i[e]!=null)return!0;e++}return!1}function o_(i,e,t){let n=t.min,s=t.max,r=Ft(n.pad,0),o=Ft(s.pad,0),a=Ft(n.hard,-jt),l=Ft(s.hard,jt),c=Ft(n.soft,jt),h=Ft(s.soft,-jt),u=Ft(n.mode,0),d=Ft(s.mode,0),f=e-i,p=js(f),v=di(Nn(i),Nn(e)),g=js(v),m=Nn(g-p);(f<1e-24||m>10)&&(f=0,(i==0||e==0)&&(f=1e-24,u==2&&c!=jt&&(r=0),d==2&&h!=-jt&&(o=0)));let y=f||v||1e3,b=js(y),x=ia(10,Li(b)),T=y*(f==0?i==0?.1:1:r),M=Zt(B_(i-T,x/10),24),_=i>=c&&(u==1||u==3&&M<=c||u==2&&M>=c)?c:jt,w=di(a,M<_&&i>=_?_:is(_,M)),N=y*(f==0?e==0?.1:1:o),P=Zt(Ld(e+N,x/10),24),I=e<=h&&(d==1||d==3&&P>=h||d==2&&P<=h)?h:-jt,U=is(l,P>I&&e<=I?I:di(I,P));return w==U&&w==0&&(U=100),[w,U]}var K2=new Intl.NumberFormat(aa?q2.language:"en-US"),Ym=i=>K2.format(i),Ni=Math,Td=Ni.PI,Nn=Ni.abs,Li=Ni.floor,Ln=Ni.round,Wi=Ni.ceil,is=Ni.min,di=Ni.max,ia=Ni.pow,a_=Ni.sign,js=Ni.log10,F_=Ni.log2,Q2=(i,e=1)=>Ni.sinh(i)*e,Rm=(i,e=1)=>Ni.asinh(i/e),jt=1/0;function l_(i){return(js((i^i>>31)-(i>>31))|0)+1}function Om(i,e,t){return is(di(i,e),t)}function O_(i){return typeof i=="function"}function It(i){return O_(i)?i:()=>i}var eI=()=>{},U_=i=>i,k_=(i,e)=>e,tI=i=>null,c_=i=>!0,h_=(i,e)=>i==e,nI=/\.\d*?(?=9{6,}|0{6,})/gm,Zr=i=>{if(z_(i)||Mr.has(i))return i;let e=`${i}`,t=e.match(nI);if(t==null)return i;let n=t[0].length-1;if(e.indexOf("e-")!=-1){let[s,r]=e.split("e");return+`${Zr(s)}e${r}`}return Zt(i,n)};function qr(i,e){return Zr(Zt(Zr(i/e))*e)}function Ld(i,e){return Zr(Wi(Zr(i/e))*e)}function B_(i,e){return Zr(Li(Zr(i/e))*e)}function Zt(i,e=0){if(z_(i))return i;let t=10**e,n=i*t*(1+Number.EPSILON);return Ln(n)/t}var Mr=new Map;function H_(i){return((""+i).split(".")[1]||"").length}function Ql(i,e,t,n){let s=[],r=n.map(H_);for(let o=e;o<t;o++){let a=Nn(o),l=Zt(ia(i,o),a);for(let c=0;c<n.length;c++){let h=i==10?+`${n[c]}e${o}`:n[c]*l,u=(o>=0?0:a)+(o>=r[c]?0:r[c]),d=i==10?h:Zt(h,u);s.push(d),Mr.set(d,u)}}return s}var Kl={},$m=[],sa=[null,null],wr=Array.isArray,z_=Number.isInteger,iI=i=>i===void 0;function u_(i){return typeof i=="string"}function Nd(i){let e=!1;if(i!=null){let t=i.constructor;e=t==null||t==Object}return e}function sI(i){return i!=null&&typeof i=="object"}var rI=Object.getPrototypeOf(Uint8Array),V_="__proto__";function ra(i,e=Nd){let t;if(wr(i)){let n=i.find(s=>s!=null);if(wr(n)||e(n)){t=Array(i.length);for(let s=0;s<i.length;s++)t[s]=ra(i[s],e)}else t=i.slice()}else if(i instanceof rI)t=i.slice();else if(e(i)){t={};for(let n in i)n!=V_&&(t[n]=ra(i[n],e))}else t=i;return t}function Tn(i){let e=arguments;for(let t=1;t<e.length;t++){let n=e[t];for(let s in n)s!=V_&&(Nd(i[s])?Tn(i[s],ra(n[s])):i[s]=ra(n[s]))}return i}var oI=0,aI=1,lI=2;function cI(i,e,t){for(let n=0,s,r=-1;n<e.length;n++){let o=e[n];if(o>r){for(s=o-1;s>=0&&i[s]==null;)i[s--]=null;for(s=o+1;s<t&&i[s]==null;)i[r=s++]=null}}}function hI(i,e){if(fI(i)){let o=i[0].slice();for(let a=1;a<i.length;a++)o.push(...i[a].slice(1));return pI(o[0])||(o=dI(o)),o}let t=new Set;for(let o=0;o<i.length;o++){let l=i[o][0],c=l.length;for(let h=0;h<c;h++)t.add(l[h])}let n=[Array.from(t).sort((o,a)=>o-a)],s=n[0].length,r=new Map;for(let o=0;o<s;o++)r.set(n[0][o],o);for(let o=0;o<i.length;o++){let a=i[o],l=a[0];for(let c=1;c<a.length;c++){let h=a[c],u=Array(s).fill(void 0),d=e?e[o][c]:aI,f=[];for(let p=0;p<h.length;p++){let v=h[p],g=r.get(l[p]);v===null?d!=oI&&(u[g]=v,d==lI&&f.push(g)):u[g]=v}cI(u,f,s),n.push(u)}}return n}var uI=typeof queueMicrotask>"u"?i=>Promise.resolve().then(i):queueMicrotask;function dI(i){let e=i[0],t=e.length,n=Array(t);for(let r=0;r<n.length;r++)n[r]=r;n.sort((r,o)=>e[r]-e[o]);let s=[];for(let r=0;r<i.length;r++){let o=i[r],a=Array(t);for(let l=0;l<t;l++)a[l]=o[n[l]];s.push(a)}return s}function fI(i){let e=i[0][0],t=e.length;for(let n=1;n<i.length;n++){let s=i[n][0];if(s.length!=t)return!1;if(s!=e){for(let r=0;r<t;r++)if(s[r]!=e[r])return!1}}return!0}function pI(i,e=100){let t=i.length;if(t<=1)return!0;let n=0,s=t-1;for(;n<=s&&i[n]==null;)n++;for(;s>=n&&i[s]==null;)s--;if(s<=n)return!0;let r=di(1,Li((s-n+1)/e));for(let o=i[n],a=n+r;a<=s;a+=r){let l=i[a];if(l!=null){if(l<=o)return!1;o=l}}return!0}var G_=["January","February","March","April","May","June","July","August","September","October","November","December"],W_=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function X_(i){return i.slice(0,3)}var mI=W_.map(X_),gI=G_.map(X_),yI={MMMM:G_,MMM:gI,WWWW:W_,WWW:mI};function Yl(i){return(i<10?"0":"")+i}function vI(i){return(i<10?"00":i<100?"0":"")+i}var xI={YYYY:i=>i.getFullYear(),YY:i=>(i.getFullYear()+"").slice(2),MMMM:(i,e)=>e.MMMM[i.getMonth()],MMM:(i,e)=>e.MMM[i.getMonth()],MM:i=>Yl(i.getMonth()+1),M:i=>i.getMonth()+1,DD:i=>Yl(i.getDate()),D:i=>i.getDate(),WWWW:(i,e)=>e.WWWW[i.getDay()],WWW:(i,e)=>e.WWW[i.getDay()],HH:i=>Yl(i.getHours()),H:i=>i.getHours(),h:i=>{let e=i.getHours();return e==0?12:e>12?e-12:e},AA:i=>i.getHours()>=12?"PM":"AM",aa:i=>i.getHours()>=12?"pm":"am",a:i=>i.getHours()>=12?"p":"a",mm:i=>Yl(i.getMinutes()),m:i=>i.getMinutes(),ss:i=>Yl(i.getSeconds()),s:i=>i.getSeconds(),fff:i=>vI(i.getMilliseconds())};function jm(i,e){e=e||yI;let t=[],n=/\{([a-z]+)\}|[^{]+/gi,s;for(;s=n.exec(i);)t.push(s[0][0]=="{"?xI[s[1]]:s[0]);return r=>{let o="";for(let a=0;a<t.length;a++)o+=typeof t[a]=="string"?t[a]:t[a](r,e);return o}}var _I=new Intl.DateTimeFormat().resolvedOptions().timeZone;function bI(i,e){let t;return e=="UTC"||e=="Etc/UTC"?t=new Date(+i+i.getTimezoneOffset()*6e4):e==_I?t=i:(t=new Date(i.toLocaleString("en-US",{timeZone:e})),t.setMilliseconds(i.getMilliseconds())),t}var q_=i=>i%1==0,Cd=[1,2,2.5,5],EI=Ql(10,-32,0,Cd),Y_=Ql(10,0,32,Cd),wI=Y_.filter(q_),Yr=EI.concat(Y_),Zm=`
`,$_="{YYYY}",d_=Zm+$_,j_="{M}/{D}",Zl=Zm+j_,Md=Zl+"/{YY}",Z_="{aa}",MI="{h}:{mm}",ta=MI+Z_,f_=Zm+ta,p_=":{ss}",Wt=null;function J_(i){let e=i*1e3,t=e*60,n=t*60,s=n*24,r=s*30,o=s*365,l=(i==1?Ql(10,0,3,Cd).filter(q_):Ql(10,-3,0,Cd)).concat([e,e*5,e*10,e*15,e*30,t,t*5,t*10,t*15,t*30,n,n*2,n*3,n*4,n*6,n*8,n*12,s,s*2,s*3,s*4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,o,o*2,o*5,o*10,o*25,o*50,o*100]),c=[[o,$_,Wt,Wt,Wt,Wt,Wt,Wt,1],[s*28,"{MMM}",d_,Wt,Wt,Wt,Wt,Wt,1],[s,j_,d_,Wt,Wt,Wt,Wt,Wt,1],[n,"{h}"+Z_,Md,Wt,Zl,Wt,Wt,Wt,1],[t,ta,Md,Wt,Zl,Wt,Wt,Wt,1],[e,p_,Md+" "+ta,Wt,Zl+" "+ta,Wt,f_,Wt,1],[i,p_+".{fff}",Md+" "+ta,Wt,Zl+" "+ta,Wt,f_,Wt,1]];function h(u){return(d,f,p,v,g,m)=>{let y=[],b=g>=o,x=g>=r&&g<o,T=u(p),M=Zt(T*i,3),_=Cm(T.getFullYear(),b?0:T.getMonth(),x||b?1:T.getDate()),w=Zt(_*i,3);if(x||b){let N=x?g/r:0,P=b?g/o:0,I=M==w?M:Zt(Cm(_.getFullYear()+P,_.getMonth()+N,1)*i,3),U=new Date(Ln(I/i)),H=U.getFullYear(),L=U.getMonth();for(let k=0;I<=v;k++){let q=Cm(H+P*k,L+N*k,1),V=q-u(Zt(q*i,3));I=Zt((+q+V)*i,3),I<=v&&y.push(I)}}else{let N=g>=s?s:g,P=Li(p)-Li(M),I=w+P+Ld(M-w,N);y.push(I);let U=u(I),H=U.getHours()+U.getMinutes()/t+U.getSeconds()/n,L=g/n,k=d.axes[f]._space,q=m/k;for(;I=Zt(I+g,i==1?0:3),!(I>v);)if(L>1){let V=Li(Zt(H+L,6))%24,Q=u(I).getHours()-V;Q>1&&(Q=-1),I-=Q*n,H=(H+L)%24;let te=y[y.length-1];Zt((I-te)/g,3)*q>=.7&&y.push(I)}else y.push(I)}return y}}return[l,c,h]}var[SI,TI,AI]=J_(1),[RI,CI,PI]=J_(.001);Ql(2,-53,53,[1]);function m_(i,e){return i.map(t=>t.map((n,s)=>s==0||s==8||n==null?n:e(s==1||t[8]==0?n:t[1]+n)))}function g_(i,e){return(t,n,s,r,o)=>{let a=e.find(p=>o>=p[0])||e[e.length-1],l,c,h,u,d,f;return n.map(p=>{let v=i(p),g=v.getFullYear(),m=v.getMonth(),y=v.getDate(),b=v.getHours(),x=v.getMinutes(),T=v.getSeconds(),M=g!=l&&a[2]||m!=c&&a[3]||y!=h&&a[4]||b!=u&&a[5]||x!=d&&a[6]||T!=f&&a[7]||a[1];return l=g,c=m,h=y,u=b,d=x,f=T,M(v)})}}function II(i,e){let t=jm(e);return(n,s,r,o,a)=>s.map(l=>t(i(l)))}function Cm(i,e,t){return new Date(i,e,t)}function y_(i,e){return e(i)}var LI="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function v_(i,e){return(t,n,s,r)=>r==null?Gm:e(i(n))}function NI(i,e){let t=i.series[e];return t.width?t.stroke(i,e):t.points.width?t.points.stroke(i,e):null}function DI(i,e){return i.series[e].fill(i,e)}var FI={show:!0,live:!0,isolate:!1,mount:eI,markers:{show:!0,width:2,stroke:NI,fill:DI,dash:"solid"},idx:null,idxs:null,values:[]};function OI(i,e){let t=i.cursor.points,n=Gi(),s=t.size(i,e);sn(n,$l,s),sn(n,jl,s);let r=s/-2;sn(n,"marginLeft",r),sn(n,"marginTop",r);let o=t.width(i,e,s);return o&&sn(n,"borderWidth",o),n}function UI(i,e){let t=i.series[e].points;return t._fill||t._stroke}function kI(i,e){let t=i.series[e].points;return t._stroke||t._fill}function BI(i,e){return i.series[e].points.size}var Pm=[0,0];function HI(i,e,t){return Pm[0]=e,Pm[1]=t,Pm}function Sd(i,e,t,n=!0){return s=>{s.button==0&&(!n||s.target==e)&&t(s)}}function Im(i,e,t,n=!0){return s=>{(!n||s.target==e)&&t(s)}}var zI={show:!0,x:!0,y:!0,lock:!1,move:HI,points:{one:!1,show:OI,size:BI,width:0,stroke:kI,fill:UI},bind:{mousedown:Sd,mouseup:Sd,click:Sd,dblclick:Sd,mousemove:Im,mouseleave:Im,mouseenter:Im},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(i,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(i,e,t,n,s)=>n-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},K_={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},Jm=Tn({},K_,{filter:k_}),Q_=Tn({},Jm,{size:10}),eb=Tn({},K_,{show:!1}),Km='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',tb="bold "+Km,nb=1.5,x_={show:!0,scale:"x",stroke:Vm,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:tb,side:2,grid:Jm,ticks:Q_,border:eb,font:Km,lineGap:nb,rotate:0},VI="Value",GI="Time",__={show:!0,scale:"x",auto:!1,sorted:1,min:jt,max:-jt,idxs:[]};function WI(i,e,t,n,s){return e.map(r=>r==null?"":Ym(r))}function XI(i,e,t,n,s,r,o){let a=[],l=Mr.get(s)||0;t=o?t:Zt(Ld(t,s),l);for(let c=t;c<=n;c=Zt(c+s,l))a.push(Object.is(c,-0)?0:c);return a}function Um(i,e,t,n,s,r,o){let a=[],l=i.scales[i.axes[e].scale].log,c=l==10?js:F_,h=Li(c(t));s=ia(l,h),l==10&&(s=Yr[ns(s,Yr)]);let u=t,d=s*l;l==10&&(d=Yr[ns(d,Yr)]);do a.push(u),u=u+s,l==10&&!Mr.has(u)&&(u=Zt(u,Mr.get(s))),u>=d&&(s=u,d=s*l,l==10&&(d=Yr[ns(d,Yr)]));while(u<=n);return a}function qI(i,e,t,n,s,r,o){let l=i.scales[i.axes[e].scale].asinh,c=n>l?Um(i,e,di(l,t),n,s):[l],h=n>=0&&t<=0?[0]:[];return(t<-l?Um(i,e,di(l,-n),-t,s):[l]).reverse().map(d=>-d).concat(h,c)}var ib=/./,YI=/[12357]/,$I=/[125]/,b_=/1/,km=(i,e,t,n)=>i.map((s,r)=>e==4&&s==0||r%n==0&&t.test(s.toExponential()[s<0?1:0])?s:null);function jI(i,e,t,n,s){let r=i.axes[t],o=r.scale,a=i.scales[o],l=i.valToPos,c=r._space,h=l(10,o),u=l(9,o)-h>=c?ib:l(7,o)-h>=c?YI:l(5,o)-h>=c?$I:b_;if(u==b_){let d=Nn(l(1,o)-h);if(d<c)return km(e.slice().reverse(),a.distr,u,Wi(c/d)).reverse()}return km(e,a.distr,u,1)}function ZI(i,e,t,n,s){let r=i.axes[t],o=r.scale,a=r._space,l=i.valToPos,c=Nn(l(1,o)-l(2,o));return c<a?km(e.slice().reverse(),3,ib,Wi(a/c)).reverse():e}function JI(i,e,t,n){return n==null?Gm:e==null?"":Ym(e)}var E_={show:!0,scale:"y",stroke:Vm,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:tb,side:3,grid:Jm,ticks:Q_,border:eb,font:Km,lineGap:nb,rotate:0};function KI(i,e){let t=3+(i||1)*2;return Zt(t*e,3)}function QI(i,e){let{scale:t,idxs:n}=i.series[0],s=i._data[0],r=i.valToPos(s[n[0]],t,!0),o=i.valToPos(s[n[1]],t,!0),a=Nn(o-r),l=i.series[e],c=a/(l.points.space*Ht);return n[1]-n[0]<=c}var w_={scale:null,auto:!0,sorted:0,min:jt,max:-jt},sb=(i,e,t,n,s)=>s,M_={show:!0,auto:!0,sorted:0,gaps:sb,alpha:1,facets:[Tn({},w_,{scale:"x"}),Tn({},w_,{scale:"y"})]},S_={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:sb,alpha:1,points:{show:QI,filter:null},values:null,min:jt,max:-jt,idxs:[],path:null,clip:null};function eL(i,e,t,n,s){return t/10}var rb={time:!0,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},tL=Tn({},rb,{time:!1,ori:1}),T_={};function ob(i,e){let t=T_[i];return t||(t={key:i,plots:[],sub(n){t.plots.push(n)},unsub(n){t.plots=t.plots.filter(s=>s!=n)},pub(n,s,r,o,a,l,c){for(let h=0;h<t.plots.length;h++)t.plots[h]!=s&&t.plots[h].pub(n,s,r,o,a,l,c)}},i!=null&&(T_[i]=t)),t}var oa=1,Bm=2;function Jr(i,e,t){let n=i.mode,s=i.series[e],r=n==2?i._data[e]:i._data,o=i.scales,a=i.bbox,l=r[0],c=n==2?r[1]:r[e],h=n==2?o[s.facets[0].scale]:o[i.series[0].scale],u=n==2?o[s.facets[1].scale]:o[s.scale],d=a.left,f=a.top,p=a.width,v=a.height,g=i.valToPosH,m=i.valToPosV;return h.ori==0?t(s,l,c,h,u,g,m,d,f,p,v,Fd,la,Ud,lb,hb):t(s,l,c,h,u,m,g,f,d,v,p,Od,ca,tg,cb,ub)}function Qm(i,e){let t=0,n=0,s=Ft(i.bands,$m);for(let r=0;r<s.length;r++){let o=s[r];o.series[0]==e?t=o.dir:o.series[1]==e&&(o.dir==1?n|=1:n|=2)}return[t,n==1?-1:n==2?1:n==3?2:0]}function nL(i,e,t,n,s){let r=i.mode,o=i.series[e],a=r==2?o.facets[1].scale:o.scale,l=i.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function Zs(i,e,t,n,s,r){return Jr(i,e,(o,a,l,c,h,u,d,f,p,v,g)=>{let m=o.pxRound,y=c.dir*(c.ori==0?1:-1),b=c.ori==0?la:ca,x,T;y==1?(x=t,T=n):(x=n,T=t);let M=m(u(a[x],c,v,f)),_=m(d(l[x],h,g,p)),w=m(u(a[T],c,v,f)),N=m(d(r==1?h.max:h.min,h,g,p)),P=new Path2D(s);return b(P,w,N),b(P,M,N),b(P,M,_),P})}function Dd(i,e,t,n,s,r){let o=null;if(i.length>0){o=new Path2D;let a=e==0?Ud:tg,l=t;for(let u=0;u<i.length;u++){let d=i[u];if(d[1]>d[0]){let f=d[0]-l;f>0&&a(o,l,n,f,n+r),l=d[1]}}let c=t+s-l,h=10;c>0&&a(o,l,n-h/2,c,n+r+h)}return o}function iL(i,e,t){let n=i[i.length-1];n&&n[0]==e?n[1]=t:i.push([e,t])}function eg(i,e,t,n,s,r,o){let a=[],l=i.length;for(let c=s==1?t:n;c>=t&&c<=n;c+=s)if(e[c]===null){let u=c,d=c;if(s==1)for(;++c<=n&&e[c]===null;)d=c;else for(;--c>=t&&e[c]===null;)d=c;let f=r(i[u]),p=d==u?f:r(i[d]),v=u-s;f=o<=0&&v>=0&&v<l?r(i[v]):f;let m=d+s;p=o>=0&&m>=0&&m<l?r(i[m]):p,p>=f&&a.push([f,p])}return a}function A_(i){return i==0?U_:i==1?Ln:e=>qr(e,i)}function ab(i){let e=i==0?Fd:Od,t=i==0?(s,r,o,a,l,c)=>{s.arcTo(r,o,a,l,c)}:(s,r,o,a,l,c)=>{s.arcTo(o,r,l,a,c)},n=i==0?(s,r,o,a,l)=>{s.rect(r,o,a,l)}:(s,r,o,a,l)=>{s.rect(o,r,l,a)};return(s,r,o,a,l,c=0,h=0)=>{c==0&&h==0?n(s,r,o,a,l):(c=is(c,a/2,l/2),h=is(h,a/2,l/2),e(s,r+c,o),t(s,r+a,o,r+a,o+l,c),t(s,r+a,o+l,r,o+l,h),t(s,r,o+l,r,o,h),t(s,r,o,r+a,o,c),s.closePath())}}var Fd=(i,e,t)=>{i.moveTo(e,t)},Od=(i,e,t)=>{i.moveTo(t,e)},la=(i,e,t)=>{i.lineTo(e,t)},ca=(i,e,t)=>{i.lineTo(t,e)},Ud=ab(0),tg=ab(1),lb=(i,e,t,n,s,r)=>{i.arc(e,t,n,s,r)},cb=(i,e,t,n,s,r)=>{i.arc(t,e,n,s,r)},hb=(i,e,t,n,s,r,o)=>{i.bezierCurveTo(e,t,n,s,r,o)},ub=(i,e,t,n,s,r,o)=>{i.bezierCurveTo(t,e,s,n,o,r)};function db(i){return(e,t,n,s,r)=>Jr(e,t,(o,a,l,c,h,u,d,f,p,v,g)=>{let{pxRound:m,points:y}=o,b,x;c.ori==0?(b=Fd,x=lb):(b=Od,x=cb);let T=Zt(y.width*Ht,3),M=(y.size-y.width)/2*Ht,_=Zt(M*2,3),w=new Path2D,N=new Path2D,{left:P,top:I,width:U,height:H}=e.bbox;Ud(N,P-_,I-_,U+_*2,H+_*2);let L=k=>{if(l[k]!=null){let q=m(u(a[k],c,v,f)),V=m(d(l[k],h,g,p));b(w,q+M,V),x(w,q,V,M,0,Td*2)}};if(r)r.forEach(L);else for(let k=n;k<=s;k++)L(k);return{stroke:T>0?w:null,fill:w,clip:N,flags:oa|Bm}})}function fb(i){return(e,t,n,s,r,o)=>{n!=s&&(r!=n&&o!=n&&i(e,t,n),r!=s&&o!=s&&i(e,t,s),i(e,t,o))}}var sL=fb(la),rL=fb(ca);function pb(i){let e=Ft(i?.alignGaps,0);return(t,n,s,r)=>Jr(t,n,(o,a,l,c,h,u,d,f,p,v,g)=>{[s,r]=Pd(l,s,r);let m=o.pxRound,y=H=>m(u(H,c,v,f)),b=H=>m(d(H,h,g,p)),x,T;c.ori==0?(x=la,T=sL):(x=ca,T=rL);let M=c.dir*(c.ori==0?1:-1),_={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:oa},w=_.stroke,N=!1;if(r-s>=v*4){let H=he=>t.posToVal(he,c.key,!0),L=null,k=null,q,V,ce,Z=y(a[M==1?s:r]),Q=y(a[s]),te=y(a[r]),pe=H(M==1?Q+1:te-1);for(let he=M==1?s:r;he>=s&&he<=r;he+=M){let ee=a[he],xe=(M==1?ee<pe:ee>pe)?Z:y(ee),Le=l[he];xe==Z?Le!=null?(V=Le,L==null?(x(w,xe,b(V)),q=L=k=V):V<L?L=V:V>k&&(k=V)):Le===null&&(N=!0):(L!=null&&T(w,Z,b(L),b(k),b(q),b(V)),Le!=null?(V=Le,x(w,xe,b(V)),L=k=q=V):(L=k=null,Le===null&&(N=!0)),Z=xe,pe=H(Z+M))}L!=null&&L!=k&&ce!=Z&&T(w,Z,b(L),b(k),b(q),b(V))}else for(let H=M==1?s:r;H>=s&&H<=r;H+=M){let L=l[H];L===null?N=!0:L!=null&&x(w,y(a[H]),b(L))}let[I,U]=Qm(t,n);if(o.fill!=null||I!=0){let H=_.fill=new Path2D(w),L=o.fillTo(t,n,o.min,o.max,I),k=b(L),q=y(a[s]),V=y(a[r]);M==-1&&([V,q]=[q,V]),x(H,V,k),x(H,q,k)}if(!o.spanGaps){let H=[];N&&H.push(...eg(a,l,s,r,M,y,e)),_.gaps=H=o.gaps(t,n,s,r,H),_.clip=Dd(H,c.ori,f,p,v,g)}return U!=0&&(_.band=U==2?[Zs(t,n,s,r,w,-1),Zs(t,n,s,r,w,1)]:Zs(t,n,s,r,w,U)),_})}function oL(i){let e=Ft(i.align,1),t=Ft(i.ascDesc,!1),n=Ft(i.alignGaps,0),s=Ft(i.extend,!1);return(r,o,a,l)=>Jr(r,o,(c,h,u,d,f,p,v,g,m,y,b)=>{[a,l]=Pd(u,a,l);let x=c.pxRound,{left:T,width:M}=r.bbox,_=Q=>x(p(Q,d,y,g)),w=Q=>x(v(Q,f,b,m)),N=d.ori==0?la:ca,P={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:oa},I=P.stroke,U=d.dir*(d.ori==0?1:-1),H=w(u[U==1?a:l]),L=_(h[U==1?a:l]),k=L,q=L;s&&e==-1&&(q=T,N(I,q,H)),N(I,L,H);for(let Q=U==1?a:l;Q>=a&&Q<=l;Q+=U){let te=u[Q];if(te==null)continue;let pe=_(h[Q]),he=w(te);e==1?N(I,pe,H):N(I,k,he),N(I,pe,he),H=he,k=pe}let V=k;s&&e==1&&(V=T+M,N(I,V,H));let[ce,Z]=Qm(r,o);if(c.fill!=null||ce!=0){let Q=P.fill=new Path2D(I),te=c.fillTo(r,o,c.min,c.max,ce),pe=w(te);N(Q,V,pe),N(Q,q,pe)}if(!c.spanGaps){let Q=[];Q.push(...eg(h,u,a,l,U,_,n));let te=c.width*Ht/2,pe=t||e==1?te:-te,he=t||e==-1?-te:te;Q.forEach(ee=>{ee[0]+=pe,ee[1]+=he}),P.gaps=Q=c.gaps(r,o,a,l,Q),P.clip=Dd(Q,d.ori,g,m,y,b)}return Z!=0&&(P.band=Z==2?[Zs(r,o,a,l,I,-1),Zs(r,o,a,l,I,1)]:Zs(r,o,a,l,I,Z)),P})}function R_(i,e,t,n,s,r,o=jt){if(i.length>1){let a=null;for(let l=0,c=1/0;l<i.length;l++)if(e[l]!==void 0){if(a!=null){let h=Nn(i[l]-i[a]);h<c&&(c=h,o=Nn(t(i[l],n,s,r)-t(i[a],n,s,r)))}a=l}}return o}function aL(i){i=i||Kl;let e=Ft(i.size,[.6,jt,1]),t=i.align||0,n=i.gap||0,s=i.radius;s=s==null?[0,0]:typeof s=="number"?[s,0]:s;let r=It(s),o=1-e[0],a=Ft(e[1],jt),l=Ft(e[2],1),c=Ft(i.disp,Kl),h=Ft(i.each,f=>{}),{fill:u,stroke:d}=c;return(f,p,v,g)=>Jr(f,p,(m,y,b,x,T,M,_,w,N,P,I)=>{let U=m.pxRound,H=t,L=n*Ht,k=a*Ht,q=l*Ht,V,ce;x.ori==0?[V,ce]=r(f,p):[ce,V]=r(f,p);let Z=x.dir*(x.ori==0?1:-1),Q=x.ori==0?Ud:tg,te=x.ori==0?h:(Ee,Xe,ft,Se,zt,$e,tt)=>{h(Ee,Xe,ft,zt,Se,tt,$e)},pe=Ft(f.bands,$m).find(Ee=>Ee.series[0]==p),he=pe!=null?pe.dir:0,ee=m.fillTo(f,p,m.min,m.max,he),ye=U(_(ee,T,I,N)),xe,Le,Me,Ve=P,at=U(m.width*Ht),Ze=!1,lt=null,rt=null,oe=null,_e=null;u!=null&&(at==0||d!=null)&&(Ze=!0,lt=u.values(f,p,v,g),rt=new Map,new Set(lt).forEach(Ee=>{Ee!=null&&rt.set(Ee,new Path2D)}),at>0&&(oe=d.values(f,p,v,g),_e=new Map,new Set(oe).forEach(Ee=>{Ee!=null&&_e.set(Ee,new Path2D)})));let{x0:ve,size:ke}=c;if(ve!=null&&ke!=null){H=1,y=ve.values(f,p,v,g),ve.unit==2&&(y=y.map(ft=>f.posToVal(w+ft*P,x.key,!0)));let Ee=ke.values(f,p,v,g);ke.unit==2?Le=Ee[0]*P:Le=M(Ee[0],x,P,w)-M(0,x,P,w),Ve=R_(y,b,M,x,P,w,Ve),Me=Ve-Le+L}else Ve=R_(y,b,M,x,P,w,Ve),Me=Ve*o+L,Le=Ve-Me;Me<1&&(Me=0),at>=Le/2&&(at=0),Me<5&&(U=U_);let Ne=Me>0,st=Ve-Me-(Ne?at:0);Le=U(Om(st,q,k)),xe=(H==0?Le/2:H==Z?0:Le)-H*Z*((H==0?L/2:0)+(Ne?at/2:0));let Be={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},xt=Ze?null:new Path2D,gt=null;if(pe!=null)gt=f.data[pe.series[1]];else{let{y0:Ee,y1:Xe}=c;Ee!=null&&Xe!=null&&(b=Xe.values(f,p,v,g),gt=Ee.values(f,p,v,g))}let bt=V*Le,B=ce*Le;for(let Ee=Z==1?v:g;Ee>=v&&Ee<=g;Ee+=Z){let Xe=b[Ee];if(Xe==null)continue;if(gt!=null){let Y=gt[Ee]??0;if(Xe-Y==0)continue;ye=_(Y,T,I,N)}let ft=x.distr!=2||c!=null?y[Ee]:Ee,Se=M(ft,x,P,w),zt=_(Ft(Xe,ee),T,I,N),$e=U(Se-xe),tt=U(di(zt,ye)),D=U(is(zt,ye)),A=tt-D;if(Xe!=null){let Y=Xe<0?B:bt,fe=Xe<0?bt:B;Ze?(at>0&&oe[Ee]!=null&&Q(_e.get(oe[Ee]),$e,D+Li(at/2),Le,di(0,A-at),Y,fe),lt[Ee]!=null&&Q(rt.get(lt[Ee]),$e,D+Li(at/2),Le,di(0,A-at),Y,fe)):Q(xt,$e,D+Li(at/2),Le,di(0,A-at),Y,fe),te(f,p,Ee,$e-at/2,D,Le+at,A)}}return at>0?Be.stroke=Ze?_e:xt:Ze||(Be._fill=m.width==0?m._fill:m._stroke??m._fill,Be.width=0),Be.fill=Ze?rt:xt,Be})}function lL(i,e){let t=Ft(e?.alignGaps,0);return(n,s,r,o)=>Jr(n,s,(a,l,c,h,u,d,f,p,v,g,m)=>{[r,o]=Pd(c,r,o);let y=a.pxRound,b=V=>y(d(V,h,g,p)),x=V=>y(f(V,u,m,v)),T,M,_;h.ori==0?(T=Fd,_=la,M=hb):(T=Od,_=ca,M=ub);let w=h.dir*(h.ori==0?1:-1),N=b(l[w==1?r:o]),P=N,I=[],U=[];for(let V=w==1?r:o;V>=r&&V<=o;V+=w)if(c[V]!=null){let Z=l[V],Q=b(Z);I.push(P=Q),U.push(x(c[V]))}let H={stroke:i(I,U,T,_,M,y),fill:null,clip:null,band:null,gaps:null,flags:oa},L=H.stroke,[k,q]=Qm(n,s);if(a.fill!=null||k!=0){let V=H.fill=new Path2D(L),ce=a.fillTo(n,s,a.min,a.max,k),Z=x(ce);_(V,P,Z),_(V,N,Z)}if(!a.spanGaps){let V=[];V.push(...eg(l,c,r,o,w,b,t)),H.gaps=V=a.gaps(n,s,r,o,V),H.clip=Dd(V,h.ori,p,v,g,m)}return q!=0&&(H.band=q==2?[Zs(n,s,r,o,L,-1),Zs(n,s,r,o,L,1)]:Zs(n,s,r,o,L,q)),H})}function cL(i){return lL(hL,i)}function hL(i,e,t,n,s,r){let o=i.length;if(o<2)return null;let a=new Path2D;if(t(a,i[0],e[0]),o==2)n(a,i[1],e[1]);else{let l=Array(o),c=Array(o-1),h=Array(o-1),u=Array(o-1);for(let d=0;d<o-1;d++)h[d]=e[d+1]-e[d],u[d]=i[d+1]-i[d],c[d]=h[d]/u[d];l[0]=c[0];for(let d=1;d<o-1;d++)c[d]===0||c[d-1]===0||c[d-1]>0!=c[d]>0?l[d]=0:(l[d]=3*(u[d-1]+u[d])/((2*u[d]+u[d-1])/c[d-1]+(u[d]+2*u[d-1])/c[d]),isFinite(l[d])||(l[d]=0));l[o-1]=c[o-2];for(let d=0;d<o-1;d++)s(a,i[d]+u[d]/3,e[d]+l[d]*u[d]/3,i[d+1]-u[d]/3,e[d+1]-l[d+1]*u[d]/3,i[d+1],e[d+1])}return a}var Hm=new Set;function C_(){for(let i of Hm)i.syncRect(!0)}aa&&(jr(W2,na,C_),jr(X2,na,C_,!0),jr(Ad,na,()=>{Hn.pxRatio=Ht}));var uL=pb(),dL=db();function P_(i,e,t,n){return(n?[i[0],i[1]].concat(i.slice(2)):[i[0]].concat(i.slice(1))).map((r,o)=>zm(r,o,e,t))}function fL(i,e){return i.map((t,n)=>n==0?{}:Tn({},e,t))}function zm(i,e,t,n){return Tn({},e==0?t:n,i)}function mb(i,e,t){return e==null?sa:[e,t]}var pL=mb;function mL(i,e,t){return e==null?sa:Rd(e,t,qm,!0)}function gb(i,e,t,n){return e==null?sa:Id(e,t,i.scales[n].log,!1)}var gL=gb;function yb(i,e,t,n){return e==null?sa:Xm(e,t,i.scales[n].log,!1)}var yL=yb;function vL(i,e,t,n,s){let r=di(l_(i),l_(e)),o=e-i,a=ns(s/n*o,t);do{let l=t[a],c=n*l/o;if(c>=s&&r+(l<5?Mr.get(l):0)<=17)return[l,c]}while(++a<t.length);return[0,0]}function I_(i){let e,t;return i=i.replace(/(\d+)px/,(n,s)=>(e=Ln((t=+s)*Ht))+"px"),[i,e,t]}function xL(i){i.show&&[i.font,i.labelFont].forEach(e=>{let t=Zt(e[2]*Ht,1);e[0]=e[0].replace(/[0-9.]+px/,t+"px"),e[1]=t})}function Hn(i,e,t){let n={mode:Ft(i.mode,1)},s=n.mode;function r(E,R,F,O){let X=R.valToPct(E);return O+F*(R.dir==-1?1-X:X)}function o(E,R,F,O){let X=R.valToPct(E);return O+F*(R.dir==-1?X:1-X)}function a(E,R,F,O){return R.ori==0?r(E,R,F,O):o(E,R,F,O)}n.valToPosH=r,n.valToPosV=o;let l=!1;n.status=0;let c=n.root=Gi(T2);if(i.id!=null&&(c.id=i.id),Ii(c,i.class),i.title){let E=Gi(C2,c);E.textContent=i.title}let h=ts("canvas"),u=n.ctx=h.getContext("2d"),d=Gi(P2,c);jr("click",d,E=>{E.target===p&&(Qt!=so||rn!=ro)&&zn.click(n,E)},!0);let f=n.under=Gi(I2,d);d.appendChild(h);let p=n.over=Gi(L2,d);i=ra(i);let v=+Ft(i.pxAlign,1),g=A_(v);(i.plugins||[]).forEach(E=>{E.opts&&(i=E.opts(n,i)||i)});let m=i.ms||.001,y=n.series=s==1?P_(i.series||[],__,S_,!1):fL(i.series||[null],M_),b=n.axes=P_(i.axes||[],x_,E_,!0),x=n.scales={},T=n.bands=i.bands||[];T.forEach(E=>{E.fill=It(E.fill||null),E.dir=Ft(E.dir,-1)});let M=s==2?y[1].facets[0].scale:y[0].scale,_={axes:Rs,series:At},w=(i.drawOrder||["axes","series"]).map(E=>_[E]);function N(E){let R=E.distr==3?F=>js(F>0?F:E.clamp(n,F,E.min,E.max,E.key)):E.distr==4?F=>Rm(F,E.asinh):E.distr==100?F=>E.fwd(F):F=>F;return F=>{let O=R(F),{_min:X,_max:J}=E,le=J-X;return(O-X)/le}}function P(E){let R=x[E];if(R==null){let F=(i.scales||Kl)[E]||Kl;if(F.from!=null){P(F.from);let O=Tn({},x[F.from],F,{key:E});O.valToPct=N(O),x[E]=O}else{R=x[E]=Tn({},E==M?rb:tL,F),R.key=E;let O=R.time,X=R.range,J=wr(X);if((E!=M||s==2&&!O)&&(J&&(X[0]==null||X[1]==null)&&(X={min:X[0]==null?r_:{mode:1,hard:X[0],soft:X[0]},max:X[1]==null?r_:{mode:1,hard:X[1],soft:X[1]}},J=!1),!J&&Nd(X))){let le=X;X=(me,Ae,He)=>Ae==null?sa:Rd(Ae,He,le)}R.range=It(X||(O?pL:E==M?R.distr==3?gL:R.distr==4?yL:mb:R.distr==3?gb:R.distr==4?yb:mL)),R.auto=It(J?!1:R.auto),R.clamp=It(R.clamp||eL),R._min=R._max=null,R.valToPct=N(R)}}}P("x"),P("y"),s==1&&y.forEach(E=>{P(E.scale)}),b.forEach(E=>{P(E.scale)});for(let E in i.scales)P(E);let I=x[M],U=I.distr,H,L;I.ori==0?(Ii(c,A2),H=r,L=o):(Ii(c,R2),H=o,L=r);let k={};for(let E in x){let R=x[E];(R.min!=null||R.max!=null)&&(k[E]={min:R.min,max:R.max},R.min=R.max=null)}let q=i.tzDate||(E=>new Date(Ln(E/m))),V=i.fmtDate||jm,ce=m==1?AI(q):PI(q),Z=g_(q,m_(m==1?TI:CI,V)),Q=v_(q,y_(LI,V)),te=[],pe=n.legend=Tn({},FI,i.legend),he=n.cursor=Tn({},zI,{drag:{y:s==2}},i.cursor),ee=pe.show,ye=he.show,xe=pe.markers;pe.idxs=te,xe.width=It(xe.width),xe.dash=It(xe.dash),xe.stroke=It(xe.stroke),xe.fill=It(xe.fill);let Le,Me,Ve,at=[],Ze=[],lt,rt=!1,oe={};if(pe.live){let E=y[1]?y[1].values:null;rt=E!=null,lt=rt?E(n,1,0):{_:0};for(let R in lt)oe[R]=Gm}if(ee)if(Le=ts("table",k2,c),Ve=ts("tbody",null,Le),pe.mount(n,Le),rt){Me=ts("thead",null,Le,Ve);let E=ts("tr",null,Me);ts("th",null,E);for(var _e in lt)ts("th",qx,E).textContent=_e}else Ii(Le,H2),pe.live&&Ii(Le,B2);let ve={show:!0},ke={show:!1};function Ne(E,R){if(R==0&&(rt||!pe.live||s==2))return sa;let F=[],O=ts("tr",z2,Ve,Ve.childNodes[R]);Ii(O,E.class),E.show||Ii(O,$r);let X=ts("th",null,O);if(xe.show){let me=Gi(V2,X);if(R>0){let Ae=xe.width(n,R);Ae&&(me.style.border=Ae+"px "+xe.dash(n,R)+" "+xe.stroke(n,R)),me.style.background=xe.fill(n,R)}}let J=Gi(qx,X);E.label instanceof HTMLElement?J.appendChild(E.label):J.textContent=E.label,R>0&&(xe.show||(J.style.color=E.width>0?xe.stroke(n,R):xe.fill(n,R)),Be("click",X,me=>{if(he._lock)return;ut(me);let Ae=y.indexOf(E);if((me.ctrlKey||me.metaKey)!=pe.isolate){let He=y.some((ze,We)=>We>0&&We!=Ae&&ze.show);y.forEach((ze,We)=>{We>0&&as(We,He?We==Ae?ve:ke:ve,!0,bn.setSeries)})}else as(Ae,{show:!E.show},!0,bn.setSeries)},!1),dt&&Be(Zx,X,me=>{he._lock||(ut(me),as(y.indexOf(E),ao,!0,bn.setSeries))},!1));for(var le in lt){let me=ts("td",G2,O);me.textContent="--",F.push(me)}return[O,F]}let st=new Map;function Be(E,R,F,O=!0){let X=st.get(R)||{},J=he.bind[E](n,R,F,O);J&&(jr(E,R,X[E]=J),st.set(R,X))}function xt(E,R,F){let O=st.get(R)||{};for(let X in O)(E==null||X==E)&&(Fm(X,R,O[X]),delete O[X]);E==null&&st.delete(R)}let gt=0,bt=0,B=0,Ee=0,Xe=0,ft=0,Se=Xe,zt=ft,$e=B,tt=Ee,D=0,A=0,Y=0,fe=0;n.bbox={};let ae=!1,we=!1,Te=!1,ne=!1,se=!1,ge=!1;function z(E,R,F){(F||E!=n.width||R!=n.height)&&re(E,R),Et(!1),Te=!0,we=!0,qn()}function re(E,R){n.width=gt=B=E,n.height=bt=Ee=R,Xe=ft=0,Re(),Je();let F=n.bbox;D=F.left=qr(Xe*Ht,.5),A=F.top=qr(ft*Ht,.5),Y=F.width=qr(B*Ht,.5),fe=F.height=qr(Ee*Ht,.5)}let ie=3;function Ce(){let E=!1,R=0;for(;!E;){R++;let F=to(R),O=os(R);E=R==ie||F&&O,E||(re(n.width,n.height),we=!0)}}function be({width:E,height:R}){z(E,R)}n.setSize=be;function Re(){let E=!1,R=!1,F=!1,O=!1;b.forEach((X,J)=>{if(X.show&&X._show){let{side:le,_size:me}=X,Ae=le%2,He=X.label!=null?X.labelSize:0,ze=me+He;ze>0&&(Ae?(B-=ze,le==3?(Xe+=ze,O=!0):F=!0):(Ee-=ze,le==0?(ft+=ze,E=!0):R=!0))}}),ss[0]=E,ss[1]=F,ss[2]=R,ss[3]=O,B-=Xi[1]+Xi[3],Xe+=Xi[3],Ee-=Xi[2]+Xi[0],ft+=Xi[0]}function Je(){let E=Xe+B,R=ft+Ee,F=Xe,O=ft;function X(J,le){switch(J){case 1:return E+=le,E-le;case 2:return R+=le,R-le;case 3:return F-=le,F+le;case 0:return O-=le,O+le}}b.forEach((J,le)=>{if(J.show&&J._show){let me=J.side;J._pos=X(me,J._size),J.label!=null&&(J._lpos=X(me,J.labelSize))}})}if(he.dataIdx==null){let E=he.hover,R=E.skip=new Set(E.skip??[]);R.add(void 0);let F=E.prox=It(E.prox),O=E.bias??=0;he.dataIdx=(X,J,le,me)=>{if(J==0)return le;let Ae=le,He=F(X,J,le,me)??jt,ze=He>=0&&He<jt,We=I.ori==0?B:Ee,vt=he.left,Ot=e[0],Dt=e[J];if(R.has(Dt[le])){Ae=null;let Rt=null,ct=null,Ke;if(O==0||O==-1)for(Ke=le;Rt==null&&Ke-- >0;)R.has(Dt[Ke])||(Rt=Ke);if(O==0||O==1)for(Ke=le;ct==null&&Ke++<Dt.length;)R.has(Dt[Ke])||(ct=Ke);if(Rt!=null||ct!=null)if(ze){let tn=Rt==null?-1/0:H(Ot[Rt],I,We,0),dn=ct==null?1/0:H(Ot[ct],I,We,0),Un=vt-tn,$t=dn-vt;Un<=$t?Un<=He&&(Ae=Rt):$t<=He&&(Ae=ct)}else Ae=ct==null?Rt:Rt==null?ct:le-Rt<=ct-le?Rt:ct}else ze&&Nn(vt-H(Ot[le],I,We,0))>He&&(Ae=null);return Ae}}let ut=E=>{he.event=E};he.idxs=te,he._lock=!1;let de=he.points;de.show=It(de.show),de.size=It(de.size),de.stroke=It(de.stroke),de.width=It(de.width),de.fill=It(de.fill);let qe=n.focus=Tn({},i.focus||{alpha:.3},he.focus),dt=qe.prox>=0,De=dt&&de.one,_t=[],Kt=[],Kn=[];function ha(E,R){let F=de.show(n,R);if(F instanceof HTMLElement)return Ii(F,U2),Ii(F,E.class),Ms(F,-10,-10,B,Ee),p.insertBefore(F,_t[R]),F}function Kr(E,R){if(s==1||R>0){let F=s==1&&x[E.scale].time,O=E.value;E.value=F?u_(O)?v_(q,y_(O,V)):O||Q:O||JI,E.label=E.label||(F?GI:VI)}if(De||R>0){E.width=E.width==null?1:E.width,E.paths=E.paths||uL||tI,E.fillTo=It(E.fillTo||nL),E.pxAlign=+Ft(E.pxAlign,v),E.pxRound=A_(E.pxAlign),E.stroke=It(E.stroke||null),E.fill=It(E.fill||null),E._stroke=E._fill=E._paths=E._focus=null;let F=KI(di(1,E.width),1),O=E.points=Tn({},{size:F,width:di(1,F*.2),stroke:E.stroke,space:F*2,paths:dL,_stroke:null,_fill:null},E.points);O.show=It(O.show),O.filter=It(O.filter),O.fill=It(O.fill),O.stroke=It(O.stroke),O.paths=It(O.paths),O.pxAlign=E.pxAlign}if(ee){let F=Ne(E,R);at.splice(R,0,F[0]),Ze.splice(R,0,F[1]),pe.values.push(null)}if(ye){te.splice(R,0,null);let F=null;De?R==0&&(F=ha(E,R)):R>0&&(F=ha(E,R)),_t.splice(R,0,F),Kt.splice(R,0,0),Kn.splice(R,0,0)}On("addSeries",R)}function Gd(E,R){R=R??y.length,E=s==1?zm(E,R,__,S_):zm(E,R,{},M_),y.splice(R,0,E),Kr(y[R],R)}n.addSeries=Gd;function tc(E){if(y.splice(E,1),ee){pe.values.splice(E,1),Ze.splice(E,1);let R=at.splice(E,1)[0];xt(null,R.firstChild),R.remove()}ye&&(te.splice(E,1),_t.splice(E,1)[0].remove(),Kt.splice(E,1),Kn.splice(E,1)),On("delSeries",E)}n.delSeries=tc;let ss=[!1,!1,!1,!1];function Ss(E,R){if(E._show=E.show,E.show){let F=E.side%2,O=x[E.scale];O==null&&(E.scale=F?y[1].scale:M,O=x[E.scale]);let X=O.time;E.size=It(E.size),E.space=It(E.space),E.rotate=It(E.rotate),wr(E.incrs)&&E.incrs.forEach(le=>{!Mr.has(le)&&Mr.set(le,H_(le))}),E.incrs=It(E.incrs||(O.distr==2?wI:X?m==1?SI:RI:Yr)),E.splits=It(E.splits||(X&&O.distr==1?ce:O.distr==3?Um:O.distr==4?qI:XI)),E.stroke=It(E.stroke),E.grid.stroke=It(E.grid.stroke),E.ticks.stroke=It(E.ticks.stroke),E.border.stroke=It(E.border.stroke);let J=E.values;E.values=wr(J)&&!wr(J[0])?It(J):X?wr(J)?g_(q,m_(J,V)):u_(J)?II(q,J):J||Z:J||WI,E.filter=It(E.filter||(O.distr>=3&&O.log==10?jI:O.distr==3&&O.log==2?ZI:k_)),E.font=I_(E.font),E.labelFont=I_(E.labelFont),E._size=E.size(n,null,R,0),E._space=E._rotate=E._incrs=E._found=E._splits=E._values=null,E._size>0&&(ss[R]=!0,E._el=Gi(N2,d))}}function Ts(E,R,F,O){let[X,J,le,me]=F,Ae=R%2,He=0;return Ae==0&&(me||J)&&(He=R==0&&!X||R==2&&!le?Ln(x_.size/3):0),Ae==1&&(X||le)&&(He=R==1&&!J||R==3&&!me?Ln(E_.size/2):0),He}let ua=n.padding=(i.padding||[Ts,Ts,Ts,Ts]).map(E=>It(Ft(E,Ts))),Xi=n._padding=ua.map((E,R)=>E(n,R,ss,0)),hn,gn=null,yn=null,rs=s==1?y[0].idxs:null,xi=null,Js=!1;function da(E,R){if(e=E??[],n.data=n._data=e,s==2){hn=0;for(let F=1;F<y.length;F++)hn+=e[F][0].length}else{e.length==0&&(n.data=n._data=e=[[]]),xi=e[0],hn=xi.length;let F=e;if(U==2){F=e.slice();let O=F[0]=Array(hn);for(let X=0;X<hn;X++)O[X]=X}n._data=e=F}if(Et(!0),On("setData"),U==2&&(Te=!0),R!==!1){let F=I;F.auto(n,Js)?fa():er(M,F.min,F.max),ne=ne||he.left>=0,ge=!0,qn()}}n.setData=da;function fa(){Js=!0;let E,R;s==1&&(hn>0?(gn=rs[0]=0,yn=rs[1]=hn-1,E=e[0][gn],R=e[0][yn],U==2?(E=gn,R=yn):E==R&&(U==3?[E,R]=Id(E,E,I.log,!1):U==4?[E,R]=Xm(E,E,I.log,!1):I.time?R=E+Ln(86400/m):[E,R]=Rd(E,R,qm,!0))):(gn=rs[0]=E=null,yn=rs[1]=R=null)),er(M,E,R)}let Qr,Ks,eo,C,G,K,$,j,Pe,Oe;function Ie(E,R,F,O,X,J){E??=$x,F??=$m,O??="butt",X??=$x,J??="round",E!=Qr&&(u.strokeStyle=Qr=E),X!=Ks&&(u.fillStyle=Ks=X),R!=eo&&(u.lineWidth=eo=R),J!=G&&(u.lineJoin=G=J),O!=K&&(u.lineCap=K=O),F!=C&&u.setLineDash(C=F)}function Ue(E,R,F,O){R!=Ks&&(u.fillStyle=Ks=R),E!=$&&(u.font=$=E),F!=j&&(u.textAlign=j=F),O!=Pe&&(u.textBaseline=Pe=O)}function je(E,R,F,O,X=0){if(O.length>0&&E.auto(n,Js)&&(R==null||R.min==null)){let J=Ft(gn,0),le=Ft(yn,O.length-1),me=F.min==null?j2(O,J,le,X,E.distr==3):[F.min,F.max];E.min=is(E.min,F.min=me[0]),E.max=di(E.max,F.max=me[1])}}let pt={min:null,max:null};function Tt(){for(let O in x){let X=x[O];k[O]==null&&(X.min==null||k[M]!=null&&X.auto(n,Js))&&(k[O]=pt)}for(let O in x){let X=x[O];k[O]==null&&X.from!=null&&k[X.from]!=null&&(k[O]=pt)}k[M]!=null&&Et(!0);let E={};for(let O in k){let X=k[O];if(X!=null){let J=E[O]=ra(x[O],sI);if(X.min!=null)Tn(J,X);else if(O!=M||s==2)if(hn==0&&J.from==null){let le=J.range(n,null,null,O);J.min=le[0],J.max=le[1]}else J.min=jt,J.max=-jt}}if(hn>0){y.forEach((O,X)=>{if(s==1){let J=O.scale,le=k[J];if(le==null)return;let me=E[J];if(X==0){let Ae=me.range(n,me.min,me.max,J);me.min=Ae[0],me.max=Ae[1],gn=ns(me.min,e[0]),yn=ns(me.max,e[0]),yn-gn>1&&(e[0][gn]<me.min&&gn++,e[0][yn]>me.max&&yn--),O.min=xi[gn],O.max=xi[yn]}else O.show&&O.auto&&je(me,le,O,e[X],O.sorted);O.idxs[0]=gn,O.idxs[1]=yn}else if(X>0&&O.show&&O.auto){let[J,le]=O.facets,me=J.scale,Ae=le.scale,[He,ze]=e[X],We=E[me],vt=E[Ae];We!=null&&je(We,k[me],J,He,J.sorted),vt!=null&&je(vt,k[Ae],le,ze,le.sorted),O.min=le.min,O.max=le.max}});for(let O in E){let X=E[O],J=k[O];if(X.from==null&&(J==null||J.min==null)){let le=X.range(n,X.min==jt?null:X.min,X.max==-jt?null:X.max,O);X.min=le[0],X.max=le[1]}}}for(let O in E){let X=E[O];if(X.from!=null){let J=E[X.from];if(J.min==null)X.min=X.max=null;else{let le=X.range(n,J.min,J.max,O);X.min=le[0],X.max=le[1]}}}let R={},F=!1;for(let O in E){let X=E[O],J=x[O];if(J.min!=X.min||J.max!=X.max){J.min=X.min,J.max=X.max;let le=J.distr;J._min=le==3?js(J.min):le==4?Rm(J.min,J.asinh):le==100?J.fwd(J.min):J.min,J._max=le==3?js(J.max):le==4?Rm(J.max,J.asinh):le==100?J.fwd(J.max):J.max,R[O]=F=!0}}if(F){y.forEach((O,X)=>{s==2?X>0&&R.y&&(O._paths=null):R[O.scale]&&(O._paths=null)});for(let O in R)Te=!0,On("setScale",O);ye&&he.left>=0&&(ne=ge=!0)}for(let O in k)k[O]=null}function Ye(E){let R=Om(gn-1,0,hn-1),F=Om(yn+1,0,hn-1);for(;E[R]==null&&R>0;)R--;for(;E[F]==null&&F<hn-1;)F++;return[R,F]}function At(){if(hn>0){let E=y.some(R=>R._focus)&&Oe!=qe.alpha;E&&(u.globalAlpha=Oe=qe.alpha),y.forEach((R,F)=>{if(F>0&&R.show&&(an(F,!1),an(F,!0),R._paths==null)){let O=Oe;Oe!=R.alpha&&(u.globalAlpha=Oe=R.alpha);let X=s==2?[0,e[F][0].length-1]:Ye(e[F]);R._paths=R.paths(n,F,X[0],X[1]),Oe!=O&&(u.globalAlpha=Oe=O)}}),y.forEach((R,F)=>{if(F>0&&R.show){let O=Oe;Oe!=R.alpha&&(u.globalAlpha=Oe=R.alpha),R._paths!=null&&Xt(F,!1);{let X=R._paths!=null?R._paths.gaps:null,J=R.points.show(n,F,gn,yn,X),le=R.points.filter(n,F,J,X);(J||le)&&(R.points._paths=R.points.paths(n,F,gn,yn,le),Xt(F,!0))}Oe!=O&&(u.globalAlpha=Oe=O),On("drawSeries",F)}}),E&&(u.globalAlpha=Oe=1)}}function an(E,R){let F=R?y[E].points:y[E];F._stroke=F.stroke(n,E),F._fill=F.fill(n,E)}function Xt(E,R){let F=R?y[E].points:y[E],{stroke:O,fill:X,clip:J,flags:le,_stroke:me=F._stroke,_fill:Ae=F._fill,_width:He=F.width}=F._paths;He=Zt(He*Ht,3);let ze=null,We=He%2/2;R&&Ae==null&&(Ae=He>0?"#fff":me);let vt=F.pxAlign==1&&We>0;if(vt&&u.translate(We,We),!R){let Ot=D-He/2,Dt=A-He/2,Rt=Y+He,ct=fe+He;ze=new Path2D,ze.rect(Ot,Dt,Rt,ct)}R?Ge(me,He,F.dash,F.cap,Ae,O,X,le,J):qt(E,me,He,F.dash,F.cap,Ae,O,X,le,ze,J),vt&&u.translate(-We,-We)}function qt(E,R,F,O,X,J,le,me,Ae,He,ze){let We=!1;Ae!=0&&T.forEach((vt,Ot)=>{if(vt.series[0]==E){let Dt=y[vt.series[1]],Rt=e[vt.series[1]],ct=(Dt._paths||Kl).band;wr(ct)&&(ct=vt.dir==1?ct[0]:ct[1]);let Ke,tn=null;Dt.show&&ct&&J2(Rt,gn,yn)?(tn=vt.fill(n,Ot)||J,Ke=Dt._paths.clip):ct=null,Ge(R,F,O,X,tn,le,me,Ae,He,ze,Ke,ct),We=!0}}),We||Ge(R,F,O,X,J,le,me,Ae,He,ze)}let An=oa|Bm;function Ge(E,R,F,O,X,J,le,me,Ae,He,ze,We){Ie(E,R,F,O,X),(Ae||He||We)&&(u.save(),Ae&&u.clip(Ae),He&&u.clip(He)),We?(me&An)==An?(u.clip(We),ze&&u.clip(ze),Pt(X,le),vn(E,J,R)):me&Bm?(Pt(X,le),u.clip(We),vn(E,J,R)):me&oa&&(u.save(),u.clip(We),ze&&u.clip(ze),Pt(X,le),u.restore(),vn(E,J,R)):(Pt(X,le),vn(E,J,R)),(Ae||He||We)&&u.restore()}function vn(E,R,F){F>0&&(R instanceof Map?R.forEach((O,X)=>{u.strokeStyle=Qr=X,u.stroke(O)}):R!=null&&E&&u.stroke(R))}function Pt(E,R){R instanceof Map?R.forEach((F,O)=>{u.fillStyle=Ks=O,u.fill(F)}):R!=null&&E&&u.fill(R)}function As(E,R,F,O){let X=b[E],J;if(O<=0)J=[0,0];else{let le=X._space=X.space(n,E,R,F,O),me=X._incrs=X.incrs(n,E,R,F,O,le);J=vL(R,F,me,O,le)}return X._found=J}function xn(E,R,F,O,X,J,le,me,Ae,He){let ze=le%2/2;v==1&&u.translate(ze,ze),Ie(me,le,Ae,He,me),u.beginPath();let We,vt,Ot,Dt,Rt=X+(O==0||O==3?-J:J);F==0?(vt=X,Dt=Rt):(We=X,Ot=Rt);for(let ct=0;ct<E.length;ct++)R[ct]!=null&&(F==0?We=Ot=E[ct]:vt=Dt=E[ct],u.moveTo(We,vt),u.lineTo(Ot,Dt));u.stroke(),v==1&&u.translate(-ze,-ze)}function to(E){let R=!0;return b.forEach((F,O)=>{if(!F.show)return;let X=x[F.scale];if(X.min==null){F._show&&(R=!1,F._show=!1,Et(!1));return}else F._show||(R=!1,F._show=!0,Et(!1));let J=F.side,le=J%2,{min:me,max:Ae}=X,[He,ze]=As(O,me,Ae,le==0?B:Ee);if(ze==0)return;let We=X.distr==2,vt=F._splits=F.splits(n,O,me,Ae,He,ze,We),Ot=X.distr==2?vt.map(Ke=>xi[Ke]):vt,Dt=X.distr==2?xi[vt[1]]-xi[vt[0]]:He,Rt=F._values=F.values(n,F.filter(n,Ot,O,ze,Dt),O,ze,Dt);F._rotate=J==2?F.rotate(n,Rt,O,ze):0;let ct=F._size;F._size=Wi(F.size(n,Rt,O,E)),ct!=null&&F._size!=ct&&(R=!1)}),R}function os(E){let R=!0;return ua.forEach((F,O)=>{let X=F(n,O,ss,E);X!=Xi[O]&&(R=!1),Xi[O]=X}),R}function Rs(){for(let E=0;E<b.length;E++){let R=b[E];if(!R.show||!R._show)continue;let F=R.side,O=F%2,X,J,le=R.stroke(n,E),me=F==0||F==3?-1:1,[Ae,He]=R._found;if(R.label!=null){let ti=R.labelGap*me,Ei=Ln((R._lpos+ti)*Ht);Ue(R.labelFont[0],le,"center",F==2?"top":Yx),u.save(),O==1?(X=J=0,u.translate(Ei,Ln(A+fe/2)),u.rotate((F==3?-Td:Td)/2)):(X=Ln(D+Y/2),J=Ei);let Ar=O_(R.label)?R.label(n,E,Ae,He):R.label;u.fillText(Ar,X,J),u.restore()}if(He==0)continue;let ze=x[R.scale],We=O==0?Y:fe,vt=O==0?D:A,Ot=R._splits,Dt=ze.distr==2?Ot.map(ti=>xi[ti]):Ot,Rt=ze.distr==2?xi[Ot[1]]-xi[Ot[0]]:Ae,ct=R.ticks,Ke=R.border,tn=ct.show?ct.size:0,dn=Ln(tn*Ht),Un=Ln((R.alignTo==2?R._size-tn-R.gap:R.gap)*Ht),$t=R._rotate*-Td/180,fn=g(R._pos*Ht),_i=(dn+Un)*me,ei=fn+_i;J=O==0?ei:0,X=O==1?ei:0;let Di=R.font[0],qi=R.align==1?ea:R.align==2?Sm:$t>0?ea:$t<0?Sm:O==0?"center":F==3?Sm:ea,cs=$t||O==1?"middle":F==2?"top":Yx;Ue(Di,le,qi,cs);let bi=R.font[1]*R.lineGap,Fi=Ot.map(ti=>g(a(ti,ze,We,vt))),Yi=R._values;for(let ti=0;ti<Yi.length;ti++){let Ei=Yi[ti];if(Ei!=null){O==0?X=Fi[ti]:J=Fi[ti],Ei=""+Ei;let Ar=Ei.indexOf(`
`)==-1?[Ei]:Ei.split(/\n/gm);for(let ni=0;ni<Ar.length;ni++){let wg=Ar[ni];$t?(u.save(),u.translate(X,J+ni*bi),u.rotate($t),u.fillText(wg,0,0),u.restore()):u.fillText(wg,X,J+ni*bi)}}}ct.show&&xn(Fi,ct.filter(n,Dt,E,He,Rt),O,F,fn,dn,Zt(ct.width*Ht,3),ct.stroke(n,E),ct.dash,ct.cap);let hs=R.grid;hs.show&&xn(Fi,hs.filter(n,Dt,E,He,Rt),O,O==0?2:1,O==0?A:D,O==0?fe:Y,Zt(hs.width*Ht,3),hs.stroke(n,E),hs.dash,hs.cap),Ke.show&&xn([fn],[1],O==0?1:0,O==0?1:2,O==1?A:D,O==1?fe:Y,Zt(Ke.width*Ht,3),Ke.stroke(n,E),Ke.dash,Ke.cap)}On("drawAxes")}function Et(E){y.forEach((R,F)=>{F>0&&(R._paths=null,E&&(s==1?(R.min=null,R.max=null):R.facets.forEach(O=>{O.min=null,O.max=null})))})}let un=!1,Qn=!1,Yt=[];function _n(){Qn=!1;for(let E=0;E<Yt.length;E++)On(...Yt[E]);Yt.length=0}function qn(){un||(uI(rg),un=!0)}function nc(E,R=!1){un=!0,Qn=R,E(n),rg(),R&&Yt.length>0&&queueMicrotask(_n)}n.batch=nc;function rg(){if(ae&&(Tt(),ae=!1),Te&&(Ce(),Te=!1),we){if(sn(f,ea,Xe),sn(f,"top",ft),sn(f,$l,B),sn(f,jl,Ee),sn(p,ea,Xe),sn(p,"top",ft),sn(p,$l,B),sn(p,jl,Ee),sn(d,$l,gt),sn(d,jl,bt),h.width=Ln(gt*Ht),h.height=Ln(bt*Ht),b.forEach(({_el:E,_show:R,_size:F,_pos:O,side:X})=>{if(E!=null)if(R){let J=X===3||X===0?F:0,le=X%2==1;sn(E,le?"left":"top",O-J),sn(E,le?"width":"height",F),sn(E,le?"top":"left",le?ft:Xe),sn(E,le?"height":"width",le?Ee:B),Dm(E,$r)}else Ii(E,$r)}),Qr=Ks=eo=G=K=$=j=Pe=C=null,Oe=1,ga(!0),Xe!=Se||ft!=zt||B!=$e||Ee!=tt){Et(!1);let E=B/$e,R=Ee/tt;if(ye&&!ne&&he.left>=0){he.left*=E,he.top*=R,no&&Ms(no,Ln(he.left),0,B,Ee),io&&Ms(io,0,Ln(he.top),B,Ee);for(let F=0;F<_t.length;F++){let O=_t[F];O!=null&&(Kt[F]*=E,Kn[F]*=R,Ms(O,Wi(Kt[F]),Wi(Kn[F]),B,Ee))}}if(en.show&&!se&&en.left>=0&&en.width>0){en.left*=E,en.width*=E,en.top*=R,en.height*=R;for(let F in jd)sn(oo,F,en[F])}Se=Xe,zt=ft,$e=B,tt=Ee}On("setSize"),we=!1}gt>0&&bt>0&&(u.clearRect(0,0,h.width,h.height),On("drawClear"),w.forEach(E=>E()),On("draw")),en.show&&se&&(ic(en),se=!1),ye&&ne&&(Tr(null,!0,!1),ne=!1),pe.show&&pe.live&&ge&&(Yd(),ge=!1),l||(l=!0,n.status=1,On("ready")),Js=!1,un=!1}n.redraw=(E,R)=>{Te=R||!1,E!==!1?er(M,I.min,I.max):qn()};function Wd(E,R){let F=x[E];if(F.from==null){if(hn==0){let O=F.range(n,R.min,R.max,E);R.min=O[0],R.max=O[1]}if(R.min>R.max){let O=R.min;R.min=R.max,R.max=O}if(hn>1&&R.min!=null&&R.max!=null&&R.max-R.min<1e-16)return;E==M&&F.distr==2&&hn>0&&(R.min=ns(R.min,e[0]),R.max=ns(R.max,e[0]),R.min==R.max&&R.max++),k[E]=R,ae=!0,qn()}}n.setScale=Wd;let Xd,qd,no,io,og,ag,so,ro,lg,cg,Qt,rn,Qs=!1,zn=he.drag,Dn=zn.x,Fn=zn.y;ye&&(he.x&&(Xd=Gi(F2,p)),he.y&&(qd=Gi(O2,p)),I.ori==0?(no=Xd,io=qd):(no=qd,io=Xd),Qt=he.left,rn=he.top);let en=n.select=Tn({show:!0,over:!0,left:0,width:0,top:0,height:0},i.select),oo=en.show?Gi(D2,en.over?p:f):null;function ic(E,R){if(en.show){for(let F in E)en[F]=E[F],F in jd&&sn(oo,F,E[F]);R!==!1&&On("setSelect")}}n.setSelect=ic;function Ab(E){if(y[E].show)ee&&Dm(at[E],$r);else if(ee&&Ii(at[E],$r),ye){let F=De?_t[0]:_t[E];F!=null&&Ms(F,-10,-10,B,Ee)}}function er(E,R,F){Wd(E,{min:R,max:F})}function as(E,R,F,O){R.focus!=null&&Lb(E),R.show!=null&&y.forEach((X,J)=>{J>0&&(E==J||E==null)&&(X.show=R.show,Ab(J),s==2?(er(X.facets[0].scale,null,null),er(X.facets[1].scale,null,null)):er(X.scale,null,null),qn())}),F!==!1&&On("setSeries",E,R),O&&ya("setSeries",n,E,R)}n.setSeries=as;function Rb(E,R){Tn(T[E],R)}function Cb(E,R){E.fill=It(E.fill||null),E.dir=Ft(E.dir,-1),R=R??T.length,T.splice(R,0,E)}function Pb(E){E==null?T.length=0:T.splice(E,1)}n.addBand=Cb,n.setBand=Rb,n.delBand=Pb;function Ib(E,R){y[E].alpha=R,ye&&_t[E]!=null&&(_t[E].style.opacity=R),ee&&at[E]&&(at[E].style.opacity=R)}let Cs,tr,Sr,ao={focus:!0};function Lb(E){if(E!=Sr){let R=E==null,F=qe.alpha!=1;y.forEach((O,X)=>{if(s==1||X>0){let J=R||X==0||X==E;O._focus=R?null:J,F&&Ib(X,J?1:qe.alpha)}}),Sr=E,F&&qn()}}ee&&dt&&Be(Jx,Le,E=>{he._lock||(ut(E),Sr!=null&&as(null,ao,!0,bn.setSeries))});function ls(E,R,F){let O=x[R];F&&(E=E/Ht-(O.ori==1?ft:Xe));let X=B;O.ori==1&&(X=Ee,E=X-E),O.dir==-1&&(E=X-E);let J=O._min,le=O._max,me=E/X,Ae=J+(le-J)*me,He=O.distr;return He==3?ia(10,Ae):He==4?Q2(Ae,O.asinh):He==100?O.bwd(Ae):Ae}function Nb(E,R){let F=ls(E,M,R);return ns(F,e[0],gn,yn)}n.valToIdx=E=>ns(E,e[0]),n.posToIdx=Nb,n.posToVal=ls,n.valToPos=(E,R,F)=>x[R].ori==0?r(E,x[R],F?Y:B,F?D:0):o(E,x[R],F?fe:Ee,F?A:0),n.setCursor=(E,R,F)=>{Qt=E.left,rn=E.top,Tr(null,R,F)};function hg(E,R){sn(oo,ea,en.left=E),sn(oo,$l,en.width=R)}function ug(E,R){sn(oo,"top",en.top=E),sn(oo,jl,en.height=R)}let pa=I.ori==0?hg:ug,ma=I.ori==1?hg:ug;function Db(){if(ee&&pe.live)for(let E=s==2?1:0;E<y.length;E++){if(E==0&&rt)continue;let R=pe.values[E],F=0;for(let O in R)Ze[E][F++].firstChild.nodeValue=R[O]}}function Yd(E,R){if(E!=null&&(E.idxs?E.idxs.forEach((F,O)=>{te[O]=F}):iI(E.idx)||te.fill(E.idx),pe.idx=te[0]),ee&&pe.live){for(let F=0;F<y.length;F++)(F>0||s==1&&!rt)&&Fb(F,te[F]);Db()}ge=!1,R!==!1&&On("setLegend")}n.setLegend=Yd;function Fb(E,R){let F=y[E],O=E==0&&U==2?xi:e[E],X;rt?X=F.values(n,E,R)??oe:(X=F.value(n,R==null?null:O[R],E,R),X=X==null?oe:{_:X}),pe.values[E]=X}function Tr(E,R,F){lg=Qt,cg=rn,[Qt,rn]=he.move(n,Qt,rn),he.left=Qt,he.top=rn,ye&&(no&&Ms(no,Ln(Qt),0,B,Ee),io&&Ms(io,0,Ln(rn),B,Ee));let O,X=gn>yn;Cs=jt,tr=null;let J=I.ori==0?B:Ee,le=I.ori==1?B:Ee;if(Qt<0||hn==0||X){O=he.idx=null;for(let me=0;me<y.length;me++){let Ae=_t[me];Ae!=null&&Ms(Ae,-10,-10,B,Ee)}dt&&as(null,ao,!0,E==null&&bn.setSeries),pe.live&&(te.fill(O),ge=!0)}else{let me,Ae,He;s==1&&(me=I.ori==0?Qt:rn,Ae=ls(me,M),O=he.idx=ns(Ae,e[0],gn,yn),He=H(e[0][O],I,J,0));let ze=-10,We=-10,vt=0,Ot=0,Dt=!0,Rt="",ct="";for(let Ke=s==2?1:0;Ke<y.length;Ke++){let tn=y[Ke],dn=te[Ke],Un=dn==null?null:s==1?e[Ke][dn]:e[Ke][1][dn],$t=he.dataIdx(n,Ke,O,Ae),fn=$t==null?null:s==1?e[Ke][$t]:e[Ke][1][$t];if(ge=ge||fn!=Un||$t!=dn,te[Ke]=$t,Ke>0&&tn.show){let _i=$t==null?-10:$t==O?He:H(s==1?e[0][$t]:e[Ke][0][$t],I,J,0),ei=fn==null?-10:L(fn,s==1?x[tn.scale]:x[tn.facets[1].scale],le,0);if(dt&&fn!=null){let Di=I.ori==1?Qt:rn,qi=Nn(qe.dist(n,Ke,$t,ei,Di));if(qi<Cs){let cs=qe.bias;if(cs!=0){let bi=ls(Di,tn.scale),Fi=fn>=0?1:-1,Yi=bi>=0?1:-1;Yi==Fi&&(Yi==1?cs==1?fn>=bi:fn<=bi:cs==1?fn<=bi:fn>=bi)&&(Cs=qi,tr=Ke)}else Cs=qi,tr=Ke}}if(ge||De){let Di,qi;I.ori==0?(Di=_i,qi=ei):(Di=ei,qi=_i);let cs,bi,Fi,Yi,hs,ti,Ei=!0,Ar=de.bbox;if(Ar!=null){Ei=!1;let ni=Ar(n,Ke);Fi=ni.left,Yi=ni.top,cs=ni.width,bi=ni.height}else Fi=Di,Yi=qi,cs=bi=de.size(n,Ke);if(ti=de.fill(n,Ke),hs=de.stroke(n,Ke),De)Ke==tr&&Cs<=qe.prox&&(ze=Fi,We=Yi,vt=cs,Ot=bi,Dt=Ei,Rt=ti,ct=hs);else{let ni=_t[Ke];ni!=null&&(Kt[Ke]=Fi,Kn[Ke]=Yi,s_(ni,cs,bi,Ei),n_(ni,ti,hs),Ms(ni,Wi(Fi),Wi(Yi),B,Ee))}}}}if(De){let Ke=qe.prox,tn=Sr==null?Cs<=Ke:Cs>Ke||tr!=Sr;if(ge||tn){let dn=_t[0];dn!=null&&(Kt[0]=ze,Kn[0]=We,s_(dn,vt,Ot,Dt),n_(dn,Rt,ct),Ms(dn,Wi(ze),Wi(We),B,Ee))}}}if(en.show&&Qs)if(E!=null){let[me,Ae]=bn.scales,[He,ze]=bn.match,[We,vt]=E.cursor.sync.scales,Ot=E.cursor.drag;if(Dn=Ot._x,Fn=Ot._y,Dn||Fn){let{left:Dt,top:Rt,width:ct,height:Ke}=E.select,tn=E.scales[We].ori,dn=E.posToVal,Un,$t,fn,_i,ei,Di=me!=null&&He(me,We),qi=Ae!=null&&ze(Ae,vt);Di&&Dn?(tn==0?(Un=Dt,$t=ct):(Un=Rt,$t=Ke),fn=x[me],_i=H(dn(Un,We),fn,J,0),ei=H(dn(Un+$t,We),fn,J,0),pa(is(_i,ei),Nn(ei-_i))):pa(0,J),qi&&Fn?(tn==1?(Un=Dt,$t=ct):(Un=Rt,$t=Ke),fn=x[Ae],_i=L(dn(Un,vt),fn,le,0),ei=L(dn(Un+$t,vt),fn,le,0),ma(is(_i,ei),Nn(ei-_i))):ma(0,le)}else Zd()}else{let me=Nn(lg-og),Ae=Nn(cg-ag);if(I.ori==1){let vt=me;me=Ae,Ae=vt}Dn=zn.x&&me>=zn.dist,Fn=zn.y&&Ae>=zn.dist;let He=zn.uni;He!=null?Dn&&Fn&&(Dn=me>=He,Fn=Ae>=He,!Dn&&!Fn&&(Ae>me?Fn=!0:Dn=!0)):zn.x&&zn.y&&(Dn||Fn)&&(Dn=Fn=!0);let ze,We;Dn&&(I.ori==0?(ze=so,We=Qt):(ze=ro,We=rn),pa(is(ze,We),Nn(We-ze)),Fn||ma(0,le)),Fn&&(I.ori==1?(ze=so,We=Qt):(ze=ro,We=rn),ma(is(ze,We),Nn(We-ze)),Dn||pa(0,J)),!Dn&&!Fn&&(pa(0,0),ma(0,0))}if(zn._x=Dn,zn._y=Fn,E==null){if(F){if(Eg!=null){let[me,Ae]=bn.scales;bn.values[0]=me!=null?ls(I.ori==0?Qt:rn,me):null,bn.values[1]=Ae!=null?ls(I.ori==1?Qt:rn,Ae):null}ya(Tm,n,Qt,rn,B,Ee,O)}if(dt){let me=F&&bn.setSeries,Ae=qe.prox;Sr==null?Cs<=Ae&&as(tr,ao,!0,me):Cs>Ae?as(null,ao,!0,me):tr!=Sr&&as(tr,ao,!0,me)}}ge&&(pe.idx=O,Yd()),R!==!1&&On("setCursor")}let nr=null;Object.defineProperty(n,"rect",{get(){return nr==null&&ga(!1),nr}});function ga(E=!1){E?nr=null:(nr=p.getBoundingClientRect(),On("syncRect",nr))}function dg(E,R,F,O,X,J,le){he._lock||Qs&&E!=null&&E.movementX==0&&E.movementY==0||($d(E,R,F,O,X,J,le,!1,E!=null),E!=null?Tr(null,!0,!0):Tr(R,!0,!1))}function $d(E,R,F,O,X,J,le,me,Ae){if(nr==null&&ga(!1),ut(E),E!=null)F=E.clientX-nr.left,O=E.clientY-nr.top;else{if(F<0||O<0){Qt=-10,rn=-10;return}let[He,ze]=bn.scales,We=R.cursor.sync,[vt,Ot]=We.values,[Dt,Rt]=We.scales,[ct,Ke]=bn.match,tn=R.axes[0].side%2==1,dn=I.ori==0?B:Ee,Un=I.ori==1?B:Ee,$t=tn?J:X,fn=tn?X:J,_i=tn?O:F,ei=tn?F:O;if(Dt!=null?F=ct(He,Dt)?a(vt,x[He],dn,0):-10:F=dn*(_i/$t),Rt!=null?O=Ke(ze,Rt)?a(Ot,x[ze],Un,0):-10:O=Un*(ei/fn),I.ori==1){let Di=F;F=O,O=Di}}Ae&&(R==null||R.cursor.event.type==Tm)&&((F<=1||F>=B-1)&&(F=qr(F,B)),(O<=1||O>=Ee-1)&&(O=qr(O,Ee))),me?(og=F,ag=O,[so,ro]=he.move(n,F,O)):(Qt=F,rn=O)}let jd={width:0,height:0,left:0,top:0};function Zd(){ic(jd,!1)}let fg,pg,mg,gg;function yg(E,R,F,O,X,J,le){Qs=!0,Dn=Fn=zn._x=zn._y=!1,$d(E,R,F,O,X,J,le,!0,!1),E!=null&&(Be(Am,Lm,vg,!1),ya(jx,n,so,ro,B,Ee,null));let{left:me,top:Ae,width:He,height:ze}=en;fg=me,pg=Ae,mg=He,gg=ze}function vg(E,R,F,O,X,J,le){Qs=zn._x=zn._y=!1,$d(E,R,F,O,X,J,le,!1,!0);let{left:me,top:Ae,width:He,height:ze}=en,We=He>0||ze>0,vt=fg!=me||pg!=Ae||mg!=He||gg!=ze;if(We&&vt&&ic(en),zn.setScale&&We&&vt){let Ot=me,Dt=He,Rt=Ae,ct=ze;if(I.ori==1&&(Ot=Ae,Dt=ze,Rt=me,ct=He),Dn&&er(M,ls(Ot,M),ls(Ot+Dt,M)),Fn)for(let Ke in x){let tn=x[Ke];Ke!=M&&tn.from==null&&tn.min!=jt&&er(Ke,ls(Rt+ct,Ke),ls(Rt,Ke))}Zd()}else he.lock&&(he._lock=!he._lock,Tr(R,!0,E!=null));E!=null&&(xt(Am,Lm),ya(Am,n,Qt,rn,B,Ee,null))}function Ob(E,R,F,O,X,J,le){if(he._lock)return;ut(E);let me=Qs;if(Qs){let Ae=!0,He=!0,ze=10,We,vt;I.ori==0?(We=Dn,vt=Fn):(We=Fn,vt=Dn),We&&vt&&(Ae=Qt<=ze||Qt>=B-ze,He=rn<=ze||rn>=Ee-ze),We&&Ae&&(Qt=Qt<so?0:B),vt&&He&&(rn=rn<ro?0:Ee),Tr(null,!0,!0),Qs=!1}Qt=-10,rn=-10,te.fill(null),Tr(null,!0,!0),me&&(Qs=me)}function xg(E,R,F,O,X,J,le){he._lock||(ut(E),fa(),Zd(),E!=null&&ya(Kx,n,Qt,rn,B,Ee,null))}function _g(){b.forEach(xL),z(n.width,n.height,!0)}jr(Ad,na,_g);let lo={};lo.mousedown=yg,lo.mousemove=dg,lo.mouseup=vg,lo.dblclick=xg,lo.setSeries=(E,R,F,O)=>{let X=bn.match[2];F=X(n,R,F),F!=-1&&as(F,O,!0,!1)},ye&&(Be(jx,p,yg),Be(Tm,p,dg),Be(Zx,p,E=>{ut(E),ga(!1)}),Be(Jx,p,Ob),Be(Kx,p,xg),Hm.add(n),n.syncRect=ga);let sc=n.hooks=i.hooks||{};function On(E,R,F){Qn?Yt.push([E,R,F]):E in sc&&sc[E].forEach(O=>{O.call(null,n,R,F)})}(i.plugins||[]).forEach(E=>{for(let R in E.hooks)sc[R]=(sc[R]||[]).concat(E.hooks[R])});let bg=(E,R,F)=>F,bn=Tn({key:null,setSeries:!1,filters:{pub:c_,sub:c_},scales:[M,y[1]?y[1].scale:null],match:[h_,h_,bg],values:[null,null]},he.sync);bn.match.length==2&&bn.match.push(bg),he.sync=bn;let Eg=bn.key,Jd=ob(Eg);function ya(E,R,F,O,X,J,le){bn.filters.pub(E,R,F,O,X,J,le)&&Jd.pub(E,R,F,O,X,J,le)}Jd.sub(n);function Ub(E,R,F,O,X,J,le){bn.filters.sub(E,R,F,O,X,J,le)&&lo[E](null,R,F,O,X,J,le)}n.pub=Ub;function kb(){Jd.unsub(n),Hm.delete(n),st.clear(),Fm(Ad,na,_g),c.remove(),Le?.remove(),On("destroy")}n.destroy=kb;function Kd(){On("init",i,e),da(e||i.data,!1),k[M]?Wd(M,k[M]):fa(),se=en.show&&(en.width>0||en.height>0),ne=ge=!0,z(i.width,i.height)}return y.forEach(Kr),b.forEach(Ss),t?t instanceof HTMLElement?(t.appendChild(c),Kd()):t(n,Kd):Kd(),n}Hn.assign=Tn;Hn.fmtNum=Ym;Hn.rangeNum=Rd;Hn.rangeLog=Id;Hn.rangeAsinh=Xm;Hn.orient=Jr;Hn.pxRatio=Ht;Hn.join=hI;Hn.fmtDate=jm,Hn.tzDate=bI;Hn.sync=ob;{Hn.addGap=iL,Hn.clipGaps=Dd;let i=Hn.paths={points:db};i.linear=pb,i.stepped=oL,i.bars=aL,i.spline=cL}var vb=132,_L=12,kd=class{constructor(e,t,n,s,r){this.columns=e;this.times=t;this.seek=n;this.onChange=s;this.says=r;new ResizeObserver(()=>this.resize()).observe(this.element),matchMedia("(prefers-color-scheme: dark)").addEventListener("change",()=>{this.show(this.names)})}columns;times;seek;onChange;says;element=W("div",{class:"plots"});charts=[];time=0;wish=0;names=[];has(e){return this.names.includes(e)}toggle(e){this.show(this.has(e)?this.names.filter(t=>t!==e):[...this.names,e].slice(-_L))}async show(e){this.names=e;let t=++this.wish,n=[...new Set(e.map(r=>this.columns.unit(r)))],s=await Promise.all(n.map(r=>this.load(r,e.filter(o=>this.columns.unit(o)===r))));if(t===this.wish){for(let r of this.charts)r.plot?.destroy();this.charts=s,this.element.replaceChildren(...s.map(r=>this.frame(r)));for(let r of s)this.draw(r);this.moveTo(this.time),this.onChange()}}moveTo(e){this.time=e;for(let t of this.charts){if(!t.plot)continue;let n=t.plot.valToPos(e,"x"),s=t.holder.querySelector(".now"),r=t.series.map(o=>`${o.label} ${mn(xb(o.times,o.values,e)??NaN,o.scale)}`);t.plot.over.setAttribute("aria-valuenow",String(e)),t.plot.over.setAttribute("aria-valuetext",`${this.says(e)}: ${r.join(", ")}`),s&&(s.style.transform=`translateX(${n}px)`),t.readout.replaceChildren(...t.series.filter(o=>!o.label.startsWith("ghost ")).map(o=>{let a=W("i",{});a.style.background=o.colour;let l=xb(o.times,o.values,e);return W("li",{},a,W("span",{class:"name"},...bs(o.label)),W("b",{},l===null?"–":mn(l,o.scale)),Mn("close",`Remove ${o.label}`,()=>this.toggle(o.label)))}))}}async load(e,t){let n=getComputedStyle(document.documentElement),s={unit:e,names:t,plot:null,holder:W("div",{class:"canvas"}),readout:W("ul",{class:"readout"}),series:[]};for(let[r,o]of t.entries()){let a=n.getPropertyValue(`--tone-${(this.names.indexOf(o)+r*0)%8}`).trim();for(let[l,c]of[this.times.main,this.times.ghost].entries()){if(!c)continue;let h=await this.columns.get(l,o);if(typeof h=="string")continue;let u=Array.from(h,d=>Number.isFinite(d)?d:null);s.series.push({label:l?`ghost ${o}`:o,colour:a,values:u,times:c,scale:Gr(u,e)})}}return s}frame(e){let t=e.series.some(r=>r.label.startsWith("ghost "))?`, dashed: ${this.times.ghostTitle}`:"",n=e.unit&&e.unit!=="1"?`[${e.unit}]`:"[–]",s=this.times.isPath?" over the path of equilibria":"";return W("figure",{class:"chart","aria-label":`${e.names.join(", ")}${s||" over time"}`},W("figcaption",{},n+s+t),e.holder,e.readout)}draw(e){let t=getComputedStyle(document.documentElement),n=h=>t.getPropertyValue(`--${h}`).trim(),s={stroke:n("soft"),grid:{stroke:n("grid"),width:1},ticks:{show:!1},font:`11px ${getComputedStyle(document.body).fontFamily}`},{times:r,values:o}=bL(e);if(!r.length||!e.series.length){e.holder.replaceChildren(W("p",{class:"note"},"No numbers"));return}let a={width:Math.max(e.holder.clientWidth,120),height:vb,legend:{show:!1},cursor:{y:!1,drag:{x:!1,y:!1,setScale:!1},points:{show:!1}},scales:{x:{time:!1},y:{range:(h,u,d)=>EL(u,d)}},axes:[{...s,size:22,gap:3},{...s,size:(h,u)=>14+6.4*Math.max(3,...(u??[]).map(d=>String(d).length)),gap:4,values:(h,u)=>u.map(d=>mn(d,Math.max(...u.map(Math.abs))))}],series:[{},...e.series.map(h=>({stroke:h.colour,width:h.label.startsWith("ghost ")?1:1.6,dash:h.label.startsWith("ghost ")?[5,4]:void 0,spanGaps:!1,pxAlign:0,points:{show:!1}}))],hooks:{ready:[h=>this.listen(h)]}};e.plot=new Hn(a,[r,...o],e.holder);let{over:l}=e.plot;l.append(W("div",{class:"now","aria-hidden":"true"}));let c={role:"slider",tabindex:"0","aria-label":`Moment in the plot of ${e.names.join(", ")}`,"aria-valuemin":String(r[0]),"aria-valuemax":String(r.at(-1))};for(let[h,u]of Object.entries(c))l.setAttribute(h,u)}listen(e){let t=n=>{let s=e.over.getBoundingClientRect();this.seek(e.posToVal(Math.min(Math.max(n.clientX-s.left,0),s.width),"x"))};e.over.addEventListener("pointerdown",n=>{e.over.setPointerCapture(n.pointerId),t(n)}),e.over.addEventListener("pointermove",n=>n.buttons&&t(n))}resize(){for(let e of this.charts){let t=e.holder.clientWidth;e.plot&&t>0&&Math.abs(t-e.plot.width)>1&&e.plot.setSize({width:t,height:vb})}this.moveTo(this.time)}};function bL(i){let e=[...new Set(i.series.map(o=>o.times))];if(e.length<2)return{times:Array.from(e[0]??[]),values:i.series.map(o=>o.values)};let t=Hn.join(e.map(o=>[Array.from(o),...i.series.filter(a=>a.times===o).map(a=>a.values)])),[n,...s]=t,r=e.flatMap(o=>i.series.filter(a=>a.times===o));return{times:n,values:i.series.map(o=>s[r.indexOf(o)])}}function xb(i,e,t){let n=0,s=i.length-1;for(;n<s;){let r=n+s+1>>1;i[r]<=t?n=r:s=r-1}return e[n]??null}function EL(i,e){if(i===null||e===null)return[-1,1];let t=e-i,n=Math.max(Math.abs(i),Math.abs(e),1e-300),s=t>1e-9*n?.08*t:.5*n||1;return[i-s,e+s]}var wL=3,Bd=class{constructor(e,t){this.player=e;let{motion:n}=e,s=n.end-n.start,r=Math.ceil(-Math.log10((s||1)/Math.max(n.count-1,1))+.001);this.digits=Math.min(Math.max(r,n.load?wL:1),6),this.play=Mn("play","Play",()=>e.toggle(),"space"),this.play.classList.add("main-button"),this.slider=W("input",{type:"range",class:"scrub",min:0,max:1,step:"any",value:0,"aria-label":n.load?"Path of equilibria":"Time"}),this.slider.addEventListener("input",()=>{let l=Number(this.slider.value);e.toggle(!1),e.seek(n.start+l*s)}),this.now=W("output",{class:"time","aria-live":"off"}),this.speed=W("select",{"aria-label":"Speed",title:"Speed (+ and −)"},...xa.map(l=>W("option",{value:l},`${l}×`))),this.speed.addEventListener("change",()=>{e.speed=Number(this.speed.value),e.onChange()}),this.loop=Mn("loop","Repeat",()=>{e.loop=!e.loop,e.onChange()},"L");let o=n.load?`${n.count} states`:n.says(n.end,l=>this.inWords(l)),a=W("div",{class:"track"},this.slider,W("div",{class:"ticks","aria-hidden":"true"},...ML(t,n)));this.element=W("footer",{class:"timeline",role:"group","aria-label":"Playback"},W("div",{class:"transport"},Mn("back","One frame back",()=>e.step(-1),"←"),this.play,Mn("forward","One frame on",()=>e.step(1),"→")),W("div",{class:"clock"},this.now,W("span",{class:"of"},` / ${o}`)),a,W("div",{class:"pace"},this.speed,this.loop)),this.refresh(),this.tick()}player;element;play;slider;now;speed;loop;digits;inWords(e){let t=e.toFixed(this.digits);return Number(t)===0?t.replace("-",""):t.replace("-","−")}refresh(){let{player:e}=this;id(this.play,e.playing?"pause":"play",e.playing?"Pause":"Play","space"),this.speed.value=String(e.speed),this.loop.setAttribute("aria-pressed",String(e.loop)),this.play.disabled=e.motion.count<2}tick(){let{start:e,end:t}=this.player.motion,n=t>e?(this.player.time-e)/(t-e):0;this.slider.value=String(n),this.slider.style.setProperty("--share",`${100*n}%`);let s=this.player.motion.says(this.player.time,r=>this.inWords(r));this.now.textContent=s,this.slider.setAttribute("aria-valuetext",s)}};function ML(i,e){let{start:t}=e,n=e.end-t;return i.filter(s=>n>0&&s.time>=t&&s.time<=t+n).map(s=>{let r=W("i",{title:`${s.name}, ${e.says(s.time,o=>o.toPrecision(5))}`});return r.style.left=`${100*(s.time-t)/n}%`,r})}var SL=14,Hd=class{element;buttons=new Map;constructor(e,t){let n=[["Bodies","body",e.bodies.map(a=>({name:a.name,note:"",colour:a.colour}))],["Joints","joint",e.joints.map(a=>({name:a.name,note:a.kind}))],["Forces","force",e.forces.map(a=>({name:a.name,note:a.kind}))],["Drivers","driver",e.drivers.map(a=>({name:a.name,note:""}))],["Couplings","coupling",e.couplings.map(a=>({name:a.name,note:a.kind}))]],s=W("input",{type:"search",class:"search",placeholder:"Find a part","aria-label":"Find a part"});s.addEventListener("input",()=>this.filter(s.value));let r=n.reduce((a,[,,l])=>a+l.length,0),o=n.filter(([,,a])=>a.length).map(([a,l,c])=>W("section",{class:"branch"},W("h3",{},`${a} `,W("span",{class:"count"},String(c.length))),W("ul",{},...this.rows(l==="body"?TL(e):new Map,c,h=>this.button(l,h,t)))));this.element=W("div",{class:"tree"},r>SL&&s,...o)}select(e){for(let[t,n]of this.buttons){let s=!!e&&t===`${e.kind} ${e.name}`;if(n.setAttribute("aria-pressed",String(s)),!s)continue;let r=n.closest("details");r&&(r.open=!0),n.scrollIntoView({block:"nearest"})}}rows(e,t,n){let s=new Map;return t.flatMap((r,o)=>{let a=W("li",{},n(r)),l=e.get(o);if(l===void 0)return[a];let c=s.get(l);if(c)return c.list.append(a),c.count.textContent=String(c.list.childElementCount),[];let h={list:W("ul",{},a),count:W("span",{class:"count"},"1")};return s.set(l,h),[W("li",{},W("details",{},W("summary",{},...bs(l)," ",h.count),h.list))]})}button(e,t,n){let s=W("i",{class:`dot ${e}`});t.colour&&(s.style.background=t.colour);let r=()=>n(a.getAttribute("aria-pressed")==="true"?null:{kind:e,name:t.name}),o=t.note?`${t.name}, ${t.note}`:t.name,a=W("button",{type:"button","aria-label":o,"aria-pressed":"false",onclick:r},s,W("span",{class:"name"},...bs(t.name)),W("small",{},t.note));return this.buttons.set(`${e} ${t.name}`,a),a}filter(e){let t=e.trim().toLowerCase();for(let n of this.buttons.values())n.parentElement.hidden=!n.textContent.toLowerCase().includes(t);for(let n of this.element.querySelectorAll("details")){let s=[...n.querySelectorAll("li")].some(r=>!r.hidden);n.parentElement.hidden=!s,n.open=s&&t!==""}}};function TL(i){return new Map(i.sweeps.flatMap(e=>e.bodies.map(t=>[t,e.name])))}var AL=4e3,RL=400,CL=8,PL=14,ec=class{constructor(e,t,n=!1){this.connection=t;let{content:s,arrays:r}=e,[o,...a]=s.stages;if(!o)throw new Error("there is no machine to show");this.stage=o;let l=W("main",{class:"view"}),c=W("div",{class:"labels","aria-hidden":"true"});document.body.replaceChildren(l),document.title=`${o.name} – nivel`,this.motion=o.motion?new va(o,r):null,this.world=new nd(l,o),this.actor=new Hl(o,r,this.world.look,this.motion,!1);for(let v of a){let g=new va(v,r),m=new Hl(v,r,this.world.look,g,!0);m.root.position.set(...v.origin).sub({x:o.origin[0],y:o.origin[1],z:o.origin[2]}),this.ghosts.push({actor:m,motion:g}),this.world.scene.add(m.root)}if(this.motion){let v=this.ghosts.flatMap(({actor:g,motion:m})=>Kp(g,m).map(y=>y.add(g.root.position)));this.world.see([...Kp(this.actor,this.motion),...v])}this.colours=new Uu(this.actor),this.arrows=new Ou(this.actor,this.world.look),this.traces=new ju(this.actor,this.motion,this.world.look),this.violations=new Ku(this.actor,this.world.look),this.labels=new Wu(this.actor,c),this.labels.shown.body=o.bodies.length<=PL&&s.mode!=="live",this.follower=new Xu(this.world,this.actor),this.handled=new Yu(this.world,this.actor,v=>this.follower.toggle(v)),o.surroundings.length&&this.world.scene.add(Iv(o,r)),this.terrains=o.terrains.map(v=>new Zu(v,r,this.actor));for(let{mesh:v,heaps:g}of this.terrains)this.world.scene.add(v,...g);this.world.scene.add(this.actor.root,this.arrows.root,this.traces.root,this.violations.root),this.compass=new zu(this.world),l.append(c,this.compass.element,this.legend.element);let h=new rc(e,t),u=this.ghosts[0]?.motion.time??null,d={main:this.motion?.time??new Float64Array,ghost:u,ghostTitle:a[0]?.title??"",isPath:!!this.motion?.load};if(this.plots=new kd(h,d,v=>this.goTo(v),()=>this.inspector?.refresh(),v=>this.motion?.says(v,mn)??mn(v)),this.circuit=o.circuit?new ad(o.circuit,h,this.plots):null,this.inspector=new pd(o,h,this.plots,this.traces,{follow:()=>this.followOrFit(),isFollowed:v=>this.follower.name===v.name,change:()=>this.refreshFrame(),canPlay:s.mode==="playback"}),this.tree=new Hd(o,v=>this.choose(v)),this.motion&&s.mode==="playback"&&(this.player=new oc(this.motion),this.timeline=new Bd(this.player,o.moments),this.player.onChange=()=>this.timeline?.refresh(),this.player.onTime=()=>this.showTime()),s.mode==="machine"&&t&&(this.coordinates=new rd(o.coordinates,(v,g)=>{this.handled.move(v),t?.send({type:"move",coordinate:v,value:g})},()=>this.reset())),s.mode==="live"&&t){this.trails=new Ju(this.actor,s.traced,s.gauges.length),this.world.scene.add(this.trails.root),this.actor.show("signs",!1);let v=new _d(s.controls,s.gauges,m=>t.send(m),n,s.parameters),g=new qu(this.world,this.actor,m=>{m.on&&!v.operator.driving&&v.take(!0),t.send(m)});v.onHand=m=>g.isOut=m,this.actor.root.add(g.object),this.live=v,this.hand=g}if(this.circuit&&this.inspector.put(this.circuit.element),o.diagram.length){let v=Fx(o.diagram);this.inspector.put(W("section",{class:"circuits"},W("h3",{},"Block diagram"),sd("Large",v)))}this.dialog=Ux(this.live?.keys??null);let f=W("div",{},this.live?.panel??null,this.coordinates?.element??null,this.inspector.element),p=new od(this).element;this.panels=new Ed(o,a,this.world,{structure:this.tree.element,data:f,display:p},this.timeline?.element??this.live?.bar??null,this.status,()=>this.dialog.showModal()),document.body.append(...this.panels.elements,this.dialog),this.panels.settle(!!this.coordinates||!!this.live,!this.live),this.live&&this.panels.rename("data","Controls and data"),this.world.onBeforeRender=v=>this.beforeRender(v),this.world.onEdges=v=>this.actor.show("edges",v),this.world.onRecolour=()=>this.recolour(),Pv(this.world,this.actor,this.arrows.root,v=>this.choose(v)),kx(this),this.player?this.showTime():this.motion&&this.motion.sample(this.motion.start,this.actor.frame),this.refreshFrame(),this.live&&this.handled.watchAll(),this.world.now=()=>Qp(this.actor),(s.mode==="machine"||this.live)&&(this.world.around=()=>Qp(this.actor)),this.player&&this.plotFirst(h)}connection;stage;world;actor;ghosts=[];motion;terrains;player=null;arrows;colours;traces;violations;labels;compass;plots;follower;handled;legend=new md;timeline=null;tree;inspector;circuit;coordinates=null;live=null;trails=null;hand=null;panels;dialog;status=W("p",{class:"status",role:"status"});picked=null;latest=null;noted=0;came=0;async plotFirst(e){let t=e.list().filter(r=>/\.(angle|displacement)$/.test(r.name)).slice(0,CL),n=await Promise.all(t.map(async r=>IL(await e.get(0,r.name)))),s=t[n.findIndex(r=>r>1e-6*Math.max(...n))]??t[0];s&&this.plots.show([s.name])}goTo(e){this.player?.toggle(!1),this.player?.seek(e)}showTime(){let{player:e,motion:t}=this;if(!(!e||!t)){t.sample(e.time,this.actor.frame),this.actor.time=e.time;for(let n of this.terrains)n.goTo(e.time);for(let n of this.ghosts)n.motion.sample(e.time,n.actor.frame),n.actor.time=e.time,n.actor.apply();this.world.running=e.playing,this.refreshFrame(),this.timeline?.tick(),this.plots.moveTo(e.time),this.inspector.moveTo(e.frame),this.circuit?.moveTo(e.frame)}}take(e){this.latest=e,this.came=performance.now(),this.world.running=!0,this.world.invalidate()}sample(e){this.live?.sample(e),this.trails?.add(e)}deform(e){this.terrains[e.terrain]?.take(e),this.world.invalidate()}message(e){e.type==="note"&&this.note(e.text),e.type==="status"&&this.live?.update(e),e.type==="moved"&&this.coordinates?.update(e.values,this.stage.coordinates,e.problem)}saveTable(e){let t=W("a",{href:URL.createObjectURL(new Blob([e],{type:"text/csv"})),download:`${this.stage.name}.csv`});t.click(),URL.revokeObjectURL(t.href)}say(e){clearTimeout(this.noted),this.status.textContent=e}note(e){this.say(e),this.noted=window.setTimeout(()=>this.say(""),AL)}beforeRender(e){this.player?.advance(e),this.came&&e-this.came>RL&&(this.world.running=!1),this.latest&&(this.actor.frame.set(this.latest.values.subarray(0,this.actor.frame.length)),this.live?.show(this.latest.time,this.latest.values.subarray(this.actor.frame.length)),this.connection?.send({type:"shown",frame:this.latest.number}),this.latest=null,this.refreshFrame(),this.live&&this.colours.spread(),this.hand?.update(),this.handled.keepInSight());let{clientWidth:t,clientHeight:n}=this.world.holder;for(let s of[this.actor,...this.ghosts.map(r=>r.actor)])s.look(this.world.camera,n);this.labels.update(this.world.camera,t,n,!this.world.running),this.compass.update()}refreshFrame(){this.actor.apply();for(let e of this.terrains)e.update();this.legend.show(this.colours.scales()),this.follower.update(),this.arrows.update(),this.violations.update(),this.traces.update(this.player?.frame??0),this.world.invalidate()}choose(e){this.picked=e,this.actor.mark(e,this.world.look),this.tree.select(e),this.inspector.select(e),e&&this.panels.offer("data"),this.refreshFrame()}followOrFit(){this.picked?.kind==="body"?this.follower.toggle(this.picked.name):(this.follower.stop(),this.world.fitNow()),this.inspector.refresh()}look(e){this.follower.stop(),this.world.view(e),this.inspector.refresh()}change(e){e(),this.refreshFrame()}show(e,t){this.change(()=>this.actor.show(e,t))}name(e,t){this.change(()=>this.labels.shown[e]=t)}colour(e){let{ofBeams:t,ofBodies:n,all:s}=this.colours;return t.includes(e)&&this.change(()=>this.colours.beams(e)),n.includes(e)&&this.change(()=>this.colours.bodies(e)),s.includes(e)}bare(e,t){t&&this.world.drawFinely(),document.body.classList.add("bare"),this.panels.close(),this.world.keepFree({left:0,top:0,right:0,bottom:0}),this.world.view(e,!1)}toggleNames(){this.name("body",!this.labels.shown.body)}showGhosts(e){this.change(()=>this.ghosts.forEach(t=>t.actor.root.visible=e))}togglePanel(e){this.panels.toggle(e)}help(){this.dialog.showModal()}escape(){this.dialog.open?this.dialog.close():this.picked?this.choose(null):this.panels.closeTop()}reset(){if(this.live){this.live.say("reset");return}this.connection?.send({type:"reset"})}recolour(){let{look:e}=this.world;this.actor.recolour(e);for(let t of this.ghosts)t.actor.recolour(e);this.arrows.recolour(e),this.traces.recolour(e),this.violations.recolour(e),this.actor.mark(this.picked,e)}};function IL(i){if(typeof i=="string")return 0;let e=1/0,t=-1/0;for(let n of i)n<e&&(e=n),n>t&&(t=n);return Math.max(t-e,0)}var _b=[500,1e3,2e3,4e3],zd=class{constructor(e,t){this.connect=e;this.listener=t;this.open()}connect;listener;socket=null;requests=new Map;lastRequest=0;failures=0;known=null;send(e){this.socket?.readyState===WebSocket.OPEN&&this.socket.send(JSON.stringify(e))}column(e,t){let n=++this.lastRequest;return new Promise(s=>{if(this.socket?.readyState!==WebSocket.OPEN){s("not connected");return}this.requests.set(n,s),this.send({type:"want",request:n,stage:e,name:t})})}open(){let e=this.connect();e.onopen=()=>{this.failures=0,this.listener.onState(!0,0)},e.onmessage=t=>this.receive(t.data),e.onclose=()=>{for(let n of this.requests.values())n("the connection was lost");this.requests.clear();let t=_b[Math.min(this.failures++,_b.length-1)];this.listener.onState(!1,this.failures),this.failures<40&&setTimeout(()=>this.open(),t)},this.socket=e}receive(e){if(typeof e=="string"){let s=JSON.parse(e);s.type==="refused"?this.answer(s.request,s.problem):this.listener.onMessage(s);return}let t=new DataView(e),n=t.getUint32(0,!0);if(n===1)this.receivePackage(new Uint8Array(e,4));else if(n===2){let s=new Float32Array(e,16);this.listener.onFrame({number:t.getUint32(4,!0),time:t.getFloat64(8,!0),values:s})}else n===4?this.listener.onSamples({width:t.getUint32(4,!0),values:new Float64Array(e,8)}):n===6?this.listener.onMoves(kL(e,t)):n===5?this.listener.onTable(new Uint8Array(e,4)):n===3&&this.answer(t.getUint32(4,!0),new Float32Array(e,12))}receivePackage(e){let{known:t}=this;t?(t.length!==e.length||t.some((n,s)=>n!==e[s]))&&this.listener.onOther():(this.known=e.slice(),this.listener.onPackage(e))}answer(e,t){this.requests.get(e)?.(t),this.requests.delete(e)}};function kL(i,e){let[t,n,s]=[4,8,12].map(l=>e.getUint32(l,!0)),r=16+4*n,[o,a]=[new Uint32Array(i,r,s),new Int16Array(i,r+4*s,s)];return{terrain:t,carried:new Float32Array(i,16,n),nodes:o,moves:a}}var bb={f4:Float32Array,f8:Float64Array,u4:Uint32Array,u2:Uint16Array},ng=class{constructor(e){this.block=e}block;floats(e){return this.read(e,"f4")}times(e){return this.read(e,"f8")}indices(e){return this.read(e,"u4")}signed(e){return new Int16Array(this.read(e,"u2").buffer)}rounded({numbers:e,low:t,step:n}){let s=this.read(e,"u2"),r=s.length/t.length,o=new Float32Array(s.length);for(let a=0;a<s.length;a++){let l=Math.floor(a/r);o[a]=t[l]+n[l]*s[a]}return o}read(e,t){if(e.kind!==t)throw new Error(`an array of ${t} was expected, got ${e.kind}`);let n=e.shape.reduce((a,l)=>a*l,1),s=bb[t].BYTES_PER_ELEMENT,r=this.block.subarray(e.start,e.start+n*s);if(r.length!==n*s)throw new Error("the data are cut short");let o=new Uint8Array(n*s);for(let a=0;a<s;a++){let l=r.subarray(a*n,(a+1)*n);for(let c=0;c<n;c++)o[c*s+a]=l[c]}return new bb[t](o.buffer)}};function ig(i){let e=new DataView(i.buffer,i.byteOffset,i.byteLength);if(new TextDecoder().decode(i.subarray(0,4))!=="NVL1")throw new Error("these are no data of a machine");let n=e.getUint32(4,!0),s=JSON.parse(new TextDecoder().decode(i.subarray(8,8+n)));if(s.protocol!==1)throw new Error("page and data are of different versions of nivel");return{content:s,arrays:new ng(i.subarray(8+n))}}async function Vd(i){let e=Uint8Array.from(atob(i.trim()),n=>n.charCodeAt(0)),t=new Blob([e]).stream().pipeThrough(new DecompressionStream("deflate"));return new Uint8Array(await new Response(t).arrayBuffer())}var HL=["program","machine","memory","kernels","package"];function Eb(){return!!document.getElementById("machine")}async function wb(i){let e=HL.map(h=>document.getElementById(h)),[t,n,s,r,o]=await Promise.all(e.map(h=>Vd(h.textContent)));for(let h of e)h.remove();let a=new Worker(URL.createObjectURL(new Blob([t],{type:"text/javascript"}))),l=JSON.parse(new TextDecoder().decode(n)),c={readyState:WebSocket.OPEN,onopen:null,onmessage:null,onclose:null,send:h=>a.postMessage(h)};return a.onerror=h=>i(`The machine cannot run here: ${h.message}.`),a.onmessage=h=>{let u=h.data.problem;u?i(`The machine cannot run here: ${u}.`):c.onmessage?.(h)},setTimeout(()=>{c.onopen?.(),a.postMessage({machine:l,memory:s,kernels:r,package:o})}),c}var zL=3;function sg(i){let e=document.createElement("p");e.className="complaint",e.setAttribute("role","alert"),e.textContent=i,document.body.replaceChildren(e)}function Sb(i){let e=i instanceof Error?i.message:String(i);return/WebGL/i.test(e)?"This browser shows no three-dimensional pictures (WebGL is missing or switched off).":`The machine cannot be shown: ${e}.`}function Tb(i){window.nivel={app:i,bare:(e,t)=>i.bare(e,t),span:()=>[i.motion?.start??0,i.motion?.end??0],pose:e=>(i.goTo(e),new Promise(t=>requestAnimationFrame(()=>requestAnimationFrame(()=>t())))),frames:()=>i.world.frameCount}}function VL(){let i=new URLSearchParams(location.search).get("token"),e=`${location.protocol==="https:"?"wss":"ws"}://${location.host}/stream${i?`?token=${encodeURIComponent(i)}`:""}`,t=new WebSocket(e);return t.binaryType="arraybuffer",t}function Mb(i,e){let t=null,n=new zd(i,{onPackage(s){try{t=new ec(ig(s),n,e),Tb(t)}catch(r){throw sg(Sb(r)),r}},onFrame:s=>t?.take(s),onSamples:s=>t?.sample(s),onMoves:s=>t?.deform(s),onMessage:s=>t?.message(s),onTable:s=>t?.saveTable(s),onOther:()=>location.reload(),onState:(s,r)=>{s||t?.live?.lose(),t?.say(s?"":r<zL?"The connection was lost; it is tried again.":"The program that shows this page has ended; what is here stays.")}})}async function GL(){if(Eb()){let e=await wb(sg);Mb(()=>e,!0);return}let i=document.getElementById("package");if(!i?.textContent?.trim()){Mb(VL,!1);return}try{let e=new ec(ig(await Vd(i.textContent)),null);i.remove(),Tb(e),(location.hash==="#play"||window.name==="play")&&e.player?.toggle(!0)}catch(e){throw sg(Sb(e)),e}}GL();})();
