/* three.js and uPlot: MIT licence, see NOTICE */
"use strict";(()=>{var Kl=class{constructor(e,t){this.opened=e;this.connection=t;this.records=e.content.stages.map(n=>new Map(n.columns.map(s=>[s.name,s])))}opened;connection;known=new Map;records;list(e=0){let t=this.opened.content.stages[e]?.columns??[];return this.connection?t:t.filter(n=>n.values)}unit(e){return this.records[0]?.get(e)?.unit??""}get(e,t){let n=`${e} ${t}`,s=this.known.get(n);if(!s){let r=this.records[e]?.get(t)?.values;r?s=Promise.resolve(this.opened.arrays.floats(r)):this.connection?s=this.connection.column(e,t):s=Promise.resolve("this page does not carry it"),this.known.set(n,s),s.then(o=>typeof o=="string"&&this.known.delete(n))}return s}};var da=class{time;count;layout;load;frames;constructor(e,t){if(!e.motion)throw new Error("there is no motion");this.layout=e.layout,this.time=t.times(e.motion.time),this.count=this.time.length,this.frames=t.floats(e.motion.frames),this.load=e.motion.load?t.times(e.motion.load):null}says(e,t){if(!this.load)return`${t(e)} s`;let n=this.at(e),s=Math.min(n+1,this.count-1),r=this.time[s]-this.time[n],o=r>0?Math.min(Math.max((e-this.time[n])/r,0),1):0;return`load factor ${t(this.load[n]+o*(this.load[s]-this.load[n]))}`}get start(){return this.time[0]??0}get end(){return this.time[this.count-1]??0}at(e){let t=0,n=this.count-1;for(;t<n;){let s=t+n+1>>1;this.time[s]<=e?t=s:n=s-1}return t}value(e,t){return this.frames[e*this.count+t]}sample(e,t){let n=this.at(e),s=Math.min(n+1,this.count-1),r=this.time[s]-this.time[n],o=r>0?Math.min(Math.max((e-this.time[n])/r,0),1):0,{frames:a,count:l}=this;for(let c=0;c<this.layout.width;c++){let h=a[c*l+n];t[c]=o===0?h:h+o*(a[c*l+s]-h)}if(o!==0)for(let c=0;c<this.layout.bodies;c++){let h=7*c+3,u=0;for(let f=h;f<h+4;f++)u+=a[f*l+n]*a[f*l+s];let d=u<0?-1:1;for(let f=h;f<h+4;f++)t[f]=(1-o)*a[f*l+n]+d*o*a[f*l+s]}}};var fa=[.01,.02,.05,.1,.2,.5,1,2,5,10],jl=class{constructor(e){this.motion=e;this.time=e.start}motion;time;playing=!1;speed=1;loop=!0;last=0;onChange=()=>{};onTime=()=>{};get frame(){return this.motion.at(this.time)}toggle(e=!this.playing){e&&!this.loop&&this.time>=this.motion.end&&(this.time=this.motion.start),this.playing=e&&this.motion.count>1&&this.motion.end>this.motion.start,this.last=0,this.onChange(),this.onTime()}seek(e){Number.isFinite(e)&&(this.time=Math.min(Math.max(e,this.motion.start),this.motion.end),this.onTime())}step(e){this.toggle(!1);let t=Math.min(Math.max(this.frame+e,0),this.motion.count-1);this.seek(this.motion.time[t])}faster(e){let t=fa.findIndex(n=>n>=this.speed*.999);this.speed=fa[Math.min(Math.max(t+e,0),fa.length-1)],this.onChange()}advance(e){if(!this.playing)return;let t=this.last?Math.min(e-this.last,250)/1e3:0;this.last=e;let{start:n,end:s}=this.motion,r=this.time+t*this.speed;r>s&&(this.loop?r=n+(r-n)%(s-n):(r=s,this.playing=!1,this.onChange())),this.time=r,this.onTime()}};var fr={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},pr={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},Bg=0,Tf=1,kg=2;var Af=0,mr=1,Hg=2,Oo=3,gr=0,li=1,Sn=2,Dr=0,Bo=1,Rf=2,Cf=3,Pf=4,zg=5;var Nr=100,Vg=101,Gg=102,Wg=103,Xg=104,qg=200,Yg=201,$g=202,Zg=203,If=204,Lf=205,Jg=206,Kg=207,jg=208,Qg=209,e0=210,t0=211,n0=212,i0=213,s0=214,Lc=0,Dc=1,Nc=2,Eo=3,Fc=4,Uc=5,Oc=6,Bc=7,dl=0,r0=1,o0=2,Hi=0,Df=1,Nf=2,Ff=3,Uf=4,Of=5,Bf=6,kf=7;var Hf=300,Fr=301,ko=302,ph=303,mh=304,kc=1e3,ds=1001,Hc=1002,kn=1003,a0=1004;var fl=1005;var oi=1006,gh=1007;var Vs=1008;var yi=1009,zf=1010,Vf=1011,Ho=1012,yh=1013,zi=1014,pi=1015,ji=1016,xh=1017,vh=1018,Ur=1020,Gf=35902,Wf=35899,Xf=1021,qf=1022,Ti=1023,Fs=1026,Gs=1027,_h=1028,pl=1029,yr=1030,bh=1031;var Mh=1033,ml=33776,gl=33777,yl=33778,xl=33779,Sh=35840,Eh=35841,wh=35842,Th=35843,Ah=36196,Rh=37492,Ch=37496,Ph=37488,Ih=37489,vl=37490,Lh=37491,Dh=37808,Nh=37809,Fh=37810,Uh=37811,Oh=37812,Bh=37813,kh=37814,Hh=37815,zh=37816,Vh=37817,Gh=37818,Wh=37819,Xh=37820,qh=37821,Yh=36492,$h=36494,Zh=36495,Jh=36283,Kh=36284,_l=36285,jh=36286;var Ta=2300,zc=2301,Pc=2302,pf=2303,mf=2400,gf=2401,yf=2402;var l0=3200;var bl=0,c0=1,Ws="",wi="srgb",Aa="srgb-linear",Ra="linear",Vt="srgb";var Ic=7680;var h0=519,u0=512,d0=513,f0=514,Yf=515,p0=516,m0=517,$f=518,Zf=519,Jf=35044;var Kf="300 es",Oi=2e3,wo=2001;function x_(i){for(let e=i.length-1;e>=0;--e)if(i[e]>=65535)return!0;return!1}function v_(i){return ArrayBuffer.isView(i)&&!(i instanceof DataView)}function Ca(i){return document.createElementNS("http://www.w3.org/1999/xhtml",i)}function g0(){let i=Ca("canvas");return i.style.display="block",i}var Zm={},To=null;function Pa(...i){let e="THREE."+i.shift();To?To("log",e,...i):console.log(e,...i)}function y0(i){let e=i[0];if(typeof e=="string"&&e.startsWith("TSL:")){let t=i[1];t&&t.isStackTrace?i[0]+=" "+t.getLocation():i[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return i}function it(...i){i=y0(i);let e="THREE."+i.shift();if(To)To("warn",e,...i);else{let t=i[0];t&&t.isStackTrace?console.warn(t.getError(e)):console.warn(e,...i)}}function ht(...i){i=y0(i);let e="THREE."+i.shift();if(To)To("error",e,...i);else{let t=i[0];t&&t.isStackTrace?console.error(t.getError(e)):console.error(e,...i)}}function Ma(...i){let e=i.join(" ");e in Zm||(Zm[e]=!0,it(...i))}function x0(i,e,t){return new Promise(function(n,s){function r(){switch(i.clientWaitSync(e,i.SYNC_FLUSH_COMMANDS_BIT,0)){case i.WAIT_FAILED:s();break;case i.TIMEOUT_EXPIRED:setTimeout(r,t);break;default:n()}}setTimeout(r,t)})}var v0={[Lc]:Lc,[Nc]:Oc,[Fc]:Fc,[Eo]:Uc,[Dc]:Dc,[Oc]:Nc,[Bc]:Bc,[Uc]:Eo},Ji=class{addEventListener(e,t){this._listeners===void 0&&(this._listeners={});let n=this._listeners;n[e]===void 0&&(n[e]=[]),n[e].indexOf(t)===-1&&n[e].push(t)}hasEventListener(e,t){let n=this._listeners;return n===void 0?!1:n[e]!==void 0&&n[e].indexOf(t)!==-1}removeEventListener(e,t){let n=this._listeners;if(n===void 0)return;let s=n[e];if(s!==void 0){let r=s.indexOf(t);r!==-1&&s.splice(r,1)}}dispatchEvent(e){let t=this._listeners;if(t===void 0)return;let n=t[e.type];if(n!==void 0){e.target=this;let s=n.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,e);e.target=null}}},Yn=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],Jm=1234567,Mo=Math.PI/180,Ao=180/Math.PI;function Xs(){let i=Math.random()*4294967295|0,e=Math.random()*4294967295|0,t=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(Yn[i&255]+Yn[i>>8&255]+Yn[i>>16&255]+Yn[i>>24&255]+"-"+Yn[e&255]+Yn[e>>8&255]+"-"+Yn[e>>16&15|64]+Yn[e>>24&255]+"-"+Yn[t&63|128]+Yn[t>>8&255]+"-"+Yn[t>>16&255]+Yn[t>>24&255]+Yn[n&255]+Yn[n>>8&255]+Yn[n>>16&255]+Yn[n>>24&255]).toLowerCase()}function mt(i,e,t){return Math.max(e,Math.min(t,i))}function jf(i,e){return(i%e+e)%e}function __(i,e,t,n,s){return n+(i-e)*(s-n)/(t-e)}function b_(i,e,t){return i!==e?(t-i)/(e-i):0}function Sa(i,e,t){return(1-t)*i+t*e}function M_(i,e,t,n){return Sa(i,e,1-Math.exp(-t*n))}function S_(i,e=1){return e-Math.abs(jf(i,e*2)-e)}function E_(i,e,t){return i<=e?0:i>=t?1:(i=(i-e)/(t-e),i*i*(3-2*i))}function w_(i,e,t){return i<=e?0:i>=t?1:(i=(i-e)/(t-e),i*i*i*(i*(i*6-15)+10))}function T_(i,e){return i+Math.floor(Math.random()*(e-i+1))}function A_(i,e){return i+Math.random()*(e-i)}function R_(i){return i*(.5-Math.random())}function C_(i){i!==void 0&&(Jm=i);let e=Jm+=1831565813;return e=Math.imul(e^e>>>15,e|1),e^=e+Math.imul(e^e>>>7,e|61),((e^e>>>14)>>>0)/4294967296}function P_(i){return i*Mo}function I_(i){return i*Ao}function L_(i){return i>0&&Number.isInteger(i)&&2**Math.round(Math.log2(i))===i}function D_(i){return Math.pow(2,Math.ceil(Math.log(i)/Math.LN2))}function Qf(i){return Math.pow(2,Math.floor(Math.log(i)/Math.LN2))}function N_(i,e,t,n,s){let r=Math.cos,o=Math.sin,a=r(t/2),l=o(t/2),c=r((e+n)/2),h=o((e+n)/2),u=r((e-n)/2),d=o((e-n)/2),f=r((n-e)/2),p=o((n-e)/2);switch(s){case"XYX":i.set(a*h,l*u,l*d,a*c);break;case"YZY":i.set(l*d,a*h,l*u,a*c);break;case"ZXZ":i.set(l*u,l*d,a*h,a*c);break;case"XZX":i.set(a*h,l*p,l*f,a*c);break;case"YXY":i.set(l*f,a*h,l*p,a*c);break;case"ZYZ":i.set(l*p,l*f,a*h,a*c);break;default:it("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function Qh(i){switch(i.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function ep(i,e){if(e.constructor===Float32Array)return i;let t=Qh(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(i/t,-1)}function tp(i,e){if(e.constructor===Float32Array)return i;let t=Qh(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(i*t)}var ci={DEG2RAD:Mo,RAD2DEG:Ao,generateUUID:Xs,clamp:mt,euclideanModulo:jf,mapLinear:__,inverseLerp:b_,lerp:Sa,damp:M_,pingpong:S_,smoothstep:E_,smootherstep:w_,randInt:T_,randFloat:A_,randFloatSpread:R_,seededRandom:C_,degToRad:P_,radToDeg:I_,isPowerOfTwo:L_,ceilPowerOfTwo:D_,floorPowerOfTwo:Qf,setQuaternionFromProperEuler:N_,normalize:tp,denormalize:ep},ue=class{static{this.prototype.isVector2=!0}constructor(e=0,t=0){this.x=e,this.y=t}get width(){return this.x}set width(e){this.x=e}get height(){return this.y}set height(e){this.y=e}set(e,t){return this.x=e,this.y=t,this}setScalar(e){return this.x=e,this.y=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;default:throw new Error("THREE.Vector2: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y)}copy(e){return this.x=e.x,this.y=e.y,this}add(e){return this.x+=e.x,this.y+=e.y,this}addScalar(e){return this.x+=e,this.y+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this}subScalar(e){return this.x-=e,this.y-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this}multiply(e){return this.x*=e.x,this.y*=e.y,this}multiplyScalar(e){return this.x*=e,this.y*=e,this}divide(e){return this.x/=e.x,this.y/=e.y,this}divideScalar(e){return this.multiplyScalar(1/e)}applyMatrix3(e){let t=this.x,n=this.y,s=e.elements;return this.x=s[0]*t+s[3]*n+s[6],this.y=s[1]*t+s[4]*n+s[7],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this}clamp(e,t){return this.x=mt(this.x,e.x,t.x),this.y=mt(this.y,e.y,t.y),this}clampScalar(e,t){return this.x=mt(this.x,e,t),this.y=mt(this.y,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(mt(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(e){return this.x*e.x+this.y*e.y}cross(e){return this.x*e.y-this.y*e.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let n=this.dot(e)/t;return Math.acos(mt(n,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,n=this.y-e.y;return t*t+n*n}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this}equals(e){return e.x===this.x&&e.y===this.y}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this}rotateAround(e,t){let n=Math.cos(t),s=Math.sin(t),r=this.x-e.x,o=this.y-e.y;return this.x=r*n-o*s+e.x,this.y=r*s+o*n+e.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},nt=class{constructor(e=0,t=0,n=0,s=1){this.isQuaternion=!0,this._x=e,this._y=t,this._z=n,this._w=s}static slerpFlat(e,t,n,s,r,o,a){let l=n[s+0],c=n[s+1],h=n[s+2],u=n[s+3],d=r[o+0],f=r[o+1],p=r[o+2],y=r[o+3];if(u!==y||l!==d||c!==f||h!==p){let g=l*d+c*f+h*p+u*y;g<0&&(d=-d,f=-f,p=-p,y=-y,g=-g);let m=1-a;if(g<.9995){let x=Math.acos(g),M=Math.sin(x);m=Math.sin(m*x)/M,a=Math.sin(a*x)/M,l=l*m+d*a,c=c*m+f*a,h=h*m+p*a,u=u*m+y*a}else{l=l*m+d*a,c=c*m+f*a,h=h*m+p*a,u=u*m+y*a;let x=1/Math.sqrt(l*l+c*c+h*h+u*u);l*=x,c*=x,h*=x,u*=x}}e[t]=l,e[t+1]=c,e[t+2]=h,e[t+3]=u}static multiplyQuaternionsFlat(e,t,n,s,r,o){let a=n[s],l=n[s+1],c=n[s+2],h=n[s+3],u=r[o],d=r[o+1],f=r[o+2],p=r[o+3];return e[t]=a*p+h*u+l*f-c*d,e[t+1]=l*p+h*d+c*u-a*f,e[t+2]=c*p+h*f+a*d-l*u,e[t+3]=h*p-a*u-l*d-c*f,e}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get w(){return this._w}set w(e){this._w=e,this._onChangeCallback()}set(e,t,n,s){return this._x=e,this._y=t,this._z=n,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(e){return this._x=e.x,this._y=e.y,this._z=e.z,this._w=e.w,this._onChangeCallback(),this}setFromEuler(e,t=!0){let n=e._x,s=e._y,r=e._z,o=e._order,a=Math.cos,l=Math.sin,c=a(n/2),h=a(s/2),u=a(r/2),d=l(n/2),f=l(s/2),p=l(r/2);switch(o){case"XYZ":this._x=d*h*u+c*f*p,this._y=c*f*u-d*h*p,this._z=c*h*p+d*f*u,this._w=c*h*u-d*f*p;break;case"YXZ":this._x=d*h*u+c*f*p,this._y=c*f*u-d*h*p,this._z=c*h*p-d*f*u,this._w=c*h*u+d*f*p;break;case"ZXY":this._x=d*h*u-c*f*p,this._y=c*f*u+d*h*p,this._z=c*h*p+d*f*u,this._w=c*h*u-d*f*p;break;case"ZYX":this._x=d*h*u-c*f*p,this._y=c*f*u+d*h*p,this._z=c*h*p-d*f*u,this._w=c*h*u+d*f*p;break;case"YZX":this._x=d*h*u+c*f*p,this._y=c*f*u+d*h*p,this._z=c*h*p-d*f*u,this._w=c*h*u-d*f*p;break;case"XZY":this._x=d*h*u-c*f*p,this._y=c*f*u-d*h*p,this._z=c*h*p+d*f*u,this._w=c*h*u+d*f*p;break;default:it("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return t===!0&&this._onChangeCallback(),this}setFromAxisAngle(e,t){let n=t/2,s=Math.sin(n);return this._x=e.x*s,this._y=e.y*s,this._z=e.z*s,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(e){let t=e.elements,n=t[0],s=t[4],r=t[8],o=t[1],a=t[5],l=t[9],c=t[2],h=t[6],u=t[10],d=n+a+u;if(d>0){let f=.5/Math.sqrt(d+1);this._w=.25/f,this._x=(h-l)*f,this._y=(r-c)*f,this._z=(o-s)*f}else if(n>a&&n>u){let f=2*Math.sqrt(1+n-a-u);this._w=(h-l)/f,this._x=.25*f,this._y=(s+o)/f,this._z=(r+c)/f}else if(a>u){let f=2*Math.sqrt(1+a-n-u);this._w=(r-c)/f,this._x=(s+o)/f,this._y=.25*f,this._z=(l+h)/f}else{let f=2*Math.sqrt(1+u-n-a);this._w=(o-s)/f,this._x=(r+c)/f,this._y=(l+h)/f,this._z=.25*f}return this._onChangeCallback(),this}setFromUnitVectors(e,t){let n=e.dot(t)+1;return n<1e-8?(n=0,Math.abs(e.x)>Math.abs(e.z)?(this._x=-e.y,this._y=e.x,this._z=0,this._w=n):(this._x=0,this._y=-e.z,this._z=e.y,this._w=n)):(this._x=e.y*t.z-e.z*t.y,this._y=e.z*t.x-e.x*t.z,this._z=e.x*t.y-e.y*t.x,this._w=n),this.normalize()}angleTo(e){return 2*Math.acos(Math.abs(mt(this.dot(e),-1,1)))}rotateTowards(e,t){let n=this.angleTo(e);if(n===0)return this;let s=Math.min(1,t/n);return this.slerp(e,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(e){return this._x*e._x+this._y*e._y+this._z*e._z+this._w*e._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let e=this.length();return e===0?(this._x=0,this._y=0,this._z=0,this._w=1):(e=1/e,this._x=this._x*e,this._y=this._y*e,this._z=this._z*e,this._w=this._w*e),this._onChangeCallback(),this}multiply(e){return this.multiplyQuaternions(this,e)}premultiply(e){return this.multiplyQuaternions(e,this)}multiplyQuaternions(e,t){let n=e._x,s=e._y,r=e._z,o=e._w,a=t._x,l=t._y,c=t._z,h=t._w;return this._x=n*h+o*a+s*c-r*l,this._y=s*h+o*l+r*a-n*c,this._z=r*h+o*c+n*l-s*a,this._w=o*h-n*a-s*l-r*c,this._onChangeCallback(),this}slerp(e,t){let n=e._x,s=e._y,r=e._z,o=e._w,a=this.dot(e);a<0&&(n=-n,s=-s,r=-r,o=-o,a=-a);let l=1-t;if(a<.9995){let c=Math.acos(a),h=Math.sin(c);l=Math.sin(l*c)/h,t=Math.sin(t*c)/h,this._x=this._x*l+n*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this._onChangeCallback()}else this._x=this._x*l+n*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this.normalize();return this}slerpQuaternions(e,t,n){return this.copy(e).slerp(t,n)}random(){let e=2*Math.PI*Math.random(),t=2*Math.PI*Math.random(),n=Math.random(),s=Math.sqrt(1-n),r=Math.sqrt(n);return this.set(s*Math.sin(e),s*Math.cos(e),r*Math.sin(t),r*Math.cos(t))}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._w===this._w}fromArray(e,t=0){return this._x=e[t],this._y=e[t+1],this._z=e[t+2],this._w=e[t+3],this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._w,e}fromBufferAttribute(e,t){return this._x=e.getX(t),this._y=e.getY(t),this._z=e.getZ(t),this._w=e.getW(t),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},S=class{static{this.prototype.isVector3=!0}constructor(e=0,t=0,n=0){this.x=e,this.y=t,this.z=n}set(e,t,n){return n===void 0&&(n=this.z),this.x=e,this.y=t,this.z=n,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;default:throw new Error("THREE.Vector3: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this}multiplyVectors(e,t){return this.x=e.x*t.x,this.y=e.y*t.y,this.z=e.z*t.z,this}applyEuler(e){return this.applyQuaternion(Km.setFromEuler(e))}applyAxisAngle(e,t){return this.applyQuaternion(Km.setFromAxisAngle(e,t))}applyMatrix3(e){let t=this.x,n=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[3]*n+r[6]*s,this.y=r[1]*t+r[4]*n+r[7]*s,this.z=r[2]*t+r[5]*n+r[8]*s,this}applyNormalMatrix(e){return this.applyMatrix3(e).normalize()}applyMatrix4(e){let t=this.x,n=this.y,s=this.z,r=e.elements,o=1/(r[3]*t+r[7]*n+r[11]*s+r[15]);return this.x=(r[0]*t+r[4]*n+r[8]*s+r[12])*o,this.y=(r[1]*t+r[5]*n+r[9]*s+r[13])*o,this.z=(r[2]*t+r[6]*n+r[10]*s+r[14])*o,this}applyQuaternion(e){let t=this.x,n=this.y,s=this.z,r=e.x,o=e.y,a=e.z,l=e.w,c=2*(o*s-a*n),h=2*(a*t-r*s),u=2*(r*n-o*t);return this.x=t+l*c+o*u-a*h,this.y=n+l*h+a*c-r*u,this.z=s+l*u+r*h-o*c,this}project(e){return this.applyMatrix4(e.matrixWorldInverse).applyMatrix4(e.projectionMatrix)}unproject(e){return this.applyMatrix4(e.projectionMatrixInverse).applyMatrix4(e.matrixWorld)}transformDirection(e){let t=this.x,n=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[4]*n+r[8]*s,this.y=r[1]*t+r[5]*n+r[9]*s,this.z=r[2]*t+r[6]*n+r[10]*s,this.normalize()}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this}divideScalar(e){return this.multiplyScalar(1/e)}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this}clamp(e,t){return this.x=mt(this.x,e.x,t.x),this.y=mt(this.y,e.y,t.y),this.z=mt(this.z,e.z,t.z),this}clampScalar(e,t){return this.x=mt(this.x,e,t),this.y=mt(this.y,e,t),this.z=mt(this.z,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(mt(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this.z=e.z+(t.z-e.z)*n,this}cross(e){return this.crossVectors(this,e)}crossVectors(e,t){let n=e.x,s=e.y,r=e.z,o=t.x,a=t.y,l=t.z;return this.x=s*l-r*a,this.y=r*o-n*l,this.z=n*a-s*o,this}projectOnVector(e){let t=e.lengthSq();if(t===0)return this.set(0,0,0);let n=e.dot(this)/t;return this.copy(e).multiplyScalar(n)}projectOnPlane(e){return Bd.copy(this).projectOnVector(e),this.sub(Bd)}reflect(e){return this.sub(Bd.copy(e).multiplyScalar(2*this.dot(e)))}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let n=this.dot(e)/t;return Math.acos(mt(n,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,n=this.y-e.y,s=this.z-e.z;return t*t+n*n+s*s}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)+Math.abs(this.z-e.z)}setFromSpherical(e){return this.setFromSphericalCoords(e.radius,e.phi,e.theta)}setFromSphericalCoords(e,t,n){let s=Math.sin(t)*e;return this.x=s*Math.sin(n),this.y=Math.cos(t)*e,this.z=s*Math.cos(n),this}setFromCylindrical(e){return this.setFromCylindricalCoords(e.radius,e.theta,e.y)}setFromCylindricalCoords(e,t,n){return this.x=e*Math.sin(t),this.y=n,this.z=e*Math.cos(t),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this}setFromMatrixScale(e){let t=this.setFromMatrixColumn(e,0).length(),n=this.setFromMatrixColumn(e,1).length(),s=this.setFromMatrixColumn(e,2).length();return this.x=t,this.y=n,this.z=s,this}setFromMatrixColumn(e,t){return this.fromArray(e.elements,t*4)}setFromMatrix3Column(e,t){return this.fromArray(e.elements,t*3)}setFromEuler(e){return this.x=e._x,this.y=e._y,this.z=e._z,this}setFromColor(e){return this.x=e.r,this.y=e.g,this.z=e.b,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let e=Math.random()*Math.PI*2,t=Math.random()*2-1,n=Math.sqrt(1-t*t);return this.x=n*Math.cos(e),this.y=t,this.z=n*Math.sin(e),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},Bd=new S,Km=new nt,yt=class{static{this.prototype.isMatrix3=!0}constructor(e,t,n,s,r,o,a,l,c){this.elements=[1,0,0,0,1,0,0,0,1],e!==void 0&&this.set(e,t,n,s,r,o,a,l,c)}set(e,t,n,s,r,o,a,l,c){let h=this.elements;return h[0]=e,h[1]=s,h[2]=a,h[3]=t,h[4]=r,h[5]=l,h[6]=n,h[7]=o,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(e){let t=this.elements,n=e.elements;return t[0]=n[0],t[1]=n[1],t[2]=n[2],t[3]=n[3],t[4]=n[4],t[5]=n[5],t[6]=n[6],t[7]=n[7],t[8]=n[8],this}extractBasis(e,t,n){return e.setFromMatrix3Column(this,0),t.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(e){let t=e.elements;return this.set(t[0],t[4],t[8],t[1],t[5],t[9],t[2],t[6],t[10]),this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let n=e.elements,s=t.elements,r=this.elements,o=n[0],a=n[3],l=n[6],c=n[1],h=n[4],u=n[7],d=n[2],f=n[5],p=n[8],y=s[0],g=s[3],m=s[6],x=s[1],M=s[4],_=s[7],C=s[2],T=s[5],v=s[8];return r[0]=o*y+a*x+l*C,r[3]=o*g+a*M+l*T,r[6]=o*m+a*_+l*v,r[1]=c*y+h*x+u*C,r[4]=c*g+h*M+u*T,r[7]=c*m+h*_+u*v,r[2]=d*y+f*x+p*C,r[5]=d*g+f*M+p*T,r[8]=d*m+f*_+p*v,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[3]*=e,t[6]*=e,t[1]*=e,t[4]*=e,t[7]*=e,t[2]*=e,t[5]*=e,t[8]*=e,this}determinant(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8];return t*o*h-t*a*c-n*r*h+n*a*l+s*r*c-s*o*l}invert(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8],u=h*o-a*c,d=a*l-h*r,f=c*r-o*l,p=t*u+n*d+s*f;if(p===0)return this.set(0,0,0,0,0,0,0,0,0);let y=1/p;return e[0]=u*y,e[1]=(s*c-h*n)*y,e[2]=(a*n-s*o)*y,e[3]=d*y,e[4]=(h*t-s*l)*y,e[5]=(s*r-a*t)*y,e[6]=f*y,e[7]=(n*l-c*t)*y,e[8]=(o*t-n*r)*y,this}transpose(){let e,t=this.elements;return e=t[1],t[1]=t[3],t[3]=e,e=t[2],t[2]=t[6],t[6]=e,e=t[5],t[5]=t[7],t[7]=e,this}getNormalMatrix(e){return this.setFromMatrix4(e).invert().transpose()}transposeIntoArray(e){let t=this.elements;return e[0]=t[0],e[1]=t[3],e[2]=t[6],e[3]=t[1],e[4]=t[4],e[5]=t[7],e[6]=t[2],e[7]=t[5],e[8]=t[8],this}setUvTransform(e,t,n,s,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(n*l,n*c,-n*(l*o+c*a)+o+e,-s*c,s*l,-s*(-c*o+l*a)+a+t,0,0,1),this}scale(e,t){return Ma("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(kd.makeScale(e,t)),this}rotate(e){return Ma("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(kd.makeRotation(-e)),this}translate(e,t){return Ma("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(kd.makeTranslation(e,t)),this}makeTranslation(e,t){return e.isVector2?this.set(1,0,e.x,0,1,e.y,0,0,1):this.set(1,0,e,0,1,t,0,0,1),this}makeRotation(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,-n,0,n,t,0,0,0,1),this}makeScale(e,t){return this.set(e,0,0,0,t,0,0,0,1),this}equals(e){let t=this.elements,n=e.elements;for(let s=0;s<9;s++)if(t[s]!==n[s])return!1;return!0}fromArray(e,t=0){for(let n=0;n<9;n++)this.elements[n]=e[n+t];return this}toArray(e=[],t=0){let n=this.elements;return e[t]=n[0],e[t+1]=n[1],e[t+2]=n[2],e[t+3]=n[3],e[t+4]=n[4],e[t+5]=n[5],e[t+6]=n[6],e[t+7]=n[7],e[t+8]=n[8],e}clone(){return new this.constructor().fromArray(this.elements)}},kd=new yt,jm=new yt().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),Qm=new yt().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function F_(){let i={enabled:!0,workingColorSpace:Aa,spaces:{},convert:function(s,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===Vt&&(s.r=Ns(s.r),s.g=Ns(s.g),s.b=Ns(s.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===Vt&&(s.r=So(s.r),s.g=So(s.g),s.b=So(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===Ws?Ra:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,o){return s.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},e=[.64,.33,.3,.6,.15,.06],t=[.2126,.7152,.0722],n=[.3127,.329];return i.define({[Aa]:{primaries:e,whitePoint:n,transfer:Ra,toXYZ:jm,fromXYZ:Qm,luminanceCoefficients:t,workingColorSpaceConfig:{unpackColorSpace:wi},outputColorSpaceConfig:{drawingBufferColorSpace:wi}},[wi]:{primaries:e,whitePoint:n,transfer:Vt,toXYZ:jm,fromXYZ:Qm,luminanceCoefficients:t,outputColorSpaceConfig:{drawingBufferColorSpace:wi}}}),i}var Ct=F_();function Ns(i){return i<.04045?i*.0773993808:Math.pow(i*.9478672986+.0521327014,2.4)}function So(i){return i<.0031308?i*12.92:1.055*Math.pow(i,.41666)-.055}var ro,Vc=class{static getDataURL(e,t="image/png"){if(/^data:/i.test(e.src)||typeof HTMLCanvasElement>"u")return e.src;let n;if(e instanceof HTMLCanvasElement)n=e;else{ro===void 0&&(ro=Ca("canvas")),ro.width=e.width,ro.height=e.height;let s=ro.getContext("2d");e instanceof ImageData?s.putImageData(e,0,0):s.drawImage(e,0,0,e.width,e.height),n=ro}return n.toDataURL(t)}static sRGBToLinear(e){if(typeof HTMLImageElement<"u"&&e instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&e instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&e instanceof ImageBitmap){let t=Ca("canvas");t.width=e.width,t.height=e.height;let n=t.getContext("2d");n.drawImage(e,0,0,e.width,e.height);let s=n.getImageData(0,0,e.width,e.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=Ns(r[o]/255)*255;return n.putImageData(s,0,0),t}else if(e.data){let t=e.data.slice(0);for(let n=0;n<t.length;n++)t instanceof Uint8Array||t instanceof Uint8ClampedArray?t[n]=Math.floor(Ns(t[n]/255)*255):t[n]=Ns(t[n]);return{data:t,width:e.width,height:e.height}}else return it("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),e}},U_=0,Ro=class{constructor(e=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:U_++}),this.uuid=Xs(),this.data=e,this.dataReady=!0,this.version=0}getSize(e){let t=this.data;return typeof HTMLVideoElement<"u"&&t instanceof HTMLVideoElement?e.set(t.videoWidth,t.videoHeight,0):typeof VideoFrame<"u"&&t instanceof VideoFrame?e.set(t.displayWidth,t.displayHeight,0):t!==null?e.set(t.width||0,t.height||0,t.depth||0):e.set(0,0,0),e}set needsUpdate(e){e===!0&&this.version++}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.images[this.uuid]!==void 0)return e.images[this.uuid];let n={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(Hd(s[o].image)):r.push(Hd(s[o]))}else r=Hd(s);n.url=r}return t||(e.images[this.uuid]=n),n}};function Hd(i){return typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&i instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&i instanceof ImageBitmap?Vc.getDataURL(i):i.data?{data:Array.from(i.data),width:i.width,height:i.height,type:i.data.constructor.name}:(it("Texture: Unable to serialize Texture."),{})}var O_=0,zd=new S,mi=class i extends Ji{constructor(e=i.DEFAULT_IMAGE,t=i.DEFAULT_MAPPING,n=ds,s=ds,r=oi,o=Vs,a=Ti,l=yi,c=i.DEFAULT_ANISOTROPY,h=Ws){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:O_++}),this.uuid=Xs(),this.name="",this.source=new Ro(e),this.mipmaps=[],this.mapping=t,this.channel=0,this.wrapS=n,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new ue(0,0),this.repeat=new ue(1,1),this.center=new ue(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new yt,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(e&&e.depth&&e.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(zd).x}get height(){return this.source.getSize(zd).y}get depth(){return this.source.getSize(zd).z}get image(){return this.source.data}set image(e){this.source.data=e}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(e){return this.name=e.name,this.source=e.source,this.mipmaps=e.mipmaps.slice(0),this.mapping=e.mapping,this.channel=e.channel,this.wrapS=e.wrapS,this.wrapT=e.wrapT,this.magFilter=e.magFilter,this.minFilter=e.minFilter,this.anisotropy=e.anisotropy,this.format=e.format,this.internalFormat=e.internalFormat,this.type=e.type,this.normalized=e.normalized,this.offset.copy(e.offset),this.repeat.copy(e.repeat),this.center.copy(e.center),this.rotation=e.rotation,this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrix.copy(e.matrix),this.generateMipmaps=e.generateMipmaps,this.mipmapsAutoUpdate=e.mipmapsAutoUpdate,this.premultiplyAlpha=e.premultiplyAlpha,this.flipY=e.flipY,this.unpackAlignment=e.unpackAlignment,this.colorSpace=e.colorSpace,this.renderTarget=e.renderTarget,this.isRenderTargetTexture=e.isRenderTargetTexture,this.isPMREMTexture=e.isPMREMTexture,this.isArrayTexture=e.isArrayTexture,this.userData=JSON.parse(JSON.stringify(e.userData)),this.needsUpdate=!0,this}setValues(e){for(let t in e){let n=e[t];if(n===void 0){it(`Texture.setValues(): parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){it(`Texture.setValues(): property '${t}' does not exist.`);continue}s&&n&&s.isVector2&&n.isVector2||s&&n&&s.isVector3&&n.isVector3||s&&n&&s.isMatrix3&&n.isMatrix3?s.copy(n):this[t]=n}}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.textures[this.uuid]!==void 0)return e.textures[this.uuid];let n={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(e).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),t||(e.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(e){if(this.mapping!==Hf)return e;if(e.applyMatrix3(this.matrix),e.x<0||e.x>1)switch(this.wrapS){case kc:e.x=e.x-Math.floor(e.x);break;case ds:e.x=e.x<0?0:1;break;case Hc:Math.abs(Math.floor(e.x)%2)===1?e.x=Math.ceil(e.x)-e.x:e.x=e.x-Math.floor(e.x);break}if(e.y<0||e.y>1)switch(this.wrapT){case kc:e.y=e.y-Math.floor(e.y);break;case ds:e.y=e.y<0?0:1;break;case Hc:Math.abs(Math.floor(e.y)%2)===1?e.y=Math.ceil(e.y)-e.y:e.y=e.y-Math.floor(e.y);break}return this.flipY&&(e.y=1-e.y),e}set needsUpdate(e){e===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(e){e===!0&&this.pmremVersion++}};mi.DEFAULT_IMAGE=null;mi.DEFAULT_MAPPING=Hf;mi.DEFAULT_ANISOTROPY=1;var Gt=class{static{this.prototype.isVector4=!0}constructor(e=0,t=0,n=0,s=1){this.x=e,this.y=t,this.z=n,this.w=s}get width(){return this.z}set width(e){this.z=e}get height(){return this.w}set height(e){this.w=e}set(e,t,n,s){return this.x=e,this.y=t,this.z=n,this.w=s,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this.w=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setW(e){return this.w=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;case 3:this.w=t;break;default:throw new Error("THREE.Vector4: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this.w=e.w!==void 0?e.w:1,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this.w+=e.w,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this.w+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this.w=e.w+t.w,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this.w+=e.w*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this.w-=e.w,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this.w-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this.w=e.w-t.w,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this.w*=e.w,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this.w*=e,this}applyMatrix4(e){let t=this.x,n=this.y,s=this.z,r=this.w,o=e.elements;return this.x=o[0]*t+o[4]*n+o[8]*s+o[12]*r,this.y=o[1]*t+o[5]*n+o[9]*s+o[13]*r,this.z=o[2]*t+o[6]*n+o[10]*s+o[14]*r,this.w=o[3]*t+o[7]*n+o[11]*s+o[15]*r,this}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this.w/=e.w,this}divideScalar(e){return this.multiplyScalar(1/e)}setAxisAngleFromQuaternion(e){this.w=2*Math.acos(e.w);let t=Math.sqrt(1-e.w*e.w);return t<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=e.x/t,this.y=e.y/t,this.z=e.z/t),this}setAxisAngleFromRotationMatrix(e){let t,n,s,r,l=e.elements,c=l[0],h=l[4],u=l[8],d=l[1],f=l[5],p=l[9],y=l[2],g=l[6],m=l[10];if(Math.abs(h-d)<.01&&Math.abs(u-y)<.01&&Math.abs(p-g)<.01){if(Math.abs(h+d)<.1&&Math.abs(u+y)<.1&&Math.abs(p+g)<.1&&Math.abs(c+f+m-3)<.1)return this.set(1,0,0,0),this;t=Math.PI;let M=(c+1)/2,_=(f+1)/2,C=(m+1)/2,T=(h+d)/4,v=(u+y)/4,E=(p+g)/4;return M>_&&M>C?M<.01?(n=0,s=.707106781,r=.707106781):(n=Math.sqrt(M),s=T/n,r=v/n):_>C?_<.01?(n=.707106781,s=0,r=.707106781):(s=Math.sqrt(_),n=T/s,r=E/s):C<.01?(n=.707106781,s=.707106781,r=0):(r=Math.sqrt(C),n=v/r,s=E/r),this.set(n,s,r,t),this}let x=Math.sqrt((g-p)*(g-p)+(u-y)*(u-y)+(d-h)*(d-h));return Math.abs(x)<.001&&(x=1),this.x=(g-p)/x,this.y=(u-y)/x,this.z=(d-h)/x,this.w=Math.acos((c+f+m-1)/2),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this.w=t[15],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this.w=Math.min(this.w,e.w),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this.w=Math.max(this.w,e.w),this}clamp(e,t){return this.x=mt(this.x,e.x,t.x),this.y=mt(this.y,e.y,t.y),this.z=mt(this.z,e.z,t.z),this.w=mt(this.w,e.w,t.w),this}clampScalar(e,t){return this.x=mt(this.x,e,t),this.y=mt(this.y,e,t),this.z=mt(this.z,e,t),this.w=mt(this.w,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(mt(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z+this.w*e.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this.w+=(e.w-this.w)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this.z=e.z+(t.z-e.z)*n,this.w=e.w+(t.w-e.w)*n,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z&&e.w===this.w}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this.w=e[t+3],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e[t+3]=this.w,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this.w=e.getW(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},Gc=class extends Ji{constructor(e=1,t=1,n={}){super(),n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:oi,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},n),this.isRenderTarget=!0,this.width=e,this.height=t,this.depth=n.depth,this.scissor=new Gt(0,0,e,t),this.scissorTest=!1,this.viewport=new Gt(0,0,e,t),this.textures=[];let s=n.count;for(let r=0;r<s;r++)this.textures[r]=new mi({width:e,height:t,depth:n.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(n),this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveColorBuffer=n.resolveColorBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.storeMultisampledColorBuffer=n.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=n.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=n.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=n.depthTexture,this.samples=n.samples,this.multiview=n.multiview,this.useArrayDepthTexture=n.useArrayDepthTexture}_setTextureOptions(e={}){let t={minFilter:oi,generateMipmaps:!1,flipY:!1,internalFormat:null};e.mapping!==void 0&&(t.mapping=e.mapping),e.wrapS!==void 0&&(t.wrapS=e.wrapS),e.wrapT!==void 0&&(t.wrapT=e.wrapT),e.wrapR!==void 0&&(t.wrapR=e.wrapR),e.magFilter!==void 0&&(t.magFilter=e.magFilter),e.minFilter!==void 0&&(t.minFilter=e.minFilter),e.format!==void 0&&(t.format=e.format),e.type!==void 0&&(t.type=e.type),e.anisotropy!==void 0&&(t.anisotropy=e.anisotropy),e.colorSpace!==void 0&&(t.colorSpace=e.colorSpace),e.flipY!==void 0&&(t.flipY=e.flipY),e.generateMipmaps!==void 0&&(t.generateMipmaps=e.generateMipmaps),e.mipmapsAutoUpdate!==void 0&&(t.mipmapsAutoUpdate=e.mipmapsAutoUpdate),e.internalFormat!==void 0&&(t.internalFormat=e.internalFormat);for(let n=0;n<this.textures.length;n++)this.textures[n].setValues(t)}get texture(){return this.textures[0]}set texture(e){this.textures[0]=e}set depthTexture(e){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),e!==null&&e.renderTarget===null&&(e.renderTarget=this),this._depthTexture=e}get depthTexture(){return this._depthTexture}setSize(e,t,n=1){if(this.width!==e||this.height!==t||this.depth!==n){this.width=e,this.height=t,this.depth=n;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=e,this.textures[s].image.height=t,this.textures[s].image.depth=n,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,e,t),this.scissor.set(0,0,e,t)}clone(){return new this.constructor().copy(this)}copy(e){this.width=e.width,this.height=e.height,this.depth=e.depth,this.scissor.copy(e.scissor),this.scissorTest=e.scissorTest,this.viewport.copy(e.viewport),this.textures.length=0;for(let t=0,n=e.textures.length;t<n;t++){this.textures[t]=e.textures[t].clone(),this.textures[t].isRenderTargetTexture=!0,this.textures[t].renderTarget=this;let s=Object.assign({},e.textures[t].image);this.textures[t].source=new Ro(s)}if(this.depthBuffer=e.depthBuffer,this.stencilBuffer=e.stencilBuffer,this.resolveColorBuffer=e.resolveColorBuffer,this.resolveDepthBuffer=e.resolveDepthBuffer,this.resolveStencilBuffer=e.resolveStencilBuffer,this.storeMultisampledColorBuffer=e.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=e.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=e.storeMultisampledStencilBuffer,e.depthTexture!==null)if(e.depthTexture.renderTarget===e){let t=e.depthTexture.clone();t.renderTarget=null,this.depthTexture=t}else this.depthTexture=e.depthTexture;else this.depthTexture=null;return this.samples=e.samples,this.multiview=e.multiview,this.useArrayDepthTexture=e.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},Ai=class extends Gc{constructor(e=1,t=1,n={}){super(e,t,n),this.isWebGLRenderTarget=!0}},Ia=class extends mi{constructor(e=null,t=1,n=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:e,width:t,height:n,depth:s},this.magFilter=kn,this.minFilter=kn,this.wrapR=ds,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}addLayerUpdate(e){this.layerUpdates.add(e)}clearLayerUpdates(){this.layerUpdates.clear()}};var Wc=class extends mi{constructor(e=null,t=1,n=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:e,width:t,height:n,depth:s},this.magFilter=kn,this.minFilter=kn,this.wrapR=ds,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}};var Qe=class i{static{this.prototype.isMatrix4=!0}constructor(e,t,n,s,r,o,a,l,c,h,u,d,f,p,y,g){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],e!==void 0&&this.set(e,t,n,s,r,o,a,l,c,h,u,d,f,p,y,g)}set(e,t,n,s,r,o,a,l,c,h,u,d,f,p,y,g){let m=this.elements;return m[0]=e,m[4]=t,m[8]=n,m[12]=s,m[1]=r,m[5]=o,m[9]=a,m[13]=l,m[2]=c,m[6]=h,m[10]=u,m[14]=d,m[3]=f,m[7]=p,m[11]=y,m[15]=g,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new i().fromArray(this.elements)}copy(e){let t=this.elements,n=e.elements;return t[0]=n[0],t[1]=n[1],t[2]=n[2],t[3]=n[3],t[4]=n[4],t[5]=n[5],t[6]=n[6],t[7]=n[7],t[8]=n[8],t[9]=n[9],t[10]=n[10],t[11]=n[11],t[12]=n[12],t[13]=n[13],t[14]=n[14],t[15]=n[15],this}copyPosition(e){let t=this.elements,n=e.elements;return t[12]=n[12],t[13]=n[13],t[14]=n[14],this}setFromMatrix3(e){let t=e.elements;return this.set(t[0],t[3],t[6],0,t[1],t[4],t[7],0,t[2],t[5],t[8],0,0,0,0,1),this}extractBasis(e,t,n){return this.determinantAffine()===0?(e.set(1,0,0),t.set(0,1,0),n.set(0,0,1),this):(e.setFromMatrixColumn(this,0),t.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this)}makeBasis(e,t,n){return this.set(e.x,t.x,n.x,0,e.y,t.y,n.y,0,e.z,t.z,n.z,0,0,0,0,1),this}extractRotation(e){if(e.determinantAffine()===0)return this.identity();let t=this.elements,n=e.elements,s=1/oo.setFromMatrixColumn(e,0).length(),r=1/oo.setFromMatrixColumn(e,1).length(),o=1/oo.setFromMatrixColumn(e,2).length();return t[0]=n[0]*s,t[1]=n[1]*s,t[2]=n[2]*s,t[3]=0,t[4]=n[4]*r,t[5]=n[5]*r,t[6]=n[6]*r,t[7]=0,t[8]=n[8]*o,t[9]=n[9]*o,t[10]=n[10]*o,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromEuler(e){let t=this.elements,n=e.x,s=e.y,r=e.z,o=Math.cos(n),a=Math.sin(n),l=Math.cos(s),c=Math.sin(s),h=Math.cos(r),u=Math.sin(r);if(e.order==="XYZ"){let d=o*h,f=o*u,p=a*h,y=a*u;t[0]=l*h,t[4]=-l*u,t[8]=c,t[1]=f+p*c,t[5]=d-y*c,t[9]=-a*l,t[2]=y-d*c,t[6]=p+f*c,t[10]=o*l}else if(e.order==="YXZ"){let d=l*h,f=l*u,p=c*h,y=c*u;t[0]=d+y*a,t[4]=p*a-f,t[8]=o*c,t[1]=o*u,t[5]=o*h,t[9]=-a,t[2]=f*a-p,t[6]=y+d*a,t[10]=o*l}else if(e.order==="ZXY"){let d=l*h,f=l*u,p=c*h,y=c*u;t[0]=d-y*a,t[4]=-o*u,t[8]=p+f*a,t[1]=f+p*a,t[5]=o*h,t[9]=y-d*a,t[2]=-o*c,t[6]=a,t[10]=o*l}else if(e.order==="ZYX"){let d=o*h,f=o*u,p=a*h,y=a*u;t[0]=l*h,t[4]=p*c-f,t[8]=d*c+y,t[1]=l*u,t[5]=y*c+d,t[9]=f*c-p,t[2]=-c,t[6]=a*l,t[10]=o*l}else if(e.order==="YZX"){let d=o*l,f=o*c,p=a*l,y=a*c;t[0]=l*h,t[4]=y-d*u,t[8]=p*u+f,t[1]=u,t[5]=o*h,t[9]=-a*h,t[2]=-c*h,t[6]=f*u+p,t[10]=d-y*u}else if(e.order==="XZY"){let d=o*l,f=o*c,p=a*l,y=a*c;t[0]=l*h,t[4]=-u,t[8]=c*h,t[1]=d*u+y,t[5]=o*h,t[9]=f*u-p,t[2]=p*u-f,t[6]=a*h,t[10]=y*u+d}return t[3]=0,t[7]=0,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromQuaternion(e){return this.compose(B_,e,k_)}lookAt(e,t,n){let s=this.elements;return Si.subVectors(e,t),Si.lengthSq()===0&&(Si.z=1),Si.normalize(),tr.crossVectors(n,Si),tr.lengthSq()===0&&(Math.abs(n.z)===1?Si.x+=1e-4:Si.z+=1e-4,Si.normalize(),tr.crossVectors(n,Si)),tr.normalize(),Ql.crossVectors(Si,tr),s[0]=tr.x,s[4]=Ql.x,s[8]=Si.x,s[1]=tr.y,s[5]=Ql.y,s[9]=Si.y,s[2]=tr.z,s[6]=Ql.z,s[10]=Si.z,this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let n=e.elements,s=t.elements,r=this.elements,o=n[0],a=n[4],l=n[8],c=n[12],h=n[1],u=n[5],d=n[9],f=n[13],p=n[2],y=n[6],g=n[10],m=n[14],x=n[3],M=n[7],_=n[11],C=n[15],T=s[0],v=s[4],E=s[8],N=s[12],P=s[1],I=s[5],k=s[9],V=s[13],F=s[2],z=s[6],Y=s[10],G=s[14],ce=s[3],J=s[7],Q=s[11],te=s[15];return r[0]=o*T+a*P+l*F+c*ce,r[4]=o*v+a*I+l*z+c*J,r[8]=o*E+a*k+l*Y+c*Q,r[12]=o*N+a*V+l*G+c*te,r[1]=h*T+u*P+d*F+f*ce,r[5]=h*v+u*I+d*z+f*J,r[9]=h*E+u*k+d*Y+f*Q,r[13]=h*N+u*V+d*G+f*te,r[2]=p*T+y*P+g*F+m*ce,r[6]=p*v+y*I+g*z+m*J,r[10]=p*E+y*k+g*Y+m*Q,r[14]=p*N+y*V+g*G+m*te,r[3]=x*T+M*P+_*F+C*ce,r[7]=x*v+M*I+_*z+C*J,r[11]=x*E+M*k+_*Y+C*Q,r[15]=x*N+M*V+_*G+C*te,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[4]*=e,t[8]*=e,t[12]*=e,t[1]*=e,t[5]*=e,t[9]*=e,t[13]*=e,t[2]*=e,t[6]*=e,t[10]*=e,t[14]*=e,t[3]*=e,t[7]*=e,t[11]*=e,t[15]*=e,this}determinant(){let e=this.elements,t=e[0],n=e[4],s=e[8],r=e[12],o=e[1],a=e[5],l=e[9],c=e[13],h=e[2],u=e[6],d=e[10],f=e[14],p=e[3],y=e[7],g=e[11],m=e[15],x=l*f-c*d,M=a*f-c*u,_=a*d-l*u,C=o*f-c*h,T=o*d-l*h,v=o*u-a*h;return t*(y*x-g*M+m*_)-n*(p*x-g*C+m*T)+s*(p*M-y*C+m*v)-r*(p*_-y*T+g*v)}determinantAffine(){let e=this.elements,t=e[0],n=e[4],s=e[8],r=e[1],o=e[5],a=e[9],l=e[2],c=e[6],h=e[10];return t*(o*h-a*c)-n*(r*h-a*l)+s*(r*c-o*l)}transpose(){let e=this.elements,t;return t=e[1],e[1]=e[4],e[4]=t,t=e[2],e[2]=e[8],e[8]=t,t=e[6],e[6]=e[9],e[9]=t,t=e[3],e[3]=e[12],e[12]=t,t=e[7],e[7]=e[13],e[13]=t,t=e[11],e[11]=e[14],e[14]=t,this}setPosition(e,t,n){let s=this.elements;return e.isVector3?(s[12]=e.x,s[13]=e.y,s[14]=e.z):(s[12]=e,s[13]=t,s[14]=n),this}invert(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8],u=e[9],d=e[10],f=e[11],p=e[12],y=e[13],g=e[14],m=e[15],x=t*a-n*o,M=t*l-s*o,_=t*c-r*o,C=n*l-s*a,T=n*c-r*a,v=s*c-r*l,E=h*y-u*p,N=h*g-d*p,P=h*m-f*p,I=u*g-d*y,k=u*m-f*y,V=d*m-f*g,F=x*V-M*k+_*I+C*P-T*N+v*E;if(F===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let z=1/F;return e[0]=(a*V-l*k+c*I)*z,e[1]=(s*k-n*V-r*I)*z,e[2]=(y*v-g*T+m*C)*z,e[3]=(d*T-u*v-f*C)*z,e[4]=(l*P-o*V-c*N)*z,e[5]=(t*V-s*P+r*N)*z,e[6]=(g*_-p*v-m*M)*z,e[7]=(h*v-d*_+f*M)*z,e[8]=(o*k-a*P+c*E)*z,e[9]=(n*P-t*k-r*E)*z,e[10]=(p*T-y*_+m*x)*z,e[11]=(u*_-h*T-f*x)*z,e[12]=(a*N-o*I-l*E)*z,e[13]=(t*I-n*N+s*E)*z,e[14]=(y*M-p*C-g*x)*z,e[15]=(h*C-u*M+d*x)*z,this}scale(e){let t=this.elements,n=e.x,s=e.y,r=e.z;return t[0]*=n,t[4]*=s,t[8]*=r,t[1]*=n,t[5]*=s,t[9]*=r,t[2]*=n,t[6]*=s,t[10]*=r,t[3]*=n,t[7]*=s,t[11]*=r,this}getMaxScaleOnAxis(){let e=this.elements,t=e[0]*e[0]+e[1]*e[1]+e[2]*e[2],n=e[4]*e[4]+e[5]*e[5]+e[6]*e[6],s=e[8]*e[8]+e[9]*e[9]+e[10]*e[10];return Math.sqrt(Math.max(t,n,s))}makeTranslation(e,t,n){return e.isVector3?this.set(1,0,0,e.x,0,1,0,e.y,0,0,1,e.z,0,0,0,1):this.set(1,0,0,e,0,1,0,t,0,0,1,n,0,0,0,1),this}makeRotationX(e){let t=Math.cos(e),n=Math.sin(e);return this.set(1,0,0,0,0,t,-n,0,0,n,t,0,0,0,0,1),this}makeRotationY(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,0,n,0,0,1,0,0,-n,0,t,0,0,0,0,1),this}makeRotationZ(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,-n,0,0,n,t,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(e,t){let n=Math.cos(t),s=Math.sin(t),r=1-n,o=e.x,a=e.y,l=e.z,c=r*o,h=r*a;return this.set(c*o+n,c*a-s*l,c*l+s*a,0,c*a+s*l,h*a+n,h*l-s*o,0,c*l-s*a,h*l+s*o,r*l*l+n,0,0,0,0,1),this}makeScale(e,t,n){return this.set(e,0,0,0,0,t,0,0,0,0,n,0,0,0,0,1),this}makeShear(e,t,n,s,r,o){return this.set(1,n,r,0,e,1,o,0,t,s,1,0,0,0,0,1),this}compose(e,t,n){let s=this.elements,r=t._x,o=t._y,a=t._z,l=t._w,c=r+r,h=o+o,u=a+a,d=r*c,f=r*h,p=r*u,y=o*h,g=o*u,m=a*u,x=l*c,M=l*h,_=l*u,C=n.x,T=n.y,v=n.z;return s[0]=(1-(y+m))*C,s[1]=(f+_)*C,s[2]=(p-M)*C,s[3]=0,s[4]=(f-_)*T,s[5]=(1-(d+m))*T,s[6]=(g+x)*T,s[7]=0,s[8]=(p+M)*v,s[9]=(g-x)*v,s[10]=(1-(d+y))*v,s[11]=0,s[12]=e.x,s[13]=e.y,s[14]=e.z,s[15]=1,this}decompose(e,t,n){let s=this.elements;e.x=s[12],e.y=s[13],e.z=s[14];let r=this.determinantAffine();if(r===0)return n.set(1,1,1),t.identity(),this;let o=oo.set(s[0],s[1],s[2]).length(),a=oo.set(s[4],s[5],s[6]).length(),l=oo.set(s[8],s[9],s[10]).length();r<0&&(o=-o),Yi.copy(this);let c=1/o,h=1/a,u=1/l;return Yi.elements[0]*=c,Yi.elements[1]*=c,Yi.elements[2]*=c,Yi.elements[4]*=h,Yi.elements[5]*=h,Yi.elements[6]*=h,Yi.elements[8]*=u,Yi.elements[9]*=u,Yi.elements[10]*=u,t.setFromRotationMatrix(Yi),n.x=o,n.y=a,n.z=l,this}makePerspective(e,t,n,s,r,o,a=Oi,l=!1){let c=this.elements,h=2*r/(t-e),u=2*r/(n-s),d=(t+e)/(t-e),f=(n+s)/(n-s),p,y;if(l)p=r/(o-r),y=o*r/(o-r);else if(a===Oi)p=-(o+r)/(o-r),y=-2*o*r/(o-r);else if(a===wo)p=-o/(o-r),y=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=d,c[12]=0,c[1]=0,c[5]=u,c[9]=f,c[13]=0,c[2]=0,c[6]=0,c[10]=p,c[14]=y,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(e,t,n,s,r,o,a=Oi,l=!1){let c=this.elements,h=2/(t-e),u=2/(n-s),d=-(t+e)/(t-e),f=-(n+s)/(n-s),p,y;if(l)p=1/(o-r),y=o/(o-r);else if(a===Oi)p=-2/(o-r),y=-(o+r)/(o-r);else if(a===wo)p=-1/(o-r),y=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=0,c[12]=d,c[1]=0,c[5]=u,c[9]=0,c[13]=f,c[2]=0,c[6]=0,c[10]=p,c[14]=y,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(e){let t=this.elements,n=e.elements;for(let s=0;s<16;s++)if(t[s]!==n[s])return!1;return!0}fromArray(e,t=0){for(let n=0;n<16;n++)this.elements[n]=e[n+t];return this}toArray(e=[],t=0){let n=this.elements;return e[t]=n[0],e[t+1]=n[1],e[t+2]=n[2],e[t+3]=n[3],e[t+4]=n[4],e[t+5]=n[5],e[t+6]=n[6],e[t+7]=n[7],e[t+8]=n[8],e[t+9]=n[9],e[t+10]=n[10],e[t+11]=n[11],e[t+12]=n[12],e[t+13]=n[13],e[t+14]=n[14],e[t+15]=n[15],e}},oo=new S,Yi=new Qe,B_=new S(0,0,0),k_=new S(1,1,1),tr=new S,Ql=new S,Si=new S,eg=new Qe,tg=new nt,fs=class i{constructor(e=0,t=0,n=0,s=i.DEFAULT_ORDER){this.isEuler=!0,this._x=e,this._y=t,this._z=n,this._order=s}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get order(){return this._order}set order(e){this._order=e,this._onChangeCallback()}set(e,t,n,s=this._order){return this._x=e,this._y=t,this._z=n,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(e){return this._x=e._x,this._y=e._y,this._z=e._z,this._order=e._order,this._onChangeCallback(),this}setFromRotationMatrix(e,t=this._order,n=!0){let s=e.elements,r=s[0],o=s[4],a=s[8],l=s[1],c=s[5],h=s[9],u=s[2],d=s[6],f=s[10];switch(t){case"XYZ":this._y=Math.asin(mt(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,f),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(d,c),this._z=0);break;case"YXZ":this._x=Math.asin(-mt(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,f),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(mt(d,-1,1)),Math.abs(d)<.9999999?(this._y=Math.atan2(-u,f),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-mt(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(d,f),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(mt(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,f));break;case"XZY":this._z=Math.asin(-mt(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(d,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,f),this._y=0);break;default:it("Euler: .setFromRotationMatrix() encountered an unknown order: "+t)}return this._order=t,n===!0&&this._onChangeCallback(),this}setFromQuaternion(e,t,n){return eg.makeRotationFromQuaternion(e),this.setFromRotationMatrix(eg,t,n)}setFromVector3(e,t=this._order){return this.set(e.x,e.y,e.z,t)}reorder(e){return tg.setFromEuler(this),this.setFromQuaternion(tg,e)}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._order===this._order}fromArray(e){return this._x=e[0],this._y=e[1],this._z=e[2],e[3]!==void 0&&(this._order=e[3]),this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._order,e}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};fs.DEFAULT_ORDER="XYZ";var Co=class{constructor(){this.mask=1}set(e){this.mask=(1<<e|0)>>>0}enable(e){this.mask|=1<<e|0}enableAll(){this.mask=-1}toggle(e){this.mask^=1<<e|0}disable(e){this.mask&=~(1<<e|0)}disableAll(){this.mask=0}test(e){return(this.mask&e.mask)!==0}isEnabled(e){return(this.mask&(1<<e|0))!==0}},H_=0,ng=new S,ao=new nt,As=new Qe,ec=new S,pa=new S,z_=new S,V_=new nt,ig=new S(1,0,0),sg=new S(0,1,0),rg=new S(0,0,1),og={type:"added"},G_={type:"removed"},lo={type:"childadded",child:null},Vd={type:"childremoved",child:null},cn=class i extends Ji{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:H_++}),this.uuid=Xs(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=i.DEFAULT_UP.clone();let e=new S,t=new fs,n=new nt,s=new S(1,1,1);function r(){n.setFromEuler(t,!1)}function o(){t.setFromQuaternion(n,void 0,!1)}t._onChange(r),n._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:e},rotation:{configurable:!0,enumerable:!0,value:t},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new Qe},normalMatrix:{value:new yt}}),this.matrix=new Qe,this.matrixWorld=new Qe,this.matrixAutoUpdate=i.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=i.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new Co,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(e){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(e),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(e){return this.quaternion.premultiply(e),this}setRotationFromAxisAngle(e,t){this.quaternion.setFromAxisAngle(e,t)}setRotationFromEuler(e){this.quaternion.setFromEuler(e,!0)}setRotationFromMatrix(e){this.quaternion.setFromRotationMatrix(e)}setRotationFromQuaternion(e){this.quaternion.copy(e)}rotateOnAxis(e,t){return ao.setFromAxisAngle(e,t),this.quaternion.multiply(ao),this}rotateOnWorldAxis(e,t){return ao.setFromAxisAngle(e,t),this.quaternion.premultiply(ao),this}rotateX(e){return this.rotateOnAxis(ig,e)}rotateY(e){return this.rotateOnAxis(sg,e)}rotateZ(e){return this.rotateOnAxis(rg,e)}translateOnAxis(e,t){return ng.copy(e).applyQuaternion(this.quaternion),this.position.add(ng.multiplyScalar(t)),this}translateX(e){return this.translateOnAxis(ig,e)}translateY(e){return this.translateOnAxis(sg,e)}translateZ(e){return this.translateOnAxis(rg,e)}localToWorld(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(this.matrixWorld)}worldToLocal(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(As.copy(this.matrixWorld).invert())}lookAt(e,t,n){e.isVector3?ec.copy(e):ec.set(e,t,n);let s=this.parent;this.updateWorldMatrix(!0,!1),pa.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?As.lookAt(pa,ec,this.up):As.lookAt(ec,pa,this.up),this.quaternion.setFromRotationMatrix(As),s&&(As.extractRotation(s.matrixWorld),ao.setFromRotationMatrix(As),this.quaternion.premultiply(ao.invert()))}add(e){if(arguments.length>1){for(let t=0;t<arguments.length;t++)this.add(arguments[t]);return this}return e===this?(ht("Object3D.add: object can't be added as a child of itself.",e),this):(e&&e.isObject3D?(e.removeFromParent(),e.parent=this,this.children.push(e),e.dispatchEvent(og),lo.child=e,this.dispatchEvent(lo),lo.child=null):ht("Object3D.add: object not an instance of THREE.Object3D.",e),this)}remove(e){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}let t=this.children.indexOf(e);return t!==-1&&(e.parent=null,this.children.splice(t,1),e.dispatchEvent(G_),Vd.child=e,this.dispatchEvent(Vd),Vd.child=null),this}removeFromParent(){let e=this.parent;return e!==null&&e.remove(this),this}clear(){return this.remove(...this.children)}attach(e){return this.updateWorldMatrix(!0,!1),As.copy(this.matrixWorld).invert(),e.parent!==null&&(e.parent.updateWorldMatrix(!0,!1),As.multiply(e.parent.matrixWorld)),e.applyMatrix4(As),e.removeFromParent(),e.parent=this,this.children.push(e),e.updateWorldMatrix(!1,!0),e.dispatchEvent(og),lo.child=e,this.dispatchEvent(lo),lo.child=null,this}getObjectById(e){return this.getObjectByProperty("id",e)}getObjectByName(e){return this.getObjectByProperty("name",e)}getObjectByProperty(e,t){if(this[e]===t)return this;for(let n=0,s=this.children.length;n<s;n++){let o=this.children[n].getObjectByProperty(e,t);if(o!==void 0)return o}}getObjectsByProperty(e,t,n=[]){this[e]===t&&n.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(e,t,n);return n}getWorldPosition(e){return this.updateWorldMatrix(!0,!1),e.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(pa,e,z_),e}getWorldScale(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(pa,V_,e),e}getWorldDirection(e){this.updateWorldMatrix(!0,!1);let t=this.matrixWorld.elements;return e.set(t[8],t[9],t[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(e){e(this);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].traverse(e)}traverseVisible(e){if(this.visible===!1)return;e(this);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].traverseVisible(e)}traverseAncestors(e){let t=this.parent;t!==null&&(e(t),t.traverseAncestors(e))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let e=this.pivot;if(e!==null){let t=e.x,n=e.y,s=e.z,r=this.matrix.elements;r[12]+=t-r[0]*t-r[4]*n-r[8]*s,r[13]+=n-r[1]*t-r[5]*n-r[9]*s,r[14]+=s-r[2]*t-r[6]*n-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(e){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||e)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,e=!0);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].updateMatrixWorld(e)}updateWorldMatrix(e,t,n=!1){let s=this.parent;if(e===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||n)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,n=!0),t===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,n)}}toJSON(e){let t=e===void 0||typeof e=="string",n={};t&&(e={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(a=>({...a})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(e),s.indirectTexture=this._indirectTexture.toJSON(e),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(e)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(e)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(e).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(e).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(e.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){let u=l[c];r(e.shapes,u)}else r(e.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(e.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(e.materials,this.material[l]));s.material=a}else s.material=r(e.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(e).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];s.animations.push(r(e.animations,l))}}if(t){let a=o(e.geometries),l=o(e.materials),c=o(e.textures),h=o(e.images),u=o(e.shapes),d=o(e.skeletons),f=o(e.animations),p=o(e.nodes);a.length>0&&(n.geometries=a),l.length>0&&(n.materials=l),c.length>0&&(n.textures=c),h.length>0&&(n.images=h),u.length>0&&(n.shapes=u),d.length>0&&(n.skeletons=d),f.length>0&&(n.animations=f),p.length>0&&(n.nodes=p)}return n.object=s,n;function o(a){let l=[];for(let c in a){let h=a[c];delete h.metadata,l.push(h)}return l}}clone(e){return new this.constructor().copy(this,e)}copy(e,t=!0){if(this.name=e.name,this.up.copy(e.up),this.position.copy(e.position),this.rotation.order=e.rotation.order,this.quaternion.copy(e.quaternion),this.scale.copy(e.scale),this.pivot=e.pivot!==null?e.pivot.clone():null,this.matrix.copy(e.matrix),this.matrixWorld.copy(e.matrixWorld),this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrixWorldAutoUpdate=e.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=e.matrixWorldNeedsUpdate,this.layers.mask=e.layers.mask,this.visible=e.visible,this.castShadow=e.castShadow,this.receiveShadow=e.receiveShadow,this.frustumCulled=e.frustumCulled,this.renderOrder=e.renderOrder,this.static=e.static,this.animations=e.animations.slice(),this.userData=JSON.parse(JSON.stringify(e.userData)),t===!0)for(let n=0;n<e.children.length;n++){let s=e.children[n];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};cn.DEFAULT_UP=new S(0,1,0);cn.DEFAULT_MATRIX_AUTO_UPDATE=!0;cn.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var Dt=class extends cn{constructor(){super(),this.isGroup=!0,this.type="Group"}},W_={type:"move"},Po=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Dt,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Dt,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new S,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new S),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Dt,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new S,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new S,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(e){return this._targetRay!==null&&this._targetRay.dispatchEvent(e),this._grip!==null&&this._grip.dispatchEvent(e),this._hand!==null&&this._hand.dispatchEvent(e),this}connect(e){if(e&&e.hand){let t=this._hand;if(t)for(let n of e.hand.values())this._getHandJoint(t,n)}return this.dispatchEvent({type:"connected",data:e}),this}disconnect(e){return this.dispatchEvent({type:"disconnected",data:e}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(e,t,n){let s=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(e&&t.session.visibilityState!=="visible-blurred"){if(c&&e.hand){o=!0;for(let y of e.hand.values()){let g=t.getJointPose(y,n),m=this._getHandJoint(c,y);g!==null&&(m.matrix.fromArray(g.transform.matrix),m.matrix.decompose(m.position,m.quaternion,m.scale),m.matrixWorldNeedsUpdate=!0,m.jointRadius=g.radius),m.visible=g!==null}let h=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],d=h.position.distanceTo(u.position),f=.02,p=.005;c.inputState.pinching&&d>f+p?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:e.handedness,target:this})):!c.inputState.pinching&&d<=f-p&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:e.handedness,target:this}))}else l!==null&&e.gripSpace&&(r=t.getPose(e.gripSpace,n),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:e,target:this})));a!==null&&(s=t.getPose(e.targetRaySpace,n),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(W_)))}return a!==null&&(a.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(e,t){if(e.joints[t.jointName]===void 0){let n=new Dt;n.matrixAutoUpdate=!1,n.visible=!1,e.joints[t.jointName]=n,e.add(n)}return e.joints[t.jointName]}},_0={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},nr={h:0,s:0,l:0},tc={h:0,s:0,l:0};function Gd(i,e,t){return t<0&&(t+=1),t>1&&(t-=1),t<1/6?i+(e-i)*6*t:t<1/2?e:t<2/3?i+(e-i)*6*(2/3-t):i}var et=class{constructor(e,t,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(e,t,n)}set(e,t,n){if(t===void 0&&n===void 0){let s=e;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(e,t,n);return this}setScalar(e){return this.r=e,this.g=e,this.b=e,this}setHex(e,t=wi){return e=Math.floor(e),this.r=(e>>16&255)/255,this.g=(e>>8&255)/255,this.b=(e&255)/255,Ct.colorSpaceToWorking(this,t),this}setRGB(e,t,n,s=Ct.workingColorSpace){return this.r=e,this.g=t,this.b=n,Ct.colorSpaceToWorking(this,s),this}setHSL(e,t,n,s=Ct.workingColorSpace){if(e=jf(e,1),t=mt(t,0,1),n=mt(n,0,1),t===0)this.r=this.g=this.b=n;else{let r=n<=.5?n*(1+t):n+t-n*t,o=2*n-r;this.r=Gd(o,r,e+1/3),this.g=Gd(o,r,e),this.b=Gd(o,r,e-1/3)}return Ct.colorSpaceToWorking(this,s),this}setStyle(e,t=wi){function n(r){r!==void 0&&parseFloat(r)<1&&it("Color: Alpha component of "+e+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(e)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,t);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,t);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,t);break;default:it("Color: Unknown color model "+e)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(e)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,t);if(o===6)return this.setHex(parseInt(r,16),t);it("Color: Invalid hex color "+e)}else if(e&&e.length>0)return this.setColorName(e,t);return this}setColorName(e,t=wi){let n=_0[e.toLowerCase()];return n!==void 0?this.setHex(n,t):it("Color: Unknown color "+e),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(e){return this.r=e.r,this.g=e.g,this.b=e.b,this}copySRGBToLinear(e){return this.r=Ns(e.r),this.g=Ns(e.g),this.b=Ns(e.b),this}copyLinearToSRGB(e){return this.r=So(e.r),this.g=So(e.g),this.b=So(e.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(e=wi){return Ct.workingToColorSpace($n.copy(this),e),Math.round(mt($n.r*255,0,255))*65536+Math.round(mt($n.g*255,0,255))*256+Math.round(mt($n.b*255,0,255))}getHexString(e=wi){return("000000"+this.getHex(e).toString(16)).slice(-6)}getHSL(e,t=Ct.workingColorSpace){Ct.workingToColorSpace($n.copy(this),t);let n=$n.r,s=$n.g,r=$n.b,o=Math.max(n,s,r),a=Math.min(n,s,r),l,c,h=(a+o)/2;if(a===o)l=0,c=0;else{let u=o-a;switch(c=h<=.5?u/(o+a):u/(2-o-a),o){case n:l=(s-r)/u+(s<r?6:0);break;case s:l=(r-n)/u+2;break;case r:l=(n-s)/u+4;break}l/=6}return e.h=l,e.s=c,e.l=h,e}getRGB(e,t=Ct.workingColorSpace){return Ct.workingToColorSpace($n.copy(this),t),e.r=$n.r,e.g=$n.g,e.b=$n.b,e}getStyle(e=wi){Ct.workingToColorSpace($n.copy(this),e);let t=$n.r,n=$n.g,s=$n.b;return e!==wi?`color(${e} ${t.toFixed(3)} ${n.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(t*255)},${Math.round(n*255)},${Math.round(s*255)})`}offsetHSL(e,t,n){return this.getHSL(nr),this.setHSL(nr.h+e,nr.s+t,nr.l+n)}add(e){return this.r+=e.r,this.g+=e.g,this.b+=e.b,this}addColors(e,t){return this.r=e.r+t.r,this.g=e.g+t.g,this.b=e.b+t.b,this}addScalar(e){return this.r+=e,this.g+=e,this.b+=e,this}sub(e){return this.r=Math.max(0,this.r-e.r),this.g=Math.max(0,this.g-e.g),this.b=Math.max(0,this.b-e.b),this}multiply(e){return this.r*=e.r,this.g*=e.g,this.b*=e.b,this}multiplyScalar(e){return this.r*=e,this.g*=e,this.b*=e,this}lerp(e,t){return this.r+=(e.r-this.r)*t,this.g+=(e.g-this.g)*t,this.b+=(e.b-this.b)*t,this}lerpColors(e,t,n){return this.r=e.r+(t.r-e.r)*n,this.g=e.g+(t.g-e.g)*n,this.b=e.b+(t.b-e.b)*n,this}lerpHSL(e,t){this.getHSL(nr),e.getHSL(tc);let n=Sa(nr.h,tc.h,t),s=Sa(nr.s,tc.s,t),r=Sa(nr.l,tc.l,t);return this.setHSL(n,s,r),this}setFromVector3(e){return this.r=e.x,this.g=e.y,this.b=e.z,this}applyMatrix3(e){let t=this.r,n=this.g,s=this.b,r=e.elements;return this.r=r[0]*t+r[3]*n+r[6]*s,this.g=r[1]*t+r[4]*n+r[7]*s,this.b=r[2]*t+r[5]*n+r[8]*s,this}equals(e){return e.r===this.r&&e.g===this.g&&e.b===this.b}fromArray(e,t=0){return this.r=e[t],this.g=e[t+1],this.b=e[t+2],this}toArray(e=[],t=0){return e[t]=this.r,e[t+1]=this.g,e[t+2]=this.b,e}fromBufferAttribute(e,t){return this.r=e.getX(t),this.g=e.getY(t),this.b=e.getZ(t),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},$n=new et;et.NAMES=_0;var La=class extends cn{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new fs,this.environmentIntensity=1,this.environmentRotation=new fs,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(e,t){return super.copy(e,t),this.background=e.background!==null?e.background.clone():null,this.environment=e.environment!==null?e.environment.clone():null,this.fog=e.fog!==null?e.fog.clone():null,this.backgroundBlurriness=e.backgroundBlurriness,this.backgroundIntensity=e.backgroundIntensity,this.backgroundRotation.copy(e.backgroundRotation),this.environmentIntensity=e.environmentIntensity,this.environmentRotation.copy(e.environmentRotation),this.overrideMaterial=e.overrideMaterial!==null?e.overrideMaterial.clone():null,this.matrixAutoUpdate=e.matrixAutoUpdate,this}toJSON(e){let t=super.toJSON(e);return this.fog!==null&&(t.object.fog=this.fog.toJSON()),t.object.backgroundBlurriness=this.backgroundBlurriness,t.object.backgroundIntensity=this.backgroundIntensity,t.object.backgroundRotation=this.backgroundRotation.toArray(),t.object.environmentIntensity=this.environmentIntensity,t.object.environmentRotation=this.environmentRotation.toArray(),t}},$i=new S,Rs=new S,Wd=new S,Cs=new S,co=new S,ho=new S,ag=new S,Xd=new S,qd=new S,Yd=new S,$d=new Gt,Zd=new Gt,Jd=new Gt,Ls=class i{constructor(e=new S,t=new S,n=new S){this.a=e,this.b=t,this.c=n}static getNormal(e,t,n,s){s.subVectors(n,t),$i.subVectors(e,t),s.cross($i);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(e,t,n,s,r){$i.subVectors(s,t),Rs.subVectors(n,t),Wd.subVectors(e,t);let o=$i.dot($i),a=$i.dot(Rs),l=$i.dot(Wd),c=Rs.dot(Rs),h=Rs.dot(Wd),u=o*c-a*a;if(u===0)return r.set(0,0,0),null;let d=1/u,f=(c*l-a*h)*d,p=(o*h-a*l)*d;return r.set(1-f-p,p,f)}static containsPoint(e,t,n,s){return this.getBarycoord(e,t,n,s,Cs)===null?!1:Cs.x>=0&&Cs.y>=0&&Cs.x+Cs.y<=1}static getInterpolation(e,t,n,s,r,o,a,l){return this.getBarycoord(e,t,n,s,Cs)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,Cs.x),l.addScaledVector(o,Cs.y),l.addScaledVector(a,Cs.z),l)}static getInterpolatedAttribute(e,t,n,s,r,o){return $d.setScalar(0),Zd.setScalar(0),Jd.setScalar(0),$d.fromBufferAttribute(e,t),Zd.fromBufferAttribute(e,n),Jd.fromBufferAttribute(e,s),o.setScalar(0),o.addScaledVector($d,r.x),o.addScaledVector(Zd,r.y),o.addScaledVector(Jd,r.z),o}static isFrontFacing(e,t,n,s){return $i.subVectors(n,t),Rs.subVectors(e,t),$i.cross(Rs).dot(s)<0}set(e,t,n){return this.a.copy(e),this.b.copy(t),this.c.copy(n),this}setFromPointsAndIndices(e,t,n,s){return this.a.copy(e[t]),this.b.copy(e[n]),this.c.copy(e[s]),this}setFromAttributeAndIndices(e,t,n,s){return this.a.fromBufferAttribute(e,t),this.b.fromBufferAttribute(e,n),this.c.fromBufferAttribute(e,s),this}clone(){return new this.constructor().copy(this)}copy(e){return this.a.copy(e.a),this.b.copy(e.b),this.c.copy(e.c),this}getArea(){return $i.subVectors(this.c,this.b),Rs.subVectors(this.a,this.b),$i.cross(Rs).length()*.5}getMidpoint(e){return e.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(e){return i.getNormal(this.a,this.b,this.c,e)}getPlane(e){return e.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(e,t){return i.getBarycoord(e,this.a,this.b,this.c,t)}getInterpolation(e,t,n,s,r){return i.getInterpolation(e,this.a,this.b,this.c,t,n,s,r)}containsPoint(e){return i.containsPoint(e,this.a,this.b,this.c)}isFrontFacing(e){return i.isFrontFacing(this.a,this.b,this.c,e)}intersectsBox(e){return e.intersectsTriangle(this)}closestPointToPoint(e,t){let n=this.a,s=this.b,r=this.c,o,a;co.subVectors(s,n),ho.subVectors(r,n),Xd.subVectors(e,n);let l=co.dot(Xd),c=ho.dot(Xd);if(l<=0&&c<=0)return t.copy(n);qd.subVectors(e,s);let h=co.dot(qd),u=ho.dot(qd);if(h>=0&&u<=h)return t.copy(s);let d=l*u-h*c;if(d<=0&&l>=0&&h<=0&&l-h>0)return o=l/(l-h),t.copy(n).addScaledVector(co,o);Yd.subVectors(e,r);let f=co.dot(Yd),p=ho.dot(Yd);if(p>=0&&f<=p)return t.copy(r);let y=f*c-l*p;if(y<=0&&c>=0&&p<=0)return a=c/(c-p),t.copy(n).addScaledVector(ho,a);let g=h*p-f*u;if(g<=0&&u-h>=0&&f-p>=0)return ag.subVectors(r,s),a=(u-h)/(u-h+(f-p)),t.copy(s).addScaledVector(ag,a);let m=1/(g+y+d);return o=y*m,a=d*m,t.copy(n).addScaledVector(co,o).addScaledVector(ho,a)}equals(e){return e.a.equals(this.a)&&e.b.equals(this.b)&&e.c.equals(this.c)}},Ot=class{constructor(e=new S(1/0,1/0,1/0),t=new S(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=e,this.max=t}set(e,t){return this.min.copy(e),this.max.copy(t),this}setFromArray(e){this.makeEmpty();for(let t=0,n=e.length;t<n;t+=3)this.expandByPoint(Zi.fromArray(e,t));return this}setFromBufferAttribute(e){this.makeEmpty();for(let t=0,n=e.count;t<n;t++)this.expandByPoint(Zi.fromBufferAttribute(e,t));return this}setFromPoints(e){this.makeEmpty();for(let t=0,n=e.length;t<n;t++)this.expandByPoint(e[t]);return this}setFromCenterAndSize(e,t){let n=Zi.copy(t).multiplyScalar(.5);return this.min.copy(e).sub(n),this.max.copy(e).add(n),this}setFromObject(e,t=!1){return this.makeEmpty(),this.expandByObject(e,t)}clone(){return new this.constructor().copy(this)}copy(e){return this.min.copy(e.min),this.max.copy(e.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(e){return this.isEmpty()?e.set(0,0,0):e.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(e){return this.isEmpty()?e.set(0,0,0):e.subVectors(this.max,this.min)}expandByPoint(e){return this.min.min(e),this.max.max(e),this}expandByVector(e){return this.min.sub(e),this.max.add(e),this}expandByScalar(e){return this.min.addScalar(-e),this.max.addScalar(e),this}expandByObject(e,t=!1){e.updateWorldMatrix(!1,!1);let n=e.geometry;if(n!==void 0){let r=n.getAttribute("position");if(t===!0&&r!==void 0&&e.isInstancedMesh!==!0&&e.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)e.isMesh===!0?e.getVertexPosition(o,Zi):Zi.fromBufferAttribute(r,o),Zi.applyMatrix4(e.matrixWorld),this.expandByPoint(Zi);else e.boundingBox!==void 0?(e.boundingBox===null&&e.computeBoundingBox(),nc.copy(e.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),nc.copy(n.boundingBox)),nc.applyMatrix4(e.matrixWorld),this.union(nc)}let s=e.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],t);return this}containsPoint(e){return e.x>=this.min.x&&e.x<=this.max.x&&e.y>=this.min.y&&e.y<=this.max.y&&e.z>=this.min.z&&e.z<=this.max.z}containsBox(e){return this.min.x<=e.min.x&&e.max.x<=this.max.x&&this.min.y<=e.min.y&&e.max.y<=this.max.y&&this.min.z<=e.min.z&&e.max.z<=this.max.z}getParameter(e,t){return t.set((e.x-this.min.x)/(this.max.x-this.min.x),(e.y-this.min.y)/(this.max.y-this.min.y),(e.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(e){return e.max.x>=this.min.x&&e.min.x<=this.max.x&&e.max.y>=this.min.y&&e.min.y<=this.max.y&&e.max.z>=this.min.z&&e.min.z<=this.max.z}intersectsSphere(e){return this.clampPoint(e.center,Zi),Zi.distanceToSquared(e.center)<=e.radius*e.radius}intersectsPlane(e){let t,n;return e.normal.x>0?(t=e.normal.x*this.min.x,n=e.normal.x*this.max.x):(t=e.normal.x*this.max.x,n=e.normal.x*this.min.x),e.normal.y>0?(t+=e.normal.y*this.min.y,n+=e.normal.y*this.max.y):(t+=e.normal.y*this.max.y,n+=e.normal.y*this.min.y),e.normal.z>0?(t+=e.normal.z*this.min.z,n+=e.normal.z*this.max.z):(t+=e.normal.z*this.max.z,n+=e.normal.z*this.min.z),t<=-e.constant&&n>=-e.constant}intersectsTriangle(e){if(this.isEmpty())return!1;this.getCenter(ma),ic.subVectors(this.max,ma),uo.subVectors(e.a,ma),fo.subVectors(e.b,ma),po.subVectors(e.c,ma),ir.subVectors(fo,uo),sr.subVectors(po,fo),wr.subVectors(uo,po);let t=[0,-ir.z,ir.y,0,-sr.z,sr.y,0,-wr.z,wr.y,ir.z,0,-ir.x,sr.z,0,-sr.x,wr.z,0,-wr.x,-ir.y,ir.x,0,-sr.y,sr.x,0,-wr.y,wr.x,0];return!Kd(t,uo,fo,po,ic)||(t=[1,0,0,0,1,0,0,0,1],!Kd(t,uo,fo,po,ic))?!1:(sc.crossVectors(ir,sr),t=[sc.x,sc.y,sc.z],Kd(t,uo,fo,po,ic))}clampPoint(e,t){return t.copy(e).clamp(this.min,this.max)}distanceToPoint(e){return this.clampPoint(e,Zi).distanceTo(e)}getBoundingSphere(e){return this.isEmpty()?e.makeEmpty():(this.getCenter(e.center),e.radius=this.getSize(Zi).length()*.5),e}intersect(e){return this.min.max(e.min),this.max.min(e.max),this.isEmpty()&&this.makeEmpty(),this}union(e){return this.min.min(e.min),this.max.max(e.max),this}applyMatrix4(e){return this.isEmpty()?this:(Ps[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(e),Ps[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(e),Ps[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(e),Ps[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(e),Ps[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(e),Ps[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(e),Ps[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(e),Ps[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(e),this.setFromPoints(Ps),this)}translate(e){return this.min.add(e),this.max.add(e),this}equals(e){return e.min.equals(this.min)&&e.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(e){return this.min.fromArray(e.min),this.max.fromArray(e.max),this}},Ps=[new S,new S,new S,new S,new S,new S,new S,new S],Zi=new S,nc=new Ot,uo=new S,fo=new S,po=new S,ir=new S,sr=new S,wr=new S,ma=new S,ic=new S,sc=new S,Tr=new S;function Kd(i,e,t,n,s){for(let r=0,o=i.length-3;r<=o;r+=3){Tr.fromArray(i,r);let a=s.x*Math.abs(Tr.x)+s.y*Math.abs(Tr.y)+s.z*Math.abs(Tr.z),l=e.dot(Tr),c=t.dot(Tr),h=n.dot(Tr);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>a)return!1}return!0}var Mn=new S,rc=new ue,X_=0,Bt=class extends Ji{constructor(e,t,n=!1){if(super(),Array.isArray(e))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:X_++}),this.name="",this.array=e,this.itemSize=t,this.count=e!==void 0?e.length/t:0,this.normalized=n,this.usage=Jf,this.updateRanges=[],this.gpuType=pi,this.version=0,this._normalizationScale=e!==void 0?Qh(e):void 0}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.name=e.name,this.array=new e.array.constructor(e.array),this.itemSize=e.itemSize,this.count=e.count,this.normalized=e.normalized,this.usage=e.usage,this.gpuType=e.gpuType,this._normalizationScale=e._normalizationScale,this}copyAt(e,t,n){e*=this.itemSize,n*=t.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[e+s]=t.array[n+s];return this}copyArray(e){return this.array.set(e),this}applyMatrix3(e){if(this.itemSize===2)for(let t=0,n=this.count;t<n;t++)rc.fromBufferAttribute(this,t),rc.applyMatrix3(e),this.setXY(t,rc.x,rc.y);else if(this.itemSize===3)for(let t=0,n=this.count;t<n;t++)Mn.fromBufferAttribute(this,t),Mn.applyMatrix3(e),this.setXYZ(t,Mn.x,Mn.y,Mn.z);return this}applyMatrix4(e){for(let t=0,n=this.count;t<n;t++)Mn.fromBufferAttribute(this,t),Mn.applyMatrix4(e),this.setXYZ(t,Mn.x,Mn.y,Mn.z);return this}applyNormalMatrix(e){for(let t=0,n=this.count;t<n;t++)Mn.fromBufferAttribute(this,t),Mn.applyNormalMatrix(e),this.setXYZ(t,Mn.x,Mn.y,Mn.z);return this}transformDirection(e){for(let t=0,n=this.count;t<n;t++)Mn.fromBufferAttribute(this,t),Mn.transformDirection(e),this.setXYZ(t,Mn.x,Mn.y,Mn.z);return this}set(e,t=0){return this.array.set(e,t),this}getComponent(e,t){let n=this.array[e*this.itemSize+t];return this.normalized&&(n=this._denormalize(n)),n}setComponent(e,t,n){return this.normalized&&(n=this._normalize(n)),this.array[e*this.itemSize+t]=n,this}getX(e){let t=this.array[e*this.itemSize];return this.normalized&&(t=this._denormalize(t)),t}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize]=t,this}getY(e){let t=this.array[e*this.itemSize+1];return this.normalized&&(t=this._denormalize(t)),t}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+1]=t,this}getZ(e){let t=this.array[e*this.itemSize+2];return this.normalized&&(t=this._denormalize(t)),t}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+2]=t,this}getW(e){let t=this.array[e*this.itemSize+3];return this.normalized&&(t=this._denormalize(t)),t}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+3]=t,this}setXY(e,t,n){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n)),this.array[e+0]=t,this.array[e+1]=n,this}setXYZ(e,t,n,s){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s)),this.array[e+0]=t,this.array[e+1]=n,this.array[e+2]=s,this}setXYZW(e,t,n,s,r){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s),r=this._normalize(r)),this.array[e+0]=t,this.array[e+1]=n,this.array[e+2]=s,this.array[e+3]=r,this}onUpload(e){return this.onUploadCallback=e,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let e={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return e.name=this.name,e.usage=this.usage,e.gpuType=this.gpuType,e}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):ep(e,this.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):tp(e,this.array)}};var Da=class extends Bt{constructor(e,t,n){super(new Uint16Array(e),t,n)}};var Na=class extends Bt{constructor(e,t,n){super(new Uint32Array(e),t,n)}};var ot=class extends Bt{constructor(e,t,n){super(new Float32Array(e),t,n)}},q_=new Ot,ga=new S,jd=new S,Vn=class{constructor(e=new S,t=-1){this.isSphere=!0,this.center=e,this.radius=t}set(e,t){return this.center.copy(e),this.radius=t,this}setFromPoints(e,t){let n=this.center;t!==void 0?n.copy(t):q_.setFromPoints(e).getCenter(n);let s=0;for(let r=0,o=e.length;r<o;r++)s=Math.max(s,n.distanceToSquared(e[r]));return this.radius=Math.sqrt(s),this}copy(e){return this.center.copy(e.center),this.radius=e.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(e){return e.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(e){return e.distanceTo(this.center)-this.radius}intersectsSphere(e){let t=this.radius+e.radius;return e.center.distanceToSquared(this.center)<=t*t}intersectsBox(e){return e.intersectsSphere(this)}intersectsPlane(e){return Math.abs(e.distanceToPoint(this.center))<=this.radius}clampPoint(e,t){let n=this.center.distanceToSquared(e);return t.copy(e),n>this.radius*this.radius&&(t.sub(this.center).normalize(),t.multiplyScalar(this.radius).add(this.center)),t}getBoundingBox(e){return this.isEmpty()?(e.makeEmpty(),e):(e.set(this.center,this.center),e.expandByScalar(this.radius),e)}applyMatrix4(e){return this.center.applyMatrix4(e),this.radius=this.radius*e.getMaxScaleOnAxis(),this}translate(e){return this.center.add(e),this}expandByPoint(e){if(this.isEmpty())return this.center.copy(e),this.radius=0,this;ga.subVectors(e,this.center);let t=ga.lengthSq();if(t>this.radius*this.radius){let n=Math.sqrt(t),s=(n-this.radius)*.5;this.center.addScaledVector(ga,s/n),this.radius+=s}return this}union(e){return e.isEmpty()?this:this.isEmpty()?(this.copy(e),this):(this.center.equals(e.center)===!0?this.radius=Math.max(this.radius,e.radius):(jd.subVectors(e.center,this.center).setLength(e.radius),this.expandByPoint(ga.copy(e.center).add(jd)),this.expandByPoint(ga.copy(e.center).sub(jd))),this)}equals(e){return e.center.equals(this.center)&&e.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(e){return this.radius=e.radius,this.center.fromArray(e.center),this}},Y_=0,Ui=new Qe,Qd=new cn,mo=new S,Ei=new Ot,ya=new Ot,Bn=new S,wt=class i extends Ji{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:Y_++}),this.uuid=Xs(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(e){return Array.isArray(e)?this.index=new(x_(e)?Na:Da)(e,1):this.index=e,this}setIndirect(e,t=0){return this.indirect=e,this.indirectOffset=t,this}getIndirect(){return this.indirect}getAttribute(e){return this.attributes[e]}setAttribute(e,t){return this.attributes[e]=t,this}deleteAttribute(e){return delete this.attributes[e],this}hasAttribute(e){return this.attributes[e]!==void 0}addGroup(e,t,n=0){this.groups.push({start:e,count:t,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(e,t){this.drawRange.start=e,this.drawRange.count=t}applyMatrix4(e){let t=this.attributes.position;t!==void 0&&(t.applyMatrix4(e),t.needsUpdate=!0);let n=this.attributes.normal;if(n!==void 0){let r=new yt().getNormalMatrix(e);n.applyNormalMatrix(r),n.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(e),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(e){return Ui.makeRotationFromQuaternion(e),this.applyMatrix4(Ui),this}rotateX(e){return Ui.makeRotationX(e),this.applyMatrix4(Ui),this}rotateY(e){return Ui.makeRotationY(e),this.applyMatrix4(Ui),this}rotateZ(e){return Ui.makeRotationZ(e),this.applyMatrix4(Ui),this}translate(e,t,n){return Ui.makeTranslation(e,t,n),this.applyMatrix4(Ui),this}scale(e,t,n){return Ui.makeScale(e,t,n),this.applyMatrix4(Ui),this}lookAt(e){return Qd.lookAt(e),Qd.updateMatrix(),this.applyMatrix4(Qd.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(mo).negate(),this.translate(mo.x,mo.y,mo.z),this}setFromPoints(e){let t=this.getAttribute("position");if(t===void 0){let n=[];for(let s=0,r=e.length;s<r;s++){let o=e[s];n.push(o.x,o.y,o.z||0)}this.setAttribute("position",new ot(n,3))}else{let n=Math.min(e.length,t.count);for(let s=0;s<n;s++){let r=e[s];t.setXYZ(s,r.x,r.y,r.z||0)}e.length>t.count&&it("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),t.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Ot);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){ht("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new S(-1/0,-1/0,-1/0),new S(1/0,1/0,1/0));return}if(e!==void 0){if(this.boundingBox.setFromBufferAttribute(e),t)for(let n=0,s=t.length;n<s;n++){let r=t[n];Ei.setFromBufferAttribute(r),this.morphTargetsRelative?(Bn.addVectors(this.boundingBox.min,Ei.min),this.boundingBox.expandByPoint(Bn),Bn.addVectors(this.boundingBox.max,Ei.max),this.boundingBox.expandByPoint(Bn)):(this.boundingBox.expandByPoint(Ei.min),this.boundingBox.expandByPoint(Ei.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&ht('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Vn);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){ht("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new S,1/0);return}if(e){let n=this.boundingSphere.center;if(Ei.setFromBufferAttribute(e),t)for(let r=0,o=t.length;r<o;r++){let a=t[r];ya.setFromBufferAttribute(a),this.morphTargetsRelative?(Bn.addVectors(Ei.min,ya.min),Ei.expandByPoint(Bn),Bn.addVectors(Ei.max,ya.max),Ei.expandByPoint(Bn)):(Ei.expandByPoint(ya.min),Ei.expandByPoint(ya.max))}Ei.getCenter(n);let s=0;for(let r=0,o=e.count;r<o;r++)Bn.fromBufferAttribute(e,r),s=Math.max(s,n.distanceToSquared(Bn));if(t)for(let r=0,o=t.length;r<o;r++){let a=t[r],l=this.morphTargetsRelative;for(let c=0,h=a.count;c<h;c++)Bn.fromBufferAttribute(a,c),l&&(mo.fromBufferAttribute(e,c),Bn.add(mo)),s=Math.max(s,n.distanceToSquared(Bn))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&ht('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let e=this.index,t=this.attributes;if(e===null||t.position===void 0||t.normal===void 0||t.uv===void 0){ht("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let n=t.position,s=t.normal,r=t.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==n.count)&&(o=new Bt(new Float32Array(4*n.count),4),this.setAttribute("tangent",o));let a=[],l=[],c=new Uint8Array(n.count);for(let N=0;N<n.count;N++)a[N]=new S,l[N]=new S;let h=new S,u=new S,d=new S,f=new ue,p=new ue,y=new ue,g=new S,m=new S;function x(N,P,I){c[N]=c[P]=c[I]=1,h.fromBufferAttribute(n,N),u.fromBufferAttribute(n,P),d.fromBufferAttribute(n,I),f.fromBufferAttribute(r,N),p.fromBufferAttribute(r,P),y.fromBufferAttribute(r,I),u.sub(h),d.sub(h),p.sub(f),y.sub(f);let k=1/(p.x*y.y-y.x*p.y);isFinite(k)&&(g.copy(u).multiplyScalar(y.y).addScaledVector(d,-p.y).multiplyScalar(k),m.copy(d).multiplyScalar(p.x).addScaledVector(u,-y.x).multiplyScalar(k),a[N].add(g),a[P].add(g),a[I].add(g),l[N].add(m),l[P].add(m),l[I].add(m))}let M=this.groups;M.length===0&&(M=[{start:0,count:e.count}]);for(let N=0,P=M.length;N<P;++N){let I=M[N],k=I.start,V=I.count;for(let F=k,z=k+V;F<z;F+=3)x(e.getX(F+0),e.getX(F+1),e.getX(F+2))}let _=new S,C=new S,T=new S,v=new S;function E(N){T.fromBufferAttribute(s,N),v.copy(T);let P=a[N];_.copy(P),_.sub(T.multiplyScalar(T.dot(P))).normalize(),C.crossVectors(v,P);let k=C.dot(l[N])<0?-1:1;o.setXYZW(N,_.x,_.y,_.z,k)}for(let N=0,P=n.count;N<P;++N)c[N]&&E(N);this._transformed=!0}computeVertexNormals(){let e=this.index,t=this.getAttribute("position");if(t!==void 0){let n=this.getAttribute("normal");if(n===void 0||n.count!==t.count)n=new Bt(new Float32Array(t.count*3),3),this.setAttribute("normal",n);else for(let d=0,f=n.count;d<f;d++)n.setXYZ(d,0,0,0);let s=new S,r=new S,o=new S,a=new S,l=new S,c=new S,h=new S,u=new S;if(e)for(let d=0,f=e.count;d<f;d+=3){let p=e.getX(d+0),y=e.getX(d+1),g=e.getX(d+2);s.fromBufferAttribute(t,p),r.fromBufferAttribute(t,y),o.fromBufferAttribute(t,g),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),a.fromBufferAttribute(n,p),l.fromBufferAttribute(n,y),c.fromBufferAttribute(n,g),a.add(h),l.add(h),c.add(h),n.setXYZ(p,a.x,a.y,a.z),n.setXYZ(y,l.x,l.y,l.z),n.setXYZ(g,c.x,c.y,c.z)}else for(let d=0,f=t.count;d<f;d+=3)s.fromBufferAttribute(t,d+0),r.fromBufferAttribute(t,d+1),o.fromBufferAttribute(t,d+2),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),n.setXYZ(d+0,h.x,h.y,h.z),n.setXYZ(d+1,h.x,h.y,h.z),n.setXYZ(d+2,h.x,h.y,h.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){let e=this.attributes.normal;for(let t=0,n=e.count;t<n;t++)Bn.fromBufferAttribute(e,t),Bn.normalize(),e.setXYZ(t,Bn.x,Bn.y,Bn.z)}toNonIndexed(){function e(a,l){let c=a.array,h=a.itemSize,u=a.normalized,d=new c.constructor(l.length*h),f=0,p=0;for(let y=0,g=l.length;y<g;y++){a.isInterleavedBufferAttribute?f=l[y]*a.data.stride+a.offset:f=l[y]*h;for(let m=0;m<h;m++)d[p++]=c[f++]}return new Bt(d,h,u)}if(this.index===null)return it("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let t=new i,n=this.index.array,s=this.attributes;for(let a in s){let l=s[a],c=e(l,n);t.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let h=0,u=c.length;h<u;h++){let d=c[h],f=e(d,n);l.push(f)}t.morphAttributes[a]=l}t.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];t.addGroup(c.start,c.count,c.materialIndex)}return t}toJSON(){let e={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(e.uuid=this.uuid,e.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,e.name=this.name,Object.keys(this.userData).length>0&&(e.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(e[c]=l[c]);return e}e.data={attributes:{}};let t=this.index;t!==null&&(e.data.index={type:t.array.constructor.name,array:Array.prototype.slice.call(t.array)});let n=this.attributes;for(let l in n){let c=n[l];e.data.attributes[l]=c.toJSON(e.data)}let s={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],h=[];for(let u=0,d=c.length;u<d;u++){let f=c[u];h.push(f.toJSON(e.data))}h.length>0&&(s[l]=h,r=!0)}r&&(e.data.morphAttributes=s,e.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(e.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(e.data.boundingSphere=a.toJSON()),e}clone(){return new this.constructor().copy(this)}copy(e){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let t={};this.name=e.name;let n=e.index;n!==null&&this.setIndex(n.clone());let s=e.attributes;for(let c in s){let h=s[c];this.setAttribute(c,h.clone(t))}let r=e.morphAttributes;for(let c in r){let h=[],u=r[c];for(let d=0,f=u.length;d<f;d++)h.push(u[d].clone(t));this.morphAttributes[c]=h}this.morphTargetsRelative=e.morphTargetsRelative;let o=e.groups;for(let c=0,h=o.length;c<h;c++){let u=o[c];this.addGroup(u.start,u.count,u.materialIndex)}let a=e.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=e.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=e.drawRange.start,this.drawRange.count=e.drawRange.count,this.userData=e.userData,this._transformed=e._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}},Fa=class{constructor(e,t){this.isInterleavedBuffer=!0,this.array=e,this.stride=t,this.count=e!==void 0?e.length/t:0,this.usage=Jf,this.updateRanges=[],this.version=0,this.uuid=Xs()}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.array=new e.array.constructor(e.array),this.count=e.count,this.stride=e.stride,this.usage=e.usage,this}copyAt(e,t,n){e*=this.stride,n*=t.stride;for(let s=0,r=this.stride;s<r;s++)this.array[e+s]=t.array[n+s];return this}set(e,t=0){return this.array.set(e,t),this}clone(e){e.arrayBuffers===void 0&&(e.arrayBuffers={});let t=lg(this.array);e.arrayBuffers[t]===void 0&&(e.arrayBuffers[t]=this.array.slice(0).buffer);let n=new this.array.constructor(e.arrayBuffers[t]),s=new this.constructor(n,this.stride);return s.setUsage(this.usage),s}onUpload(e){return this.onUploadCallback=e,this}toJSON(e){e.arrayBuffers===void 0&&(e.arrayBuffers={});let t=lg(this.array);e.arrayBuffers[t]===void 0&&(e.arrayBuffers[t]=Array.from(new Uint32Array(this.array.slice(0).buffer)));let n={uuid:this.uuid,buffer:t,type:this.array.constructor.name,stride:this.stride};return n.usage=this.usage,n}};function lg(i){return i.buffer._uuid===void 0&&(i.buffer._uuid=Xs()),i.byteOffset===0&&i.byteLength===i.buffer.byteLength?i.buffer._uuid:i.buffer._uuid+":"+i.byteOffset+":"+i.byteLength}var ii=new S,Bi=class i{constructor(e,t,n,s=!1){this.isInterleavedBufferAttribute=!0,this.name="",this.data=e,this.itemSize=t,this.offset=n,this.normalized=s,this._normalizationScale=e!==void 0?Qh(e.array):void 0}get count(){return this.data.count}get array(){return this.data.array}set needsUpdate(e){this.data.needsUpdate=e}applyMatrix4(e){for(let t=0,n=this.data.count;t<n;t++)ii.fromBufferAttribute(this,t),ii.applyMatrix4(e),this.setXYZ(t,ii.x,ii.y,ii.z);return this}applyNormalMatrix(e){for(let t=0,n=this.count;t<n;t++)ii.fromBufferAttribute(this,t),ii.applyNormalMatrix(e),this.setXYZ(t,ii.x,ii.y,ii.z);return this}transformDirection(e){for(let t=0,n=this.count;t<n;t++)ii.fromBufferAttribute(this,t),ii.transformDirection(e),this.setXYZ(t,ii.x,ii.y,ii.z);return this}getComponent(e,t){let n=this.array[e*this.data.stride+this.offset+t];return this.normalized&&(n=this._denormalize(n)),n}setComponent(e,t,n){return this.normalized&&(n=this._normalize(n)),this.data.array[e*this.data.stride+this.offset+t]=n,this}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset]=t,this}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+1]=t,this}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+2]=t,this}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+3]=t,this}getX(e){let t=this.data.array[e*this.data.stride+this.offset];return this.normalized&&(t=this._denormalize(t)),t}getY(e){let t=this.data.array[e*this.data.stride+this.offset+1];return this.normalized&&(t=this._denormalize(t)),t}getZ(e){let t=this.data.array[e*this.data.stride+this.offset+2];return this.normalized&&(t=this._denormalize(t)),t}getW(e){let t=this.data.array[e*this.data.stride+this.offset+3];return this.normalized&&(t=this._denormalize(t)),t}setXY(e,t,n){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),n=this._normalize(n)),this.data.array[e+0]=t,this.data.array[e+1]=n,this}setXYZ(e,t,n,s){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s)),this.data.array[e+0]=t,this.data.array[e+1]=n,this.data.array[e+2]=s,this}setXYZW(e,t,n,s,r){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s),r=this._normalize(r)),this.data.array[e+0]=t,this.data.array[e+1]=n,this.data.array[e+2]=s,this.data.array[e+3]=r,this}clone(e){if(e===void 0){Pa("InterleavedBufferAttribute.clone(): Cloning an interleaved buffer attribute will de-interleave buffer data.");let t=[];for(let n=0;n<this.count;n++){let s=n*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)t.push(this.data.array[s+r])}return new Bt(new this.array.constructor(t),this.itemSize,this.normalized)}else return e.interleavedBuffers===void 0&&(e.interleavedBuffers={}),e.interleavedBuffers[this.data.uuid]===void 0&&(e.interleavedBuffers[this.data.uuid]=this.data.clone(e)),new i(e.interleavedBuffers[this.data.uuid],this.itemSize,this.offset,this.normalized)}toJSON(e){if(e===void 0){Pa("InterleavedBufferAttribute.toJSON(): Serializing an interleaved buffer attribute will de-interleave buffer data.");let t=[];for(let n=0;n<this.count;n++){let s=n*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)t.push(this.data.array[s+r])}return{itemSize:this.itemSize,type:this.array.constructor.name,array:t,normalized:this.normalized}}else return e.interleavedBuffers===void 0&&(e.interleavedBuffers={}),e.interleavedBuffers[this.data.uuid]===void 0&&(e.interleavedBuffers[this.data.uuid]=this.data.toJSON(e)),{isInterleavedBufferAttribute:!0,itemSize:this.itemSize,data:this.data.uuid,offset:this.offset,normalized:this.normalized}}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):ep(e,this.data.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):tp(e,this.data.array)}},ef=new S,$_=new S,Z_=new yt,si=class{constructor(e=new S(1,0,0),t=0){this.isPlane=!0,this.normal=e,this.constant=t}set(e,t){return this.normal.copy(e),this.constant=t,this}setComponents(e,t,n,s){return this.normal.set(e,t,n),this.constant=s,this}setFromNormalAndCoplanarPoint(e,t){return this.normal.copy(e),this.constant=-t.dot(this.normal),this}setFromCoplanarPoints(e,t,n){let s=ef.subVectors(n,t).cross($_.subVectors(e,t)).normalize();return this.setFromNormalAndCoplanarPoint(s,e),this}copy(e){return this.normal.copy(e.normal),this.constant=e.constant,this}normalize(){let e=1/this.normal.length();return this.normal.multiplyScalar(e),this.constant*=e,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(e){return this.normal.dot(e)+this.constant}distanceToSphere(e){return this.distanceToPoint(e.center)-e.radius}projectPoint(e,t){return t.copy(e).addScaledVector(this.normal,-this.distanceToPoint(e))}intersectLine(e,t,n=!0){let s=e.delta(ef),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(e.start)===0?t.copy(e.start):null;let o=-(e.start.dot(this.normal)+this.constant)/r;return n===!0&&(o<0||o>1)?null:t.copy(e.start).addScaledVector(s,o)}intersectsLine(e){let t=this.distanceToPoint(e.start),n=this.distanceToPoint(e.end);return t<0&&n>0||n<0&&t>0}intersectsBox(e){return e.intersectsPlane(this)}intersectsSphere(e){return e.intersectsPlane(this)}coplanarPoint(e){return e.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(e,t){let n=t||Z_.getNormalMatrix(e),s=this.coplanarPoint(ef).applyMatrix4(e),r=this.normal.applyMatrix3(n).normalize();return this.constant=-s.dot(r),this}translate(e){return this.constant-=e.dot(this.normal),this}equals(e){return e.normal.equals(this.normal)&&e.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(e){return this.normal.fromArray(e.normal),this.constant=e.constant,this}},J_=0,Ki=class extends Ji{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:J_++}),this.uuid=Xs(),this.name="",this.type="Material",this.blending=Bo,this.side=gr,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=If,this.blendDst=Lf,this.blendEquation=Nr,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new et(0,0,0),this.blendAlpha=0,this.depthFunc=Eo,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=h0,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=Ic,this.stencilZFail=Ic,this.stencilZPass=Ic,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(e){this._alphaTest>0!=e>0&&this.version++,this._alphaTest=e}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(e){if(e!==void 0)for(let t in e){let n=e[t];if(n===void 0){it(`Material: parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){it(`Material: '${t}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(n):s&&s.isVector2&&n&&n.isVector2||s&&s.isEuler&&n&&n.isEuler||s&&s.isVector3&&n&&n.isVector3?s.copy(n):this[t]=n}}toJSON(e){let t=e===void 0||typeof e=="string";t&&(e={textures:{},images:{}});let n={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,n.blending=this.blending,n.side=this.side,n.shadowSide=this.shadowSide,n.vertexColors=this.vertexColors,n.opacity=this.opacity,n.transparent=this.transparent,n.blendSrc=this.blendSrc,n.blendDst=this.blendDst,n.blendEquation=this.blendEquation,n.blendSrcAlpha=this.blendSrcAlpha,n.blendDstAlpha=this.blendDstAlpha,n.blendEquationAlpha=this.blendEquationAlpha,n.blendColor=this.blendColor.getHex(),n.blendAlpha=this.blendAlpha,n.depthFunc=this.depthFunc,n.depthTest=this.depthTest,n.depthWrite=this.depthWrite,n.colorWrite=this.colorWrite,n.clipIntersection=this.clipIntersection,n.clipShadows=this.clipShadows,n.stencilWriteMask=this.stencilWriteMask,n.stencilFunc=this.stencilFunc,n.stencilRef=this.stencilRef,n.stencilFuncMask=this.stencilFuncMask,n.stencilFail=this.stencilFail,n.stencilZFail=this.stencilZFail,n.stencilZPass=this.stencilZPass,n.stencilWrite=this.stencilWrite,n.polygonOffset=this.polygonOffset,n.polygonOffsetFactor=this.polygonOffsetFactor,n.polygonOffsetUnits=this.polygonOffsetUnits,n.dithering=this.dithering,n.alphaTest=this.alphaTest,n.alphaHash=this.alphaHash,n.alphaToCoverage=this.alphaToCoverage,n.premultipliedAlpha=this.premultipliedAlpha,n.forceSinglePass=this.forceSinglePass,n.allowOverride=this.allowOverride,n.visible=this.visible,n.toneMapped=this.toneMapped,n.name=this.name,this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(n.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(n.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(e).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(e).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(e).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(e).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(n.sheenColorMap=this.sheenColorMap.toJSON(e).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(n.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(e).uuid),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(n.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(n.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(n.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(e).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(e).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(e).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(e).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(e).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(e).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(e).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(e).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(e).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(e).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(e).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(e).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(e).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(e).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(e).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(e).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(e).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(e).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(e).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(e).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(e).uuid),this.attenuationDistance!==void 0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(n.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(n.rotation=this.rotation),this.depthPacking!==void 0&&(n.depthPacking=this.depthPacking),this.linewidth!==void 0&&(n.linewidth=this.linewidth),this.linecap!==void 0&&(n.linecap=this.linecap),this.linejoin!==void 0&&(n.linejoin=this.linejoin),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.wireframe!==void 0&&(n.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(n.flatShading=this.flatShading),this.fog!==void 0&&(n.fog=this.fog),Object.keys(this.userData).length>0&&(n.userData=this.userData);function s(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(t){let r=s(e.textures),o=s(e.images);r.length>0&&(n.textures=r),o.length>0&&(n.images=o)}return n}fromJSON(e,t){if(e.uuid!==void 0&&(this.uuid=e.uuid),e.name!==void 0&&(this.name=e.name),e.color!==void 0&&this.color!==void 0&&this.color.setHex(e.color),e.roughness!==void 0&&(this.roughness=e.roughness),e.metalness!==void 0&&(this.metalness=e.metalness),e.sheen!==void 0&&(this.sheen=e.sheen),e.sheenColor!==void 0&&(this.sheenColor=new et().setHex(e.sheenColor)),e.sheenRoughness!==void 0&&(this.sheenRoughness=e.sheenRoughness),e.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(e.emissive),e.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(e.specular),e.specularIntensity!==void 0&&(this.specularIntensity=e.specularIntensity),e.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(e.specularColor),e.shininess!==void 0&&(this.shininess=e.shininess),e.clearcoat!==void 0&&(this.clearcoat=e.clearcoat),e.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=e.clearcoatRoughness),e.diffuseRoughness!==void 0&&(this.diffuseRoughness=e.diffuseRoughness),e.dispersion!==void 0&&(this.dispersion=e.dispersion),e.retroreflectivity!==void 0&&(this.retroreflectivity=e.retroreflectivity),e.iridescence!==void 0&&(this.iridescence=e.iridescence),e.iridescenceIOR!==void 0&&(this.iridescenceIOR=e.iridescenceIOR),e.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessMinimum),e.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=e.iridescenceThicknessMaximum),e.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=e.iridescenceThicknessRange[1]),e.transmission!==void 0&&(this.transmission=e.transmission),e.thickness!==void 0&&(this.thickness=e.thickness),e.attenuationDistance!==void 0&&(this.attenuationDistance=e.attenuationDistance),e.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(e.attenuationColor),e.anisotropy!==void 0&&(this.anisotropy=e.anisotropy),e.anisotropyRotation!==void 0&&(this.anisotropyRotation=e.anisotropyRotation),e.fog!==void 0&&(this.fog=e.fog),e.flatShading!==void 0&&(this.flatShading=e.flatShading),e.blending!==void 0&&(this.blending=e.blending),e.combine!==void 0&&(this.combine=e.combine),e.side!==void 0&&(this.side=e.side),e.shadowSide!==void 0&&(this.shadowSide=e.shadowSide),e.opacity!==void 0&&(this.opacity=e.opacity),e.transparent!==void 0&&(this.transparent=e.transparent),e.alphaTest!==void 0&&(this.alphaTest=e.alphaTest),e.alphaHash!==void 0&&(this.alphaHash=e.alphaHash),e.depthFunc!==void 0&&(this.depthFunc=e.depthFunc),e.depthTest!==void 0&&(this.depthTest=e.depthTest),e.depthWrite!==void 0&&(this.depthWrite=e.depthWrite),e.colorWrite!==void 0&&(this.colorWrite=e.colorWrite),e.clippingPlanes!==void 0&&(this.clippingPlanes=e.clippingPlanes.map(n=>new si().fromJSON(n))),e.clipIntersection!==void 0&&(this.clipIntersection=e.clipIntersection),e.clipShadows!==void 0&&(this.clipShadows=e.clipShadows),e.depthPacking!==void 0&&(this.depthPacking=e.depthPacking),e.blendSrc!==void 0&&(this.blendSrc=e.blendSrc),e.blendDst!==void 0&&(this.blendDst=e.blendDst),e.blendEquation!==void 0&&(this.blendEquation=e.blendEquation),e.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=e.blendSrcAlpha),e.blendDstAlpha!==void 0&&(this.blendDstAlpha=e.blendDstAlpha),e.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=e.blendEquationAlpha),e.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(e.blendColor),e.blendAlpha!==void 0&&(this.blendAlpha=e.blendAlpha),e.stencilWriteMask!==void 0&&(this.stencilWriteMask=e.stencilWriteMask),e.stencilFunc!==void 0&&(this.stencilFunc=e.stencilFunc),e.stencilRef!==void 0&&(this.stencilRef=e.stencilRef),e.stencilFuncMask!==void 0&&(this.stencilFuncMask=e.stencilFuncMask),e.stencilFail!==void 0&&(this.stencilFail=e.stencilFail),e.stencilZFail!==void 0&&(this.stencilZFail=e.stencilZFail),e.stencilZPass!==void 0&&(this.stencilZPass=e.stencilZPass),e.stencilWrite!==void 0&&(this.stencilWrite=e.stencilWrite),e.wireframe!==void 0&&(this.wireframe=e.wireframe),e.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=e.wireframeLinewidth),e.wireframeLinecap!==void 0&&(this.wireframeLinecap=e.wireframeLinecap),e.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=e.wireframeLinejoin),e.rotation!==void 0&&(this.rotation=e.rotation),e.linewidth!==void 0&&(this.linewidth=e.linewidth),e.linecap!==void 0&&(this.linecap=e.linecap),e.linejoin!==void 0&&(this.linejoin=e.linejoin),e.dashSize!==void 0&&(this.dashSize=e.dashSize),e.gapSize!==void 0&&(this.gapSize=e.gapSize),e.scale!==void 0&&(this.scale=e.scale),e.polygonOffset!==void 0&&(this.polygonOffset=e.polygonOffset),e.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=e.polygonOffsetFactor),e.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=e.polygonOffsetUnits),e.dithering!==void 0&&(this.dithering=e.dithering),e.alphaToCoverage!==void 0&&(this.alphaToCoverage=e.alphaToCoverage),e.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=e.premultipliedAlpha),e.forceSinglePass!==void 0&&(this.forceSinglePass=e.forceSinglePass),e.allowOverride!==void 0&&(this.allowOverride=e.allowOverride),e.visible!==void 0&&(this.visible=e.visible),e.toneMapped!==void 0&&(this.toneMapped=e.toneMapped),e.userData!==void 0&&(this.userData=e.userData),e.vertexColors!==void 0&&(typeof e.vertexColors=="number"?this.vertexColors=e.vertexColors>0:this.vertexColors=e.vertexColors),e.size!==void 0&&(this.size=e.size),e.sizeAttenuation!==void 0&&(this.sizeAttenuation=e.sizeAttenuation),e.map!==void 0&&(this.map=t[e.map]||null),e.matcap!==void 0&&(this.matcap=t[e.matcap]||null),e.alphaMap!==void 0&&(this.alphaMap=t[e.alphaMap]||null),e.bumpMap!==void 0&&(this.bumpMap=t[e.bumpMap]||null),e.bumpScale!==void 0&&(this.bumpScale=e.bumpScale),e.normalMap!==void 0&&(this.normalMap=t[e.normalMap]||null),e.normalMapType!==void 0&&(this.normalMapType=e.normalMapType),e.normalScale!==void 0){let n=e.normalScale;Array.isArray(n)===!1&&(n=[n,n]),this.normalScale=new ue().fromArray(n)}return e.displacementMap!==void 0&&(this.displacementMap=t[e.displacementMap]||null),e.displacementScale!==void 0&&(this.displacementScale=e.displacementScale),e.displacementBias!==void 0&&(this.displacementBias=e.displacementBias),e.roughnessMap!==void 0&&(this.roughnessMap=t[e.roughnessMap]||null),e.metalnessMap!==void 0&&(this.metalnessMap=t[e.metalnessMap]||null),e.emissiveMap!==void 0&&(this.emissiveMap=t[e.emissiveMap]||null),e.emissiveIntensity!==void 0&&(this.emissiveIntensity=e.emissiveIntensity),e.specularMap!==void 0&&(this.specularMap=t[e.specularMap]||null),e.specularIntensityMap!==void 0&&(this.specularIntensityMap=t[e.specularIntensityMap]||null),e.specularColorMap!==void 0&&(this.specularColorMap=t[e.specularColorMap]||null),e.envMap!==void 0&&(this.envMap=t[e.envMap]||null),e.envMapRotation!==void 0&&this.envMapRotation.fromArray(e.envMapRotation),e.envMapIntensity!==void 0&&(this.envMapIntensity=e.envMapIntensity),e.reflectivity!==void 0&&(this.reflectivity=e.reflectivity),e.refractionRatio!==void 0&&(this.refractionRatio=e.refractionRatio),e.lightMap!==void 0&&(this.lightMap=t[e.lightMap]||null),e.lightMapIntensity!==void 0&&(this.lightMapIntensity=e.lightMapIntensity),e.aoMap!==void 0&&(this.aoMap=t[e.aoMap]||null),e.aoMapIntensity!==void 0&&(this.aoMapIntensity=e.aoMapIntensity),e.gradientMap!==void 0&&(this.gradientMap=t[e.gradientMap]||null),e.clearcoatMap!==void 0&&(this.clearcoatMap=t[e.clearcoatMap]||null),e.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=t[e.clearcoatRoughnessMap]||null),e.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=t[e.clearcoatNormalMap]||null),e.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new ue().fromArray(e.clearcoatNormalScale)),e.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=t[e.diffuseRoughnessMap]||null),e.iridescenceMap!==void 0&&(this.iridescenceMap=t[e.iridescenceMap]||null),e.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=t[e.iridescenceThicknessMap]||null),e.transmissionMap!==void 0&&(this.transmissionMap=t[e.transmissionMap]||null),e.thicknessMap!==void 0&&(this.thicknessMap=t[e.thicknessMap]||null),e.anisotropyMap!==void 0&&(this.anisotropyMap=t[e.anisotropyMap]||null),e.sheenColorMap!==void 0&&(this.sheenColorMap=t[e.sheenColorMap]||null),e.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=t[e.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(e){this.name=e.name,this.blending=e.blending,this.side=e.side,this.vertexColors=e.vertexColors,this.opacity=e.opacity,this.transparent=e.transparent,this.blendSrc=e.blendSrc,this.blendDst=e.blendDst,this.blendEquation=e.blendEquation,this.blendSrcAlpha=e.blendSrcAlpha,this.blendDstAlpha=e.blendDstAlpha,this.blendEquationAlpha=e.blendEquationAlpha,this.blendColor.copy(e.blendColor),this.blendAlpha=e.blendAlpha,this.depthFunc=e.depthFunc,this.depthTest=e.depthTest,this.depthWrite=e.depthWrite,this.stencilWriteMask=e.stencilWriteMask,this.stencilFunc=e.stencilFunc,this.stencilRef=e.stencilRef,this.stencilFuncMask=e.stencilFuncMask,this.stencilFail=e.stencilFail,this.stencilZFail=e.stencilZFail,this.stencilZPass=e.stencilZPass,this.stencilWrite=e.stencilWrite;let t=e.clippingPlanes,n=null;if(t!==null){let s=t.length;n=new Array(s);for(let r=0;r!==s;++r)n[r]=t[r].clone()}return this.clippingPlanes=n,this.clipIntersection=e.clipIntersection,this.clipShadows=e.clipShadows,this.shadowSide=e.shadowSide,this.colorWrite=e.colorWrite,this.precision=e.precision,this.polygonOffset=e.polygonOffset,this.polygonOffsetFactor=e.polygonOffsetFactor,this.polygonOffsetUnits=e.polygonOffsetUnits,this.dithering=e.dithering,this.alphaTest=e.alphaTest,this.alphaHash=e.alphaHash,this.alphaToCoverage=e.alphaToCoverage,this.premultipliedAlpha=e.premultipliedAlpha,this.forceSinglePass=e.forceSinglePass,this.allowOverride=e.allowOverride,this.visible=e.visible,this.toneMapped=e.toneMapped,this.userData=JSON.parse(JSON.stringify(e.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(e){e===!0&&this.version++}};var Is=new S,tf=new S,oc=new S,ac=new S,ar=class{constructor(e=new S,t=new S(0,0,-1)){this.origin=e,this.direction=t}set(e,t){return this.origin.copy(e),this.direction.copy(t),this}copy(e){return this.origin.copy(e.origin),this.direction.copy(e.direction),this}at(e,t){return t.copy(this.origin).addScaledVector(this.direction,e)}lookAt(e){return this.direction.copy(e).sub(this.origin).normalize(),this}recast(e){return this.origin.copy(this.at(e,Is)),this}closestPointToPoint(e,t){t.subVectors(e,this.origin);let n=t.dot(this.direction);return n<0?t.copy(this.origin):t.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(e){return Math.sqrt(this.distanceSqToPoint(e))}distanceSqToPoint(e){let t=Is.subVectors(e,this.origin).dot(this.direction);return t<0?this.origin.distanceToSquared(e):(Is.copy(this.origin).addScaledVector(this.direction,t),Is.distanceToSquared(e))}distanceSqToSegment(e,t,n,s){tf.copy(e).add(t).multiplyScalar(.5),oc.copy(t).sub(e).normalize(),ac.copy(this.origin).sub(tf);let r=e.distanceTo(t)*.5,o=-this.direction.dot(oc),a=ac.dot(this.direction),l=-ac.dot(oc),c=ac.lengthSq(),h=Math.abs(1-o*o),u,d,f,p;if(h>0)if(u=o*l-a,d=o*a-l,p=r*h,u>=0)if(d>=-p)if(d<=p){let y=1/h;u*=y,d*=y,f=u*(u+o*d+2*a)+d*(o*u+d+2*l)+c}else d=r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d=-r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d<=-p?(u=Math.max(0,-(-o*r+a)),d=u>0?-r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c):d<=p?(u=0,d=Math.min(Math.max(-r,-l),r),f=d*(d+2*l)+c):(u=Math.max(0,-(o*r+a)),d=u>0?r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c);else d=o>0?-r:r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;return n&&n.copy(this.origin).addScaledVector(this.direction,u),s&&s.copy(tf).addScaledVector(oc,d),f}intersectSphere(e,t){if(e.radius<0)return null;Is.subVectors(e.center,this.origin);let n=Is.dot(this.direction),s=Is.dot(Is)-n*n,r=e.radius*e.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=n-o,l=n+o;return l<0?null:a<0?this.at(l,t):this.at(a,t)}intersectsSphere(e){return e.radius<0?!1:this.distanceSqToPoint(e.center)<=e.radius*e.radius}distanceToPlane(e){let t=e.normal.dot(this.direction);if(t===0)return e.distanceToPoint(this.origin)===0?0:null;let n=-(this.origin.dot(e.normal)+e.constant)/t;return n>=0?n:null}intersectPlane(e,t){let n=this.distanceToPlane(e);return n===null?null:this.at(n,t)}intersectsPlane(e){let t=e.distanceToPoint(this.origin);return t===0||e.normal.dot(this.direction)*t<0}intersectBox(e,t){let n,s,r,o,a,l,c=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,d=this.origin;return c>=0?(n=(e.min.x-d.x)*c,s=(e.max.x-d.x)*c):(n=(e.max.x-d.x)*c,s=(e.min.x-d.x)*c),h>=0?(r=(e.min.y-d.y)*h,o=(e.max.y-d.y)*h):(r=(e.max.y-d.y)*h,o=(e.min.y-d.y)*h),n>o||r>s||((r>n||isNaN(n))&&(n=r),(o<s||isNaN(s))&&(s=o),u>=0?(a=(e.min.z-d.z)*u,l=(e.max.z-d.z)*u):(a=(e.max.z-d.z)*u,l=(e.min.z-d.z)*u),n>l||a>s)||((a>n||n!==n)&&(n=a),(l<s||s!==s)&&(s=l),s<0)?null:this.at(n>=0?n:s,t)}intersectsBox(e){return this.intersectBox(e,Is)!==null}intersectTriangle(e,t,n,s,r){let o=this.origin,a=this.direction,l=a.x,c=a.y,h=a.z,u=e.x-o.x,d=e.y-o.y,f=e.z-o.z,p=t.x-o.x,y=t.y-o.y,g=t.z-o.z,m=n.x-o.x,x=n.y-o.y,M=n.z-o.z,_=Math.abs(l),C=Math.abs(c),T=Math.abs(h),v,E,N,P,I,k,V,F,z,Y,G,ce;if(_>=C&&_>=T?(N=l,k=u,z=p,ce=m,l>=0?(v=c,E=h,P=d,I=f,V=y,F=g,Y=x,G=M):(v=h,E=c,P=f,I=d,V=g,F=y,Y=M,G=x)):C>=T?(N=c,k=d,z=y,ce=x,c>=0?(v=h,E=l,P=f,I=u,V=g,F=p,Y=M,G=m):(v=l,E=h,P=u,I=f,V=p,F=g,Y=m,G=M)):(N=h,k=f,z=g,ce=M,h>=0?(v=l,E=c,P=u,I=d,V=p,F=y,Y=m,G=x):(v=c,E=l,P=d,I=u,V=y,F=p,Y=x,G=m)),N===0)return null;let J=v/N,Q=E/N,te=1/N,pe=P-J*k,he=I-Q*k,ee=V-J*z,ye=F-Q*z,ve=Y-J*ce,Le=G-Q*ce,Ee=ve*ye-Le*ee,Ve=pe*Le-he*ve,at=ee*he-ye*pe;if(s){if(Ee<0||Ve<0||at<0)return null}else if((Ee<0||Ve<0||at<0)&&(Ee>0||Ve>0||at>0))return null;let Je=Ee+Ve+at;if(Je===0)return null;let lt=te*(Ee*k+Ve*z+at*ce);return(Je>0?lt<0:lt>0)?null:this.at(lt/Je,r)}applyMatrix4(e){return this.origin.applyMatrix4(e),this.direction.transformDirection(e),this}equals(e){return e.origin.equals(this.origin)&&e.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},Rn=class extends Ki{constructor(e){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new et(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new fs,this.combine=dl,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.fog=e.fog,this}},cg=new Qe,Ar=new ar,lc=new Vn,hg=new S,cc=new S,hc=new S,uc=new S,nf=new S,dc=new S,ug=new S,fc=new S,St=class extends cn{constructor(e=new wt,t=new Rn){super(),this.isMesh=!0,this.type="Mesh",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let s=t[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(e,t){let n=this.geometry,s=n.attributes.position,r=n.morphAttributes.position,o=n.morphTargetsRelative;t.fromBufferAttribute(s,e);let a=this.morphTargetInfluences;if(r&&a){dc.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let h=a[l],u=r[l];h!==0&&(nf.fromBufferAttribute(u,e),o?dc.addScaledVector(nf,h):dc.addScaledVector(nf.sub(t),h))}t.add(dc)}return t}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),lc.copy(n.boundingSphere),lc.applyMatrix4(r),Ar.copy(e.ray).recast(e.near),!(lc.containsPoint(Ar.origin)===!1&&(Ar.intersectSphere(lc,hg)===null||Ar.origin.distanceToSquared(hg)>(e.far-e.near)**2))&&(cg.copy(r).invert(),Ar.copy(e.ray).applyMatrix4(cg),!(n.boundingBox!==null&&Ar.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(e,t,Ar)))}_computeIntersections(e,t,n){let s,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,d=r.groups,f=r.drawRange;if(a!==null)if(Array.isArray(o))for(let p=0,y=d.length;p<y;p++){let g=d[p],m=o[g.materialIndex],x=Math.max(g.start,f.start),M=Math.min(a.count,Math.min(g.start+g.count,f.start+f.count));for(let _=x,C=M;_<C;_+=3){let T=a.getX(_),v=a.getX(_+1),E=a.getX(_+2);s=pc(this,m,e,n,c,h,u,T,v,E),s&&(s.faceIndex=Math.floor(_/3),s.face.materialIndex=g.materialIndex,t.push(s))}}else{let p=Math.max(0,f.start),y=Math.min(a.count,f.start+f.count);for(let g=p,m=y;g<m;g+=3){let x=a.getX(g),M=a.getX(g+1),_=a.getX(g+2);s=pc(this,o,e,n,c,h,u,x,M,_),s&&(s.faceIndex=Math.floor(g/3),t.push(s))}}else if(l!==void 0)if(Array.isArray(o))for(let p=0,y=d.length;p<y;p++){let g=d[p],m=o[g.materialIndex],x=Math.max(g.start,f.start),M=Math.min(l.count,Math.min(g.start+g.count,f.start+f.count));for(let _=x,C=M;_<C;_+=3){let T=_,v=_+1,E=_+2;s=pc(this,m,e,n,c,h,u,T,v,E),s&&(s.faceIndex=Math.floor(_/3),s.face.materialIndex=g.materialIndex,t.push(s))}}else{let p=Math.max(0,f.start),y=Math.min(l.count,f.start+f.count);for(let g=p,m=y;g<m;g+=3){let x=g,M=g+1,_=g+2;s=pc(this,o,e,n,c,h,u,x,M,_),s&&(s.faceIndex=Math.floor(g/3),t.push(s))}}}};function K_(i,e,t,n,s,r,o,a){let l;if(e.side===li?l=n.intersectTriangle(o,r,s,!0,a):l=n.intersectTriangle(s,r,o,e.side===gr,a),l===null)return null;fc.copy(a),fc.applyMatrix4(i.matrixWorld);let c=t.ray.origin.distanceTo(fc);return c<t.near||c>t.far?null:{distance:c,point:fc.clone(),object:i}}function pc(i,e,t,n,s,r,o,a,l,c){i.getVertexPosition(a,cc),i.getVertexPosition(l,hc),i.getVertexPosition(c,uc);let h=K_(i,e,t,n,cc,hc,uc,ug);if(h){let u=new S;Ls.getBarycoord(ug,cc,hc,uc,u),s&&(h.uv=Ls.getInterpolatedAttribute(s,a,l,c,u,new ue)),r&&(h.uv1=Ls.getInterpolatedAttribute(r,a,l,c,u,new ue)),o&&(h.normal=Ls.getInterpolatedAttribute(o,a,l,c,u,new S),h.normal.dot(n.direction)>0&&h.normal.multiplyScalar(-1));let d={a,b:l,c,normal:new S,materialIndex:0};Ls.getNormal(cc,hc,uc,d.normal),h.face=d,h.barycoord=u}return h}var or=class extends mi{constructor(e=null,t=1,n=1,s,r,o,a,l,c=kn,h=kn,u,d){super(null,o,a,l,c,h,s,r,u,d),this.isDataTexture=!0,this.image={data:e,width:t,height:n},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var Io=class extends Bt{constructor(e,t,n,s=1){super(e,t,n),this.isInstancedBufferAttribute=!0,this.meshPerAttribute=s}copy(e){return super.copy(e),this.meshPerAttribute=e.meshPerAttribute,this}toJSON(){let e=super.toJSON();return e.meshPerAttribute=this.meshPerAttribute,e.isInstancedBufferAttribute=!0,e}},go=new Qe,dg=new Qe,mc=[],fg=new Ot,j_=new Qe,xa=new St,va=new Vn,Pr=class extends St{constructor(e,t,n){super(e,t),this.isInstancedMesh=!0,this.instanceMatrix=new Io(new Float32Array(n*16),16),this.instanceColor=null,this.morphTexture=null,this.count=n,this.boundingBox=null,this.boundingSphere=null;for(let s=0;s<n;s++)this.setMatrixAt(s,j_)}computeBoundingBox(){let e=this.geometry,t=this.count;this.boundingBox===null&&(this.boundingBox=new Ot),e.boundingBox===null&&e.computeBoundingBox(),this.boundingBox.makeEmpty();for(let n=0;n<t;n++)this.getMatrixAt(n,go),fg.copy(e.boundingBox).applyMatrix4(go),this.boundingBox.union(fg)}computeBoundingSphere(){let e=this.geometry,t=this.count;this.boundingSphere===null&&(this.boundingSphere=new Vn),e.boundingSphere===null&&e.computeBoundingSphere(),this.boundingSphere.makeEmpty();for(let n=0;n<t;n++)this.getMatrixAt(n,go),va.copy(e.boundingSphere).applyMatrix4(go),this.boundingSphere.union(va)}copy(e,t){return super.copy(e,t),this.instanceMatrix.copy(e.instanceMatrix),this.morphTexture=e.morphTexture!==null?e.morphTexture.clone():null,this.instanceColor=e.instanceColor!==null?e.instanceColor.clone():null,this.count=e.count,this.boundingBox=e.boundingBox!==null?e.boundingBox.clone():null,this.boundingSphere=e.boundingSphere!==null?e.boundingSphere.clone():null,this}getColorAt(e,t){return this.instanceColor===null?t.setRGB(1,1,1):t.fromArray(this.instanceColor.array,e*3)}getMatrixAt(e,t){return t.fromArray(this.instanceMatrix.array,e*16)}getMorphAt(e,t){let n=t.morphTargetInfluences,s=this.morphTexture.source.data.data,r=n.length+1,o=e*r+1;for(let a=0;a<n.length;a++)n[a]=s[o+a]}raycast(e,t){let n=this.matrixWorld,s=this.count;if(xa.geometry=this.geometry,xa.material=this.material,xa.material!==void 0&&(this.boundingSphere===null&&this.computeBoundingSphere(),va.copy(this.boundingSphere),va.applyMatrix4(n),e.ray.intersectsSphere(va)!==!1))for(let r=0;r<s;r++){this.getMatrixAt(r,go),dg.multiplyMatrices(n,go),xa.matrixWorld=dg,xa.raycast(e,mc);for(let o=0,a=mc.length;o<a;o++){let l=mc[o];l.instanceId=r,l.object=this,t.push(l)}mc.length=0}}setColorAt(e,t){return this.instanceColor===null&&(this.instanceColor=new Io(new Float32Array(this.instanceMatrix.count*3).fill(1),3)),t.toArray(this.instanceColor.array,e*3),this}setMatrixAt(e,t){return t.toArray(this.instanceMatrix.array,e*16),this}setMorphAt(e,t){let n=t.morphTargetInfluences,s=n.length+1;this.morphTexture===null&&(this.morphTexture=new or(new Float32Array(s*this.count),s,this.count,_h,pi));let r=this.morphTexture.source.data.data,o=0;for(let c=0;c<n.length;c++)o+=n[c];let a=this.geometry.morphTargetsRelative?1:1-o,l=s*e;return r[l]=a,r.set(n,l+1),this}updateMorphTargets(){}dispose(){super.dispose(),this.instanceMatrix.dispose(),this.instanceColor!==null&&this.instanceColor.dispose(),this.morphTexture!==null&&(this.morphTexture.dispose(),this.morphTexture=null)}},Rr=new Vn,Q_=new ue(.5,.5),gc=new S,Us=class{constructor(e=new si,t=new si,n=new si,s=new si,r=new si,o=new si){this.planes=[e,t,n,s,r,o]}set(e,t,n,s,r,o){let a=this.planes;return a[0].copy(e),a[1].copy(t),a[2].copy(n),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(e){let t=this.planes;for(let n=0;n<6;n++)t[n].copy(e.planes[n]);return this}setFromProjectionMatrix(e,t=Oi,n=!1){let s=this.planes,r=e.elements,o=r[0],a=r[1],l=r[2],c=r[3],h=r[4],u=r[5],d=r[6],f=r[7],p=r[8],y=r[9],g=r[10],m=r[11],x=r[12],M=r[13],_=r[14],C=r[15];if(s[0].setComponents(c-o,f-h,m-p,C-x).normalize(),s[1].setComponents(c+o,f+h,m+p,C+x).normalize(),s[2].setComponents(c+a,f+u,m+y,C+M).normalize(),s[3].setComponents(c-a,f-u,m-y,C-M).normalize(),n)s[4].setComponents(l,d,g,_).normalize(),s[5].setComponents(c-l,f-d,m-g,C-_).normalize();else if(s[4].setComponents(c-l,f-d,m-g,C-_).normalize(),t===Oi)s[5].setComponents(c+l,f+d,m+g,C+_).normalize();else if(t===wo)s[5].setComponents(l,d,g,_).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+t);return this}intersectsObject(e){if(e.boundingSphere!==void 0)e.boundingSphere===null&&e.computeBoundingSphere(),Rr.copy(e.boundingSphere).applyMatrix4(e.matrixWorld);else{let t=e.geometry;t.boundingSphere===null&&t.computeBoundingSphere(),Rr.copy(t.boundingSphere).applyMatrix4(e.matrixWorld)}return this.intersectsSphere(Rr)}intersectsSprite(e){Rr.center.set(0,0,0);let t=Q_.distanceTo(e.center);return Rr.radius=.7071067811865476+t,Rr.applyMatrix4(e.matrixWorld),this.intersectsSphere(Rr)}intersectsSphere(e){let t=this.planes,n=e.center,s=-e.radius;for(let r=0;r<6;r++)if(t[r].distanceToPoint(n)<s)return!1;return!0}intersectsBox(e){let t=this.planes;for(let n=0;n<6;n++){let s=t[n];if(gc.x=s.normal.x>0?e.max.x:e.min.x,gc.y=s.normal.y>0?e.max.y:e.min.y,gc.z=s.normal.z>0?e.max.z:e.min.z,s.distanceToPoint(gc)<0)return!1}return!0}containsPoint(e){let t=this.planes;for(let n=0;n<6;n++)if(t[n].distanceToPoint(e)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},pg=new Qe,Ua=class i{constructor(){this.coordinateSystem=Oi,this._frustums=[],this._count=0}setFromArrayCamera(e){let t=e.cameras,n=this._frustums;for(let s=0;s<t.length;s++){let r=t[s];pg.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),n[s]===void 0&&(n[s]=new Us),n[s].setFromProjectionMatrix(pg,r.coordinateSystem,r.reversedDepth)}return this._count=t.length,this}getFrustum(e){return this._frustums[e]}intersectsObject(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsObject(e))return!0;return!1}intersectsSprite(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsSprite(e))return!0;return!1}intersectsSphere(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsSphere(e))return!0;return!1}intersectsBox(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsBox(e))return!0;return!1}containsPoint(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].containsPoint(e))return!0;return!1}copy(e){this.coordinateSystem=e.coordinateSystem;let t=this._frustums,n=e._frustums;for(let s=0;s<e._count;s++)t[s]===void 0&&(t[s]=new Us),t[s].copy(n[s]);return this._count=e._count,this}clone(){return new i().copy(this)}};function sf(i,e){return i-e}function eb(i,e){return i.z-e.z}function tb(i,e){return e.z-i.z}var xf=class{constructor(){this.index=0,this.pool=[],this.list=[]}push(e,t,n,s){let r=this.pool,o=this.list;this.index>=r.length&&r.push({start:-1,count:-1,z:-1,index:-1});let a=r[this.index];o.push(a),this.index++,a.start=e,a.count=t,a.z=n,a.index=s}reset(){this.list.length=0,this.index=0}},fi=new Qe,nb=new et(1,1,1),ib=new Us,sb=new Ua,yc=new Ot,Cr=new Vn,rf=new S,mg=new S,gg=new S,rb=new S,of=new xf,Zn=new St,xc=[];function ob(i,e,t=0){let n=e.itemSize;if(i.isInterleavedBufferAttribute||i.array.constructor!==e.array.constructor){let s=i.count;for(let r=0;r<s;r++)for(let o=0;o<n;o++)e.setComponent(r+t,o,i.getComponent(r,o))}else e.array.set(i.array,t*n);e.needsUpdate=!0}function hs(i,e){if(i.constructor!==e.constructor){let t=Math.min(i.length,e.length);for(let n=0;n<t;n++)e[n]=i[n]}else{let t=Math.min(i.length,e.length);e.set(new i.constructor(i.buffer,0,t))}}var Oa=class extends St{constructor(e,t,n=t*2,s){super(new wt,s),this.isBatchedMesh=!0,this.perObjectFrustumCulled=!0,this.sortObjects=!0,this.boundingBox=null,this.boundingSphere=null,this.customSort=null,this._instanceInfo=[],this._geometryInfo=[],this._availableInstanceIds=[],this._availableGeometryIds=[],this._nextIndexStart=0,this._nextVertexStart=0,this._geometryCount=0,this._visibilityChanged=!0,this._geometryInitialized=!1,this._maxInstanceCount=e,this._maxVertexCount=t,this._maxIndexCount=n,this._multiDrawCounts=new Int32Array(e),this._multiDrawStarts=new Int32Array(e),this._multiDrawCount=0,this._multiDrawBytesPerElement=1,this._mergedDrawCounts=new Int32Array(e),this._mergedDrawStarts=new Int32Array(e),this._mergedDrawInstanceCounts=new Int32Array(e),this._mergedDrawCount=0,this._matricesTexture=null,this._indirectTexture=null,this._colorsTexture=null,this._previousMatricesTexture=null,this._initMatricesTexture(),this._initIndirectTexture()}get maxInstanceCount(){return this._maxInstanceCount}get instanceCount(){return this._instanceInfo.length-this._availableInstanceIds.length}get unusedVertexCount(){return this._maxVertexCount-this._nextVertexStart}get unusedIndexCount(){return this._maxIndexCount-this._nextIndexStart}_initMatricesTexture(){let e=Math.sqrt(this._maxInstanceCount*4);e=Math.ceil(e/4)*4,e=Math.max(e,4);let t=new Float32Array(e*e*4),n=new or(t,e,e,Ti,pi);this._matricesTexture=n}_initIndirectTexture(){let e=Math.sqrt(this._maxInstanceCount);e=Math.ceil(e);let t=new Uint32Array(e*e),n=new or(t,e,e,pl,zi);this._indirectTexture=n}_initColorsTexture(){let e=Math.sqrt(this._maxInstanceCount);e=Math.ceil(e);let t=new Float32Array(e*e*4).fill(1),n=new or(t,e,e,Ti,pi);n.colorSpace=Ct.workingColorSpace,this._colorsTexture=n}_initializeGeometry(e){let t=this.geometry,n=this._maxVertexCount,s=this._maxIndexCount;if(this._geometryInitialized===!1){for(let r in e.attributes){let o=e.getAttribute(r),{array:a,itemSize:l,normalized:c}=o,h=new a.constructor(n*l),u=new Bt(h,l,c);t.setAttribute(r,u)}if(e.getIndex()!==null){let r=n>65535?new Uint32Array(s):new Uint16Array(s);t.setIndex(new Bt(r,1))}this._geometryInitialized=!0}}_validateGeometry(e){let t=this.geometry;if(!!e.getIndex()!=!!t.getIndex())throw new Error('THREE.BatchedMesh: All geometries must consistently have "index".');for(let n in t.attributes){if(!e.hasAttribute(n))throw new Error(`THREE.BatchedMesh: Added geometry missing "${n}". All geometries must have consistent attributes.`);let s=e.getAttribute(n),r=t.getAttribute(n);if(s.itemSize!==r.itemSize||s.normalized!==r.normalized)throw new Error(`THREE.BatchedMesh: Added geometry attribute "${n}" has an inconsistent itemSize or normalized value.`)}}validateInstanceId(e){let t=this._instanceInfo;if(e<0||e>=t.length||t[e].active===!1)throw new Error(`THREE.BatchedMesh: Invalid instanceId ${e}. Instance is either out of range or has been deleted.`)}validateGeometryId(e){let t=this._geometryInfo;if(e<0||e>=t.length||t[e].active===!1)throw new Error(`THREE.BatchedMesh: Invalid geometryId ${e}. Geometry is either out of range or has been deleted.`)}setCustomSort(e){return this.customSort=e,this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Ot);let e=this.boundingBox,t=this._instanceInfo;e.makeEmpty();for(let n=0,s=t.length;n<s;n++){if(t[n].active===!1)continue;let r=t[n].geometryIndex;this.getMatrixAt(n,fi),this.getBoundingBoxAt(r,yc).applyMatrix4(fi),e.union(yc)}}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Vn);let e=this.boundingSphere,t=this._instanceInfo;e.makeEmpty();for(let n=0,s=t.length;n<s;n++){if(t[n].active===!1)continue;let r=t[n].geometryIndex;this.getMatrixAt(n,fi),this.getBoundingSphereAt(r,Cr).applyMatrix4(fi),e.union(Cr)}}addInstance(e){if(this._instanceInfo.length>=this.maxInstanceCount&&this._availableInstanceIds.length===0)throw new Error("THREE.BatchedMesh: Maximum item count reached.");let n={visible:!0,active:!0,geometryIndex:e},s=null;this._availableInstanceIds.length>0?(this._availableInstanceIds.sort(sf),s=this._availableInstanceIds.shift(),this._instanceInfo[s]=n):(s=this._instanceInfo.length,this._instanceInfo.push(n));let r=this._matricesTexture;fi.identity().toArray(r.image.data,s*16),r.needsUpdate=!0;let o=this._colorsTexture;return o&&(nb.toArray(o.image.data,s*4),o.needsUpdate=!0),this._visibilityChanged=!0,s}addGeometry(e,t=-1,n=-1){this._initializeGeometry(e),this._validateGeometry(e);let s={vertexStart:-1,vertexCount:-1,reservedVertexCount:-1,indexStart:-1,indexCount:-1,reservedIndexCount:-1,start:-1,count:-1,boundingBox:null,boundingSphere:null,active:!0},r=this._geometryInfo;s.vertexStart=this._nextVertexStart,s.reservedVertexCount=t===-1?e.getAttribute("position").count:t;let o=e.getIndex();if(o!==null&&(s.indexStart=this._nextIndexStart,s.reservedIndexCount=n===-1?o.count:n),s.indexStart!==-1&&s.indexStart+s.reservedIndexCount>this._maxIndexCount||s.vertexStart+s.reservedVertexCount>this._maxVertexCount)throw new Error("THREE.BatchedMesh: Reserved space request exceeds the maximum buffer size.");let l;return this._availableGeometryIds.length>0?(this._availableGeometryIds.sort(sf),l=this._availableGeometryIds.shift(),r[l]=s):(l=this._geometryCount,this._geometryCount++,r.push(s)),this.setGeometryAt(l,e),this._nextIndexStart=s.indexStart+s.reservedIndexCount,this._nextVertexStart=s.vertexStart+s.reservedVertexCount,l}setGeometryAt(e,t){if(e>=this._geometryCount)throw new Error("THREE.BatchedMesh: Maximum geometry count reached.");this._validateGeometry(t);let n=this.geometry,s=n.getIndex()!==null,r=n.getIndex(),o=t.getIndex(),a=this._geometryInfo[e];if(s&&o.count>a.reservedIndexCount||t.attributes.position.count>a.reservedVertexCount)throw new Error("THREE.BatchedMesh: Reserved space not large enough for provided geometry.");let l=a.vertexStart,c=a.reservedVertexCount;a.vertexCount=t.getAttribute("position").count;for(let h in n.attributes){let u=t.getAttribute(h),d=n.getAttribute(h);ob(u,d,l);let f=u.itemSize;for(let p=u.count,y=c;p<y;p++){let g=l+p;for(let m=0;m<f;m++)d.setComponent(g,m,0)}d.needsUpdate=!0,d.addUpdateRange(l*f,c*f)}if(s){let h=a.indexStart,u=a.reservedIndexCount;a.indexCount=t.getIndex().count;for(let d=0;d<o.count;d++)r.setX(h+d,l+o.getX(d));for(let d=o.count,f=u;d<f;d++)r.setX(h+d,l);r.needsUpdate=!0,r.addUpdateRange(h,a.reservedIndexCount)}return a.start=s?a.indexStart:a.vertexStart,a.count=s?a.indexCount:a.vertexCount,a.boundingBox=null,t.boundingBox!==null&&(a.boundingBox=t.boundingBox.clone()),a.boundingSphere=null,t.boundingSphere!==null&&(a.boundingSphere=t.boundingSphere.clone()),this._visibilityChanged=!0,e}deleteGeometry(e){let t=this._geometryInfo;if(e>=t.length||t[e].active===!1)return this;let n=this._instanceInfo;for(let s=0,r=n.length;s<r;s++)n[s].active&&n[s].geometryIndex===e&&this.deleteInstance(s);return t[e].active=!1,this._availableGeometryIds.push(e),this._visibilityChanged=!0,this}deleteInstance(e){return this.validateInstanceId(e),this._instanceInfo[e].active=!1,this._availableInstanceIds.push(e),this._visibilityChanged=!0,this}optimize(){let e=0,t=0,n=this._geometryInfo,s=n.map((o,a)=>a).sort((o,a)=>n[o].vertexStart-n[a].vertexStart),r=this.geometry;for(let o=0,a=n.length;o<a;o++){let l=s[o],c=n[l];if(c.active!==!1){if(r.index!==null){if(c.indexStart!==t){let{indexStart:h,vertexStart:u,reservedIndexCount:d}=c,f=r.index,p=f.array,y=e-u;for(let g=h;g<h+d;g++)p[g]=p[g]+y;f.array.copyWithin(t,h,h+d),f.addUpdateRange(t,d),f.needsUpdate=!0,c.indexStart=t}t+=c.reservedIndexCount}if(c.vertexStart!==e){let{vertexStart:h,reservedVertexCount:u}=c,d=r.attributes;for(let f in d){let p=d[f],{array:y,itemSize:g}=p;y.copyWithin(e*g,h*g,(h+u)*g),p.addUpdateRange(e*g,u*g),p.needsUpdate=!0}c.vertexStart=e}e+=c.reservedVertexCount,c.start=r.index?c.indexStart:c.vertexStart}}return this._nextIndexStart=t,this._nextVertexStart=e,this._visibilityChanged=!0,this}getBoundingBoxAt(e,t){if(e>=this._geometryCount)return null;let n=this.geometry,s=this._geometryInfo[e];if(s.boundingBox===null){let r=new Ot,o=n.index,a=n.attributes.position;for(let l=s.start,c=s.start+s.count;l<c;l++){let h=l;o&&(h=o.getX(h)),r.expandByPoint(rf.fromBufferAttribute(a,h))}s.boundingBox=r}return t.copy(s.boundingBox),t}getBoundingSphereAt(e,t){if(e>=this._geometryCount)return null;let n=this.geometry,s=this._geometryInfo[e];if(s.boundingSphere===null){let r=new Vn;this.getBoundingBoxAt(e,yc),yc.getCenter(r.center);let o=n.index,a=n.attributes.position,l=0;for(let c=s.start,h=s.start+s.count;c<h;c++){let u=c;o&&(u=o.getX(u)),rf.fromBufferAttribute(a,u),l=Math.max(l,r.center.distanceToSquared(rf))}r.radius=Math.sqrt(l),s.boundingSphere=r}return t.copy(s.boundingSphere),t}setMatrixAt(e,t){this.validateInstanceId(e);let n=this._matricesTexture,s=this._matricesTexture.image.data;return t.toArray(s,e*16),n.needsUpdate=!0,this}getMatrixAt(e,t){return this.validateInstanceId(e),t.fromArray(this._matricesTexture.image.data,e*16)}setColorAt(e,t){return this.validateInstanceId(e),this._colorsTexture===null&&this._initColorsTexture(),t.toArray(this._colorsTexture.image.data,e*4),this._colorsTexture.needsUpdate=!0,this}getColorAt(e,t){return this.validateInstanceId(e),this._colorsTexture===null?t.isVector4?t.set(1,1,1,1):t.setRGB(1,1,1):t.fromArray(this._colorsTexture.image.data,e*4)}setVisibleAt(e,t){return this.validateInstanceId(e),this._instanceInfo[e].visible===t?this:(this._instanceInfo[e].visible=t,this._visibilityChanged=!0,this)}getVisibleAt(e){return this.validateInstanceId(e),this._instanceInfo[e].visible}setGeometryIdAt(e,t){return this.validateInstanceId(e),this.validateGeometryId(t),this._instanceInfo[e].geometryIndex=t,this._visibilityChanged=!0,this}getGeometryIdAt(e){return this.validateInstanceId(e),this._instanceInfo[e].geometryIndex}getGeometryRangeAt(e,t={}){this.validateGeometryId(e);let n=this._geometryInfo[e];return t.vertexStart=n.vertexStart,t.vertexCount=n.vertexCount,t.reservedVertexCount=n.reservedVertexCount,t.indexStart=n.indexStart,t.indexCount=n.indexCount,t.reservedIndexCount=n.reservedIndexCount,t.start=n.start,t.count=n.count,t}setInstanceCount(e){let t=this._availableInstanceIds,n=this._instanceInfo;for(t.sort(sf);t[t.length-1]===n.length-1;)n.pop(),t.pop();if(e<n.length)throw new Error(`THREE.BatchedMesh: Instance ids outside the range ${e} are being used. Cannot shrink instance count.`);let s=new Int32Array(e),r=new Int32Array(e);hs(this._multiDrawCounts,s),hs(this._multiDrawStarts,r),this._multiDrawCounts=s,this._multiDrawStarts=r;let o=new Int32Array(e),a=new Int32Array(e),l=new Int32Array(e);hs(this._mergedDrawCounts,o),hs(this._mergedDrawStarts,a),hs(this._mergedDrawInstanceCounts,l),this._mergedDrawCounts=o,this._mergedDrawStarts=a,this._mergedDrawInstanceCounts=l,this._maxInstanceCount=e;let c=this._indirectTexture,h=this._matricesTexture,u=this._colorsTexture;c.dispose(),this._initIndirectTexture(),hs(c.image.data,this._indirectTexture.image.data),h.dispose(),this._initMatricesTexture(),hs(h.image.data,this._matricesTexture.image.data),u&&(u.dispose(),this._initColorsTexture(),hs(u.image.data,this._colorsTexture.image.data)),this._previousMatricesTexture!==null&&(this._previousMatricesTexture.dispose(),this._previousMatricesTexture=null)}setGeometrySize(e,t){let n=[...this._geometryInfo].filter(a=>a.active);if(Math.max(...n.map(a=>a.vertexStart+a.reservedVertexCount))>e)throw new Error(`THREE.BatchedMesh: Geometry vertex values are being used outside the range ${e}. Cannot shrink further.`);if(this.geometry.index&&Math.max(...n.map(l=>l.indexStart+l.reservedIndexCount))>t)throw new Error(`THREE.BatchedMesh: Geometry index values are being used outside the range ${t}. Cannot shrink further.`);let r=this.geometry;r.dispose(),this._maxVertexCount=e,this._maxIndexCount=t,this._geometryInitialized&&(this._geometryInitialized=!1,this.geometry=new wt,this._initializeGeometry(r));let o=this.geometry;r.index&&hs(r.index.array,o.index.array);for(let a in r.attributes)hs(r.attributes[a].array,o.attributes[a].array);this._visibilityChanged=!0}raycast(e,t){let n=this._instanceInfo,s=this._geometryInfo,r=this.matrixWorld,o=this.geometry;Zn.material=this.material,Zn.geometry.index=o.index,Zn.geometry.attributes=o.attributes,Zn.geometry.boundingBox===null&&(Zn.geometry.boundingBox=new Ot),Zn.geometry.boundingSphere===null&&(Zn.geometry.boundingSphere=new Vn);for(let a=0,l=n.length;a<l;a++){if(!n[a].visible||!n[a].active)continue;let c=n[a].geometryIndex,h=s[c];Zn.geometry.setDrawRange(h.start,h.count),this.getMatrixAt(a,Zn.matrixWorld).premultiply(r),this.getBoundingBoxAt(c,Zn.geometry.boundingBox),this.getBoundingSphereAt(c,Zn.geometry.boundingSphere),Zn.raycast(e,xc);for(let u=0,d=xc.length;u<d;u++){let f=xc[u];f.object=this,f.batchId=a,t.push(f)}xc.length=0}Zn.material=null,Zn.geometry.index=null,Zn.geometry.attributes={},Zn.geometry.setDrawRange(0,1/0)}copy(e){return super.copy(e),this.geometry=e.geometry.clone(),this.perObjectFrustumCulled=e.perObjectFrustumCulled,this.sortObjects=e.sortObjects,this.boundingBox=e.boundingBox!==null?e.boundingBox.clone():null,this.boundingSphere=e.boundingSphere!==null?e.boundingSphere.clone():null,this._geometryInfo=e._geometryInfo.map(t=>({...t,boundingBox:t.boundingBox!==null?t.boundingBox.clone():null,boundingSphere:t.boundingSphere!==null?t.boundingSphere.clone():null})),this._instanceInfo=e._instanceInfo.map(t=>({...t})),this._availableInstanceIds=e._availableInstanceIds.slice(),this._availableGeometryIds=e._availableGeometryIds.slice(),this._nextIndexStart=e._nextIndexStart,this._nextVertexStart=e._nextVertexStart,this._geometryCount=e._geometryCount,this._maxInstanceCount=e._maxInstanceCount,this._maxVertexCount=e._maxVertexCount,this._maxIndexCount=e._maxIndexCount,this._geometryInitialized=e._geometryInitialized,this._multiDrawCounts=e._multiDrawCounts.slice(),this._multiDrawStarts=e._multiDrawStarts.slice(),this._multiDrawBytesPerElement=e._multiDrawBytesPerElement,this._mergedDrawCounts=e._mergedDrawCounts.slice(),this._mergedDrawStarts=e._mergedDrawStarts.slice(),this._mergedDrawInstanceCounts=e._mergedDrawInstanceCounts.slice(),this._indirectTexture=e._indirectTexture.clone(),this._indirectTexture.image.data=this._indirectTexture.image.data.slice(),this._matricesTexture=e._matricesTexture.clone(),this._matricesTexture.image.data=this._matricesTexture.image.data.slice(),e._colorsTexture!==null?(this._colorsTexture=e._colorsTexture.clone(),this._colorsTexture.image.data=this._colorsTexture.image.data.slice()):this._colorsTexture=null,this}dispose(){super.dispose(),this.geometry.dispose(),this._matricesTexture.dispose(),this._matricesTexture=null,this._indirectTexture.dispose(),this._indirectTexture=null,this._colorsTexture!==null&&(this._colorsTexture.dispose(),this._colorsTexture=null),this._previousMatricesTexture!==null&&(this._previousMatricesTexture.dispose(),this._previousMatricesTexture=null)}_updateDrawParameters(e,t,n,s="multiDraw"){if(!this._visibilityChanged&&!this.perObjectFrustumCulled&&!this.sortObjects)return;let r=t.getIndex(),o=r===null?1:r.array.BYTES_PER_ELEMENT,a=1;n.wireframe&&(a=2,o=t.attributes.position.count>65535?4:2);let l=this._instanceInfo,c=this._multiDrawStarts,h=this._multiDrawCounts,u=this._mergedDrawStarts,d=this._mergedDrawCounts,f=this._mergedDrawInstanceCounts,p=this._geometryInfo,y=this.perObjectFrustumCulled,g=this._indirectTexture,m=g.image.data,x=e.isArrayCamera?sb:ib;y&&(e.isArrayCamera?x.setFromArrayCamera(e):(fi.multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse).multiply(this.matrixWorld),x.setFromProjectionMatrix(fi,e.coordinateSystem,e.reversedDepth)));let M=0,_=0;if(this.sortObjects){fi.copy(this.matrixWorld).invert(),mg.setFromMatrixPosition(e.matrixWorld).applyMatrix4(fi),gg.set(0,0,-1).transformDirection(e.matrixWorld).transformDirection(fi);for(let v=0,E=l.length;v<E;v++)if(l[v].visible&&l[v].active){let N=l[v].geometryIndex;this.getMatrixAt(v,fi),this.getBoundingSphereAt(N,Cr).applyMatrix4(fi);let P=!1;if(y&&(P=!x.intersectsSphere(Cr)),!P){let I=p[N],k=rb.subVectors(Cr.center,mg).dot(gg);of.push(I.start,I.count,k,v)}}let C=of.list,T=this.customSort;T===null?C.sort(n.transparent?tb:eb):T.call(this,C,e);for(let v=0,E=C.length;v<E;v++){let N=C[v],P=N.start*o*a,I=N.count*a;s==="merged"?_>0&&u[_-1]===P&&d[_-1]===I?f[_-1]++:(u[_]=P,d[_]=I,f[_]=1,_++):(c[M]=P,h[M]=I),m[M]=N.index,M++}of.reset()}else for(let C=0,T=l.length;C<T;C++)if(l[C].visible&&l[C].active){let v=l[C].geometryIndex,E=!1;if(y&&(this.getMatrixAt(C,fi),this.getBoundingSphereAt(v,Cr).applyMatrix4(fi),E=!x.intersectsSphere(Cr)),!E){let N=p[v],P=N.start*o*a,I=N.count*a;s==="merged"?_>0&&u[_-1]===P&&d[_-1]===I?f[_-1]++:(u[_]=P,d[_]=I,f[_]=1,_++):(c[M]=P,h[M]=I),m[M]=C,M++}}g.needsUpdate=!0,this._multiDrawCount=M,this._mergedDrawCount=_,this._multiDrawBytesPerElement=o,this._visibilityChanged=!1}onBeforeRender(e,t,n,s,r){e.isWebGPURenderer===!0?(this._visibilityChanged||this.perObjectFrustumCulled||this.sortObjects)&&(this._indirectTexture.needsUpdate=!0):this._updateDrawParameters(n,s,r)}onBeforeShadow(e,t,n,s,r,o){e.isWebGPURenderer!==!0&&this._updateDrawParameters(s,r,o)}},Jn=class extends Ki{constructor(e){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new et(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.linewidth=e.linewidth,this.linecap=e.linecap,this.linejoin=e.linejoin,this.fog=e.fog,this}},Xc=new S,qc=new S,yg=new Qe,_a=new ar,vc=new Vn,af=new S,xg=new S,ps=class extends cn{constructor(e=new wt,t=new Jn){super(),this.isLine=!0,this.type="Line",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,n=[0];for(let s=1,r=t.count;s<r;s++)Xc.fromBufferAttribute(t,s-1),qc.fromBufferAttribute(t,s),n[s]=n[s-1],n[s]+=Xc.distanceTo(qc);e.setAttribute("lineDistance",new ot(n,1))}else it("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,s=this.matrixWorld,r=e.params.Line.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),vc.copy(n.boundingSphere),vc.applyMatrix4(s),vc.radius+=r,e.ray.intersectsSphere(vc)===!1)return;yg.copy(s).invert(),_a.copy(e.ray).applyMatrix4(yg);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,h=n.index,d=n.attributes.position;if(h!==null){let f=Math.max(0,o.start),p=Math.min(h.count,o.start+o.count);for(let y=f,g=p-1;y<g;y+=c){let m=h.getX(y),x=h.getX(y+1),M=_c(this,e,_a,l,m,x,y);M&&t.push(M)}if(this.isLineLoop){let y=h.getX(p-1),g=h.getX(f),m=_c(this,e,_a,l,y,g,p-1);m&&t.push(m)}}else{let f=Math.max(0,o.start),p=Math.min(d.count,o.start+o.count);for(let y=f,g=p-1;y<g;y+=c){let m=_c(this,e,_a,l,y,y+1,y);m&&t.push(m)}if(this.isLineLoop){let y=_c(this,e,_a,l,p-1,f,p-1);y&&t.push(y)}}}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let s=t[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function _c(i,e,t,n,s,r,o){let a=i.geometry.attributes.position;if(Xc.fromBufferAttribute(a,s),qc.fromBufferAttribute(a,r),t.distanceSqToSegment(Xc,qc,af,xg)>n)return;af.applyMatrix4(i.matrixWorld);let c=e.ray.origin.distanceTo(af);if(!(c<e.near||c>e.far))return{distance:c,point:xg.clone().applyMatrix4(i.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:i}}var vg=new S,_g=new S,Os=class extends ps{constructor(e,t){super(e,t),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,n=[];for(let s=0,r=t.count;s<r;s+=2)vg.fromBufferAttribute(t,s),_g.fromBufferAttribute(t,s+1),n[s]=s===0?0:n[s-1],n[s+1]=n[s]+vg.distanceTo(_g);e.setAttribute("lineDistance",new ot(n,1))}else it("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var Ba=class extends mi{constructor(e=[],t=Fr,n,s,r,o,a,l,c,h){super(e,t,n,s,r,o,a,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(e){this.image=e}};var Bs=class extends mi{constructor(e,t,n=zi,s,r,o,a=kn,l=kn,c,h=Fs,u=1){if(h!==Fs&&h!==Gs)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let d={width:e,height:t,depth:u};super(d,s,r,o,a,l,h,n,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(e){return super.copy(e),this.source=new Ro(Object.assign({},e.image)),this.compareFunction=e.compareFunction,this}toJSON(e){let t=super.toJSON(e);return t.compareFunction=this.compareFunction,t}},ka=class extends Bs{constructor(e,t=zi,n=Fr,s,r,o=kn,a=kn,l,c=Fs){let h={width:e,height:e,depth:1},u=[h,h,h,h,h,h];super(e,e,t,n,s,r,o,a,l,c),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(e){this.image=e}},Ha=class extends mi{constructor(e=null){super(),this.sourceTexture=e,this.isExternalTexture=!0}copy(e){return super.copy(e),this.sourceTexture=e.sourceTexture,this}},pn=class i extends wt{constructor(e=1,t=1,n=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:e,height:t,depth:n,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],h=[],u=[],d=0,f=0;p("z","y","x",-1,-1,n,t,e,o,r,0),p("z","y","x",1,-1,n,t,-e,o,r,1),p("x","z","y",1,1,e,n,t,s,o,2),p("x","z","y",1,-1,e,n,-t,s,o,3),p("x","y","z",1,-1,e,t,n,s,r,4),p("x","y","z",-1,-1,e,t,-n,s,r,5),this.setIndex(l),this.setAttribute("position",new ot(c,3)),this.setAttribute("normal",new ot(h,3)),this.setAttribute("uv",new ot(u,2));function p(y,g,m,x,M,_,C,T,v,E,N){let P=_/v,I=C/E,k=_/2,V=C/2,F=T/2,z=v+1,Y=E+1,G=0,ce=0,J=new S;for(let Q=0;Q<Y;Q++){let te=Q*I-V;for(let pe=0;pe<z;pe++){let he=pe*P-k;J[y]=he*x,J[g]=te*M,J[m]=F,c.push(J.x,J.y,J.z),J[y]=0,J[g]=0,J[m]=T>0?1:-1,h.push(J.x,J.y,J.z),u.push(pe/v),u.push(1-Q/E),G+=1}}for(let Q=0;Q<E;Q++)for(let te=0;te<v;te++){let pe=d+te+z*Q,he=d+te+z*(Q+1),ee=d+(te+1)+z*(Q+1),ye=d+(te+1)+z*Q;l.push(pe,he,ye),l.push(he,ee,ye),ce+=6}a.addGroup(f,ce,N),f+=ce,d+=G}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.width,e.height,e.depth,e.widthSegments,e.heightSegments,e.depthSegments)}},za=class i extends wt{constructor(e=1,t=1,n=4,s=8,r=1){super(),this.type="CapsuleGeometry",this.parameters={radius:e,height:t,capSegments:n,radialSegments:s,heightSegments:r},t=Math.max(0,t),n=Math.max(1,Math.floor(n)),s=Math.max(3,Math.floor(s)),r=Math.max(1,Math.floor(r));let o=[],a=[],l=[],c=[],h=t/2,u=Math.PI/2*e,d=t,f=2*u+d,p=n*2+r,y=s+1,g=new S,m=new S;for(let x=0;x<=p;x++){let M=0,_=0,C=0,T=0;if(x<=n){let N=x/n,P=N*Math.PI/2;_=-h-e*Math.cos(P),C=e*Math.sin(P),T=-e*Math.cos(P),M=N*u}else if(x<=n+r){let N=(x-n)/r;_=-h+N*t,C=e,T=0,M=u+N*d}else{let N=(x-n-r)/n,P=N*Math.PI/2;_=h+e*Math.sin(P),C=e*Math.cos(P),T=e*Math.sin(P),M=u+d+N*u}let v=Math.max(0,Math.min(1,M/f)),E=0;x===0?E=.5/s:x===p&&(E=-.5/s);for(let N=0;N<=s;N++){let P=N/s,I=P*Math.PI*2,k=Math.sin(I),V=Math.cos(I);m.x=-C*V,m.y=_,m.z=C*k,a.push(m.x,m.y,m.z),g.set(-C*V,T,C*k),g.normalize(),l.push(g.x,g.y,g.z),c.push(P+E,v)}if(x>0){let N=(x-1)*y;for(let P=0;P<s;P++){let I=N+P,k=N+P+1,V=x*y+P,F=x*y+P+1;o.push(I,k,V),o.push(k,F,V)}}}this.setIndex(o),this.setAttribute("position",new ot(a,3)),this.setAttribute("normal",new ot(l,3)),this.setAttribute("uv",new ot(c,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.radius,e.height,e.capSegments,e.radialSegments,e.heightSegments)}};var Kt=class i extends wt{constructor(e=1,t=1,n=1,s=32,r=1,o=!1,a=0,l=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:e,radiusBottom:t,height:n,radialSegments:s,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:l};let c=this;s=Math.floor(s),r=Math.floor(r);let h=[],u=[],d=[],f=[],p=0,y=[],g=n/2,m=0;x(),o===!1&&(e>0&&M(!0),t>0&&M(!1)),this.setIndex(h),this.setAttribute("position",new ot(u,3)),this.setAttribute("normal",new ot(d,3)),this.setAttribute("uv",new ot(f,2));function x(){let _=new S,C=new S,T=0,v=(t-e)/n;for(let E=0;E<=r;E++){let N=[],P=E/r,I=P*(t-e)+e;for(let k=0;k<=s;k++){let V=k/s,F=V*l+a,z=Math.sin(F),Y=Math.cos(F);C.x=I*z,C.y=-P*n+g,C.z=I*Y,u.push(C.x,C.y,C.z),_.set(z,v,Y).normalize(),d.push(_.x,_.y,_.z),f.push(V,1-P),N.push(p++)}y.push(N)}for(let E=0;E<s;E++)for(let N=0;N<r;N++){let P=y[N][E],I=y[N+1][E],k=y[N+1][E+1],V=y[N][E+1];(e>0||N!==0)&&(h.push(P,I,V),T+=3),(t>0||N!==r-1)&&(h.push(I,k,V),T+=3)}c.addGroup(m,T,0),m+=T}function M(_){let C=p,T=new ue,v=new S,E=0,N=_===!0?e:t,P=_===!0?1:-1;for(let k=1;k<=s;k++)u.push(0,g*P,0),d.push(0,P,0),f.push(.5,.5),p++;let I=p;for(let k=0;k<=s;k++){let F=k/s*l+a,z=Math.cos(F),Y=Math.sin(F);v.x=N*Y,v.y=g*P,v.z=N*z,u.push(v.x,v.y,v.z),d.push(0,P,0),T.x=z*.5+.5,T.y=Y*.5*P+.5,f.push(T.x,T.y),p++}for(let k=0;k<s;k++){let V=C+k,F=I+k;_===!0?h.push(F,F+1,V):h.push(F+1,F,V),E+=3}c.addGroup(m,E,_===!0?1:2),m+=E}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.radiusTop,e.radiusBottom,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}},gi=class i extends Kt{constructor(e=1,t=1,n=32,s=1,r=!1,o=0,a=Math.PI*2){super(0,e,t,n,s,r,o,a),this.type="ConeGeometry",this.parameters={radius:e,height:t,radialSegments:n,heightSegments:s,openEnded:r,thetaStart:o,thetaLength:a}}static fromJSON(e){return new i(e.radius,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}},Yc=class i extends wt{constructor(e=[],t=[],n=1,s=0){super(),this.type="PolyhedronGeometry",this.parameters={vertices:e,indices:t,radius:n,detail:s};let r=[],o=[];a(s),c(n),h(),this.setAttribute("position",new ot(r,3)),this.setAttribute("normal",new ot(r.slice(),3)),this.setAttribute("uv",new ot(o,2)),s===0?this.computeVertexNormals():this.normalizeNormals();function a(x){let M=new S,_=new S,C=new S;for(let T=0;T<t.length;T+=3)f(t[T+0],M),f(t[T+1],_),f(t[T+2],C),l(M,_,C,x)}function l(x,M,_,C){let T=C+1,v=[];for(let E=0;E<=T;E++){v[E]=[];let N=x.clone().lerp(_,E/T),P=M.clone().lerp(_,E/T),I=T-E;for(let k=0;k<=I;k++)k===0&&E===T?v[E][k]=N:v[E][k]=N.clone().lerp(P,k/I)}for(let E=0;E<T;E++)for(let N=0;N<2*(T-E)-1;N++){let P=Math.floor(N/2);N%2===0?(d(v[E][P+1]),d(v[E+1][P]),d(v[E][P])):(d(v[E][P+1]),d(v[E+1][P+1]),d(v[E+1][P]))}}function c(x){let M=new S;for(let _=0;_<r.length;_+=3)M.x=r[_+0],M.y=r[_+1],M.z=r[_+2],M.normalize().multiplyScalar(x),r[_+0]=M.x,r[_+1]=M.y,r[_+2]=M.z}function h(){let x=new S;for(let M=0;M<r.length;M+=3){x.x=r[M+0],x.y=r[M+1],x.z=r[M+2];let _=g(x)/2/Math.PI+.5,C=m(x)/Math.PI+.5;o.push(_,1-C)}p(),u()}function u(){for(let x=0;x<o.length;x+=6){let M=o[x+0],_=o[x+2],C=o[x+4],T=Math.max(M,_,C),v=Math.min(M,_,C);T>.9&&v<.1&&(M<.2&&(o[x+0]+=1),_<.2&&(o[x+2]+=1),C<.2&&(o[x+4]+=1))}}function d(x){r.push(x.x,x.y,x.z)}function f(x,M){let _=x*3;M.x=e[_+0],M.y=e[_+1],M.z=e[_+2]}function p(){let x=new S,M=new S,_=new S,C=new S,T=new ue,v=new ue,E=new ue;for(let N=0,P=0;N<r.length;N+=9,P+=6){x.set(r[N+0],r[N+1],r[N+2]),M.set(r[N+3],r[N+4],r[N+5]),_.set(r[N+6],r[N+7],r[N+8]),T.set(o[P+0],o[P+1]),v.set(o[P+2],o[P+3]),E.set(o[P+4],o[P+5]),C.copy(x).add(M).add(_).divideScalar(3);let I=g(C);y(T,P+0,x,I),y(v,P+2,M,I),y(E,P+4,_,I)}}function y(x,M,_,C){C<0&&x.x===1&&(o[M]=x.x-1),_.x===0&&_.z===0&&(o[M]=C/2/Math.PI+.5)}function g(x){return Math.atan2(x.z,-x.x)}function m(x){return Math.atan2(-x.y,Math.sqrt(x.x*x.x+x.z*x.z))}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.vertices,e.indices,e.radius,e.detail)}};var bc=new S,Mc=new S,lf=new S,Sc=new Ls,Va=class extends wt{constructor(e=null,t=1){if(super(),this.type="EdgesGeometry",this.parameters={geometry:e,thresholdAngle:t},e!==null){let s=Math.pow(10,4),r=Math.cos(Mo*t),o=e.getIndex(),a=e.getAttribute("position"),l=o?o.count:a.count,c=[0,0,0],h=["a","b","c"],u=new Array(3),d=new Map,f=[];for(let p=0;p<l;p+=3){o?(c[0]=o.getX(p),c[1]=o.getX(p+1),c[2]=o.getX(p+2)):(c[0]=p,c[1]=p+1,c[2]=p+2);let{a:y,b:g,c:m}=Sc;if(y.fromBufferAttribute(a,c[0]),g.fromBufferAttribute(a,c[1]),m.fromBufferAttribute(a,c[2]),Sc.getNormal(lf),u[0]=`${Math.round(y.x*s)},${Math.round(y.y*s)},${Math.round(y.z*s)}`,u[1]=`${Math.round(g.x*s)},${Math.round(g.y*s)},${Math.round(g.z*s)}`,u[2]=`${Math.round(m.x*s)},${Math.round(m.y*s)},${Math.round(m.z*s)}`,!(u[0]===u[1]||u[1]===u[2]||u[2]===u[0]))for(let x=0;x<3;x++){let M=(x+1)%3,_=u[x],C=u[M],T=Sc[h[x]],v=Sc[h[M]],E=`${_}_${C}`,N=`${C}_${_}`,P=d.get(N);P?(lf.dot(P.normal)<=r&&(f.push(T.x,T.y,T.z),f.push(v.x,v.y,v.z)),d.set(N,null)):d.has(E)||d.set(E,{index0:c[x],index1:c[M],normal:lf.clone()})}}for(let p of d.values())if(p){let{index0:y,index1:g}=p;bc.fromBufferAttribute(a,y),Mc.fromBufferAttribute(a,g),f.push(bc.x,bc.y,bc.z),f.push(Mc.x,Mc.y,Mc.z)}this.setAttribute("position",new ot(f,3))}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}},Ri=class{constructor(){this.type="Curve",this.arcLengthDivisions=200,this.needsUpdate=!1,this.cacheArcLengths=null}getPoint(){it("Curve: .getPoint() not implemented.")}getPointAt(e,t){let n=this.getUtoTmapping(e);return this.getPoint(n,t)}getPoints(e=5){let t=[];for(let n=0;n<=e;n++)t.push(this.getPoint(n/e));return t}getSpacedPoints(e=5){let t=[];for(let n=0;n<=e;n++)t.push(this.getPointAt(n/e));return t}getLength(){let e=this.getLengths();return e[e.length-1]}getLengths(e=this.arcLengthDivisions){if(this.cacheArcLengths&&this.cacheArcLengths.length===e+1&&!this.needsUpdate)return this.cacheArcLengths;this.needsUpdate=!1;let t=[],n,s=this.getPoint(0),r=0;t.push(0);for(let o=1;o<=e;o++)n=this.getPoint(o/e),r+=n.distanceTo(s),t.push(r),s=n;return this.cacheArcLengths=t,t}updateArcLengths(){this.needsUpdate=!0,this.getLengths()}getUtoTmapping(e,t=null){let n=this.getLengths(),s=0,r=n.length,o;t?o=t:o=e*n[r-1];let a=0,l=r-1,c;for(;a<=l;)if(s=Math.floor(a+(l-a)/2),c=n[s]-o,c<0)a=s+1;else if(c>0)l=s-1;else{l=s;break}if(s=l,n[s]===o)return s/(r-1);let h=n[s],d=n[s+1]-h,f=(o-h)/d;return(s+f)/(r-1)}getTangent(e,t){let s=e-1e-4,r=e+1e-4;s<0&&(s=0),r>1&&(r=1);let o=this.getPoint(s),a=this.getPoint(r),l=t||(o.isVector2?new ue:new S);return l.copy(a).sub(o).normalize(),l}getTangentAt(e,t){let n=this.getUtoTmapping(e);return this.getTangent(n,t)}computeFrenetFrames(e,t=!1){let n=new S,s=[],r=[],o=[],a=new S,l=new Qe;for(let f=0;f<=e;f++){let p=f/e;s[f]=this.getTangentAt(p,new S)}r[0]=new S,o[0]=new S;let c=Number.MAX_VALUE,h=Math.abs(s[0].x),u=Math.abs(s[0].y),d=Math.abs(s[0].z);h<=c&&(c=h,n.set(1,0,0)),u<=c&&(c=u,n.set(0,1,0)),d<=c&&n.set(0,0,1),a.crossVectors(s[0],n).normalize(),r[0].crossVectors(s[0],a),o[0].crossVectors(s[0],r[0]);for(let f=1;f<=e;f++){if(r[f]=r[f-1].clone(),o[f]=o[f-1].clone(),a.crossVectors(s[f-1],s[f]),a.length()>Number.EPSILON){a.normalize();let p=Math.acos(mt(s[f-1].dot(s[f]),-1,1));r[f].applyMatrix4(l.makeRotationAxis(a,p))}o[f].crossVectors(s[f],r[f])}if(t===!0){let f=Math.acos(mt(r[0].dot(r[e]),-1,1));f/=e,s[0].dot(a.crossVectors(r[0],r[e]))>0&&(f=-f);for(let p=1;p<=e;p++)r[p].applyMatrix4(l.makeRotationAxis(s[p],f*p)),o[p].crossVectors(s[p],r[p])}return{tangents:s,normals:r,binormals:o}}clone(){return new this.constructor().copy(this)}copy(e){return this.arcLengthDivisions=e.arcLengthDivisions,this.cacheArcLengths=null,this}toJSON(){let e={metadata:{version:4.7,type:"Curve",generator:"Curve.toJSON"}};return e.arcLengthDivisions=this.arcLengthDivisions,e.type=this.type,e}fromJSON(e){return this.arcLengthDivisions=e.arcLengthDivisions,this.cacheArcLengths=null,this}},Lo=class extends Ri{constructor(e=0,t=0,n=1,s=1,r=0,o=Math.PI*2,a=!1,l=0){super(),this.isEllipseCurve=!0,this.type="EllipseCurve",this.aX=e,this.aY=t,this.xRadius=n,this.yRadius=s,this.aStartAngle=r,this.aEndAngle=o,this.aClockwise=a,this.aRotation=l}getPoint(e,t=new ue){let n=t,s=Math.PI*2,r=this.aEndAngle-this.aStartAngle,o=Math.abs(r)<Number.EPSILON;for(;r<0;)r+=s;for(;r>s;)r-=s;r<Number.EPSILON&&(o?r=0:r=s),this.aClockwise===!0&&!o&&(r===s?r=-s:r=r-s);let a=this.aStartAngle+e*r,l=this.aX+this.xRadius*Math.cos(a),c=this.aY+this.yRadius*Math.sin(a);if(this.aRotation!==0){let h=Math.cos(this.aRotation),u=Math.sin(this.aRotation),d=l-this.aX,f=c-this.aY;l=d*h-f*u+this.aX,c=d*u+f*h+this.aY}return n.set(l,c)}copy(e){return super.copy(e),this.aX=e.aX,this.aY=e.aY,this.xRadius=e.xRadius,this.yRadius=e.yRadius,this.aStartAngle=e.aStartAngle,this.aEndAngle=e.aEndAngle,this.aClockwise=e.aClockwise,this.aRotation=e.aRotation,this}toJSON(){let e=super.toJSON();return e.aX=this.aX,e.aY=this.aY,e.xRadius=this.xRadius,e.yRadius=this.yRadius,e.aStartAngle=this.aStartAngle,e.aEndAngle=this.aEndAngle,e.aClockwise=this.aClockwise,e.aRotation=this.aRotation,e}fromJSON(e){return super.fromJSON(e),this.aX=e.aX,this.aY=e.aY,this.xRadius=e.xRadius,this.yRadius=e.yRadius,this.aStartAngle=e.aStartAngle,this.aEndAngle=e.aEndAngle,this.aClockwise=e.aClockwise,this.aRotation=e.aRotation,this}},$c=class extends Lo{constructor(e,t,n,s,r,o){super(e,t,n,n,s,r,o),this.isArcCurve=!0,this.type="ArcCurve"}};function np(){let i=0,e=0,t=0,n=0;function s(r,o,a,l){i=r,e=a,t=-3*r+3*o-2*a-l,n=2*r-2*o+a+l}return{initCatmullRom:function(r,o,a,l,c){s(o,a,c*(a-r),c*(l-o))},initNonuniformCatmullRom:function(r,o,a,l,c,h,u){let d=(o-r)/c-(a-r)/(c+h)+(a-o)/h,f=(a-o)/h-(l-o)/(h+u)+(l-a)/u;d*=h,f*=h,s(o,a,d,f)},calc:function(r){let o=r*r,a=o*r;return i+e*r+t*o+n*a}}}var bg=new S,Mg=new S,cf=new np,hf=new np,uf=new np,lr=class extends Ri{constructor(e=[],t=!1,n="centripetal",s=.5){super(),this.isCatmullRomCurve3=!0,this.type="CatmullRomCurve3",this.points=e,this.closed=t,this.curveType=n,this.tension=s}getPoint(e,t=new S){let n=t,s=this.points,r=s.length,o=(r-(this.closed?0:1))*e,a=Math.floor(o),l=o-a;this.closed?a+=a>0?0:(Math.floor(Math.abs(a)/r)+1)*r:l===0&&a===r-1&&(a=r-2,l=1);let c,h;this.closed||a>0?c=s[(a-1)%r]:(Mg.subVectors(s[0],s[1]).add(s[0]),c=Mg);let u=s[a%r],d=s[(a+1)%r];if(this.closed||a+2<r?h=s[(a+2)%r]:(bg.subVectors(s[r-1],s[r-2]).add(s[r-1]),h=bg),this.curveType==="centripetal"||this.curveType==="chordal"){let f=this.curveType==="chordal"?.5:.25,p=Math.pow(c.distanceToSquared(u),f),y=Math.pow(u.distanceToSquared(d),f),g=Math.pow(d.distanceToSquared(h),f);y<1e-4&&(y=1),p<1e-4&&(p=y),g<1e-4&&(g=y),cf.initNonuniformCatmullRom(c.x,u.x,d.x,h.x,p,y,g),hf.initNonuniformCatmullRom(c.y,u.y,d.y,h.y,p,y,g),uf.initNonuniformCatmullRom(c.z,u.z,d.z,h.z,p,y,g)}else this.curveType==="catmullrom"&&(cf.initCatmullRom(c.x,u.x,d.x,h.x,this.tension),hf.initCatmullRom(c.y,u.y,d.y,h.y,this.tension),uf.initCatmullRom(c.z,u.z,d.z,h.z,this.tension));return n.set(cf.calc(l),hf.calc(l),uf.calc(l)),n}copy(e){super.copy(e),this.points=[];for(let t=0,n=e.points.length;t<n;t++){let s=e.points[t];this.points.push(s.clone())}return this.closed=e.closed,this.curveType=e.curveType,this.tension=e.tension,this}toJSON(){let e=super.toJSON();e.points=[];for(let t=0,n=this.points.length;t<n;t++){let s=this.points[t];e.points.push(s.toArray())}return e.closed=this.closed,e.curveType=this.curveType,e.tension=this.tension,e}fromJSON(e){super.fromJSON(e),this.points=[];for(let t=0,n=e.points.length;t<n;t++){let s=e.points[t];this.points.push(new S().fromArray(s))}return this.closed=e.closed,this.curveType=e.curveType,this.tension=e.tension,this}};function Sg(i,e,t,n,s){let r=(n-e)*.5,o=(s-t)*.5,a=i*i,l=i*a;return(2*t-2*n+r+o)*l+(-3*t+3*n-2*r-o)*a+r*i+t}function ab(i,e){let t=1-i;return t*t*e}function lb(i,e){return 2*(1-i)*i*e}function cb(i,e){return i*i*e}function Ea(i,e,t,n){return ab(i,e)+lb(i,t)+cb(i,n)}function hb(i,e){let t=1-i;return t*t*t*e}function ub(i,e){let t=1-i;return 3*t*t*i*e}function db(i,e){return 3*(1-i)*i*i*e}function fb(i,e){return i*i*i*e}function wa(i,e,t,n,s){return hb(i,e)+ub(i,t)+db(i,n)+fb(i,s)}var Ga=class extends Ri{constructor(e=new ue,t=new ue,n=new ue,s=new ue){super(),this.isCubicBezierCurve=!0,this.type="CubicBezierCurve",this.v0=e,this.v1=t,this.v2=n,this.v3=s}getPoint(e,t=new ue){let n=t,s=this.v0,r=this.v1,o=this.v2,a=this.v3;return n.set(wa(e,s.x,r.x,o.x,a.x),wa(e,s.y,r.y,o.y,a.y)),n}copy(e){return super.copy(e),this.v0.copy(e.v0),this.v1.copy(e.v1),this.v2.copy(e.v2),this.v3.copy(e.v3),this}toJSON(){let e=super.toJSON();return e.v0=this.v0.toArray(),e.v1=this.v1.toArray(),e.v2=this.v2.toArray(),e.v3=this.v3.toArray(),e}fromJSON(e){return super.fromJSON(e),this.v0.fromArray(e.v0),this.v1.fromArray(e.v1),this.v2.fromArray(e.v2),this.v3.fromArray(e.v3),this}},Zc=class extends Ri{constructor(e=new S,t=new S,n=new S,s=new S){super(),this.isCubicBezierCurve3=!0,this.type="CubicBezierCurve3",this.v0=e,this.v1=t,this.v2=n,this.v3=s}getPoint(e,t=new S){let n=t,s=this.v0,r=this.v1,o=this.v2,a=this.v3;return n.set(wa(e,s.x,r.x,o.x,a.x),wa(e,s.y,r.y,o.y,a.y),wa(e,s.z,r.z,o.z,a.z)),n}copy(e){return super.copy(e),this.v0.copy(e.v0),this.v1.copy(e.v1),this.v2.copy(e.v2),this.v3.copy(e.v3),this}toJSON(){let e=super.toJSON();return e.v0=this.v0.toArray(),e.v1=this.v1.toArray(),e.v2=this.v2.toArray(),e.v3=this.v3.toArray(),e}fromJSON(e){return super.fromJSON(e),this.v0.fromArray(e.v0),this.v1.fromArray(e.v1),this.v2.fromArray(e.v2),this.v3.fromArray(e.v3),this}},Wa=class extends Ri{constructor(e=new ue,t=new ue){super(),this.isLineCurve=!0,this.type="LineCurve",this.v1=e,this.v2=t}getPoint(e,t=new ue){let n=t;return e===1?n.copy(this.v2):(n.copy(this.v2).sub(this.v1),n.multiplyScalar(e).add(this.v1)),n}getPointAt(e,t){return this.getPoint(e,t)}getTangent(e,t=new ue){return t.subVectors(this.v2,this.v1).normalize()}getTangentAt(e,t){return this.getTangent(e,t)}copy(e){return super.copy(e),this.v1.copy(e.v1),this.v2.copy(e.v2),this}toJSON(){let e=super.toJSON();return e.v1=this.v1.toArray(),e.v2=this.v2.toArray(),e}fromJSON(e){return super.fromJSON(e),this.v1.fromArray(e.v1),this.v2.fromArray(e.v2),this}},Jc=class extends Ri{constructor(e=new S,t=new S){super(),this.isLineCurve3=!0,this.type="LineCurve3",this.v1=e,this.v2=t}getPoint(e,t=new S){let n=t;return e===1?n.copy(this.v2):(n.copy(this.v2).sub(this.v1),n.multiplyScalar(e).add(this.v1)),n}getPointAt(e,t){return this.getPoint(e,t)}getTangent(e,t=new S){return t.subVectors(this.v2,this.v1).normalize()}getTangentAt(e,t){return this.getTangent(e,t)}copy(e){return super.copy(e),this.v1.copy(e.v1),this.v2.copy(e.v2),this}toJSON(){let e=super.toJSON();return e.v1=this.v1.toArray(),e.v2=this.v2.toArray(),e}fromJSON(e){return super.fromJSON(e),this.v1.fromArray(e.v1),this.v2.fromArray(e.v2),this}},Xa=class extends Ri{constructor(e=new ue,t=new ue,n=new ue){super(),this.isQuadraticBezierCurve=!0,this.type="QuadraticBezierCurve",this.v0=e,this.v1=t,this.v2=n}getPoint(e,t=new ue){let n=t,s=this.v0,r=this.v1,o=this.v2;return n.set(Ea(e,s.x,r.x,o.x),Ea(e,s.y,r.y,o.y)),n}copy(e){return super.copy(e),this.v0.copy(e.v0),this.v1.copy(e.v1),this.v2.copy(e.v2),this}toJSON(){let e=super.toJSON();return e.v0=this.v0.toArray(),e.v1=this.v1.toArray(),e.v2=this.v2.toArray(),e}fromJSON(e){return super.fromJSON(e),this.v0.fromArray(e.v0),this.v1.fromArray(e.v1),this.v2.fromArray(e.v2),this}},qa=class extends Ri{constructor(e=new S,t=new S,n=new S){super(),this.isQuadraticBezierCurve3=!0,this.type="QuadraticBezierCurve3",this.v0=e,this.v1=t,this.v2=n}getPoint(e,t=new S){let n=t,s=this.v0,r=this.v1,o=this.v2;return n.set(Ea(e,s.x,r.x,o.x),Ea(e,s.y,r.y,o.y),Ea(e,s.z,r.z,o.z)),n}copy(e){return super.copy(e),this.v0.copy(e.v0),this.v1.copy(e.v1),this.v2.copy(e.v2),this}toJSON(){let e=super.toJSON();return e.v0=this.v0.toArray(),e.v1=this.v1.toArray(),e.v2=this.v2.toArray(),e}fromJSON(e){return super.fromJSON(e),this.v0.fromArray(e.v0),this.v1.fromArray(e.v1),this.v2.fromArray(e.v2),this}},Ya=class extends Ri{constructor(e=[]){super(),this.isSplineCurve=!0,this.type="SplineCurve",this.points=e}getPoint(e,t=new ue){let n=t,s=this.points,r=(s.length-1)*e,o=Math.floor(r),a=r-o,l=s[o===0?o:o-1],c=s[o],h=s[o>s.length-2?s.length-1:o+1],u=s[o>s.length-3?s.length-1:o+2];return n.set(Sg(a,l.x,c.x,h.x,u.x),Sg(a,l.y,c.y,h.y,u.y)),n}copy(e){super.copy(e),this.points=[];for(let t=0,n=e.points.length;t<n;t++){let s=e.points[t];this.points.push(s.clone())}return this}toJSON(){let e=super.toJSON();e.points=[];for(let t=0,n=this.points.length;t<n;t++){let s=this.points[t];e.points.push(s.toArray())}return e}fromJSON(e){super.fromJSON(e),this.points=[];for(let t=0,n=e.points.length;t<n;t++){let s=e.points[t];this.points.push(new ue().fromArray(s))}return this}},Kc=Object.freeze({__proto__:null,ArcCurve:$c,CatmullRomCurve3:lr,CubicBezierCurve:Ga,CubicBezierCurve3:Zc,EllipseCurve:Lo,LineCurve:Wa,LineCurve3:Jc,QuadraticBezierCurve:Xa,QuadraticBezierCurve3:qa,SplineCurve:Ya}),jc=class extends Ri{constructor(){super(),this.type="CurvePath",this.curves=[],this.autoClose=!1,this.cacheLengths=null}add(e){this.curves.push(e)}closePath(){let e=this.curves[0].getPoint(0),t=this.curves[this.curves.length-1].getPoint(1);if(!e.equals(t)){let n=e.isVector2===!0?"LineCurve":"LineCurve3";this.curves.push(new Kc[n](t,e))}return this}getPoint(e,t){let n=e*this.getLength(),s=this.getCurveLengths(),r=0;for(;r<s.length;){if(s[r]>=n){let o=s[r]-n,a=this.curves[r],l=a.getLength(),c=l===0?0:1-o/l;return a.getPointAt(c,t)}r++}return null}getLength(){let e=this.getCurveLengths();return e[e.length-1]}updateArcLengths(){this.needsUpdate=!0,this.cacheLengths=null,this.getCurveLengths()}getCurveLengths(){if(this.cacheLengths&&this.cacheLengths.length===this.curves.length)return this.cacheLengths;let e=[],t=0;for(let n=0,s=this.curves.length;n<s;n++)t+=this.curves[n].getLength(),e.push(t);return this.cacheLengths=e,e}getSpacedPoints(e=40){let t=[];for(let n=0;n<=e;n++)t.push(this.getPoint(n/e));return this.autoClose&&t.push(t[0]),t}getPoints(e=12){let t=[],n;for(let s=0,r=this.curves;s<r.length;s++){let o=r[s],a=o.isEllipseCurve?e*2:o.isLineCurve||o.isLineCurve3?1:o.isSplineCurve?e*o.points.length:e,l=o.getPoints(a);for(let c=0;c<l.length;c++){let h=l[c];n&&n.equals(h)||(t.push(h),n=h)}}return this.autoClose&&t.length>1&&!t[t.length-1].equals(t[0])&&t.push(t[0]),t}copy(e){super.copy(e),this.curves=[];for(let t=0,n=e.curves.length;t<n;t++){let s=e.curves[t];this.curves.push(s.clone())}return this.autoClose=e.autoClose,this.cacheLengths=null,this}toJSON(){let e=super.toJSON();e.autoClose=this.autoClose,e.curves=[];for(let t=0,n=this.curves.length;t<n;t++){let s=this.curves[t];e.curves.push(s.toJSON())}return e}fromJSON(e){super.fromJSON(e),this.autoClose=e.autoClose,this.curves=[];for(let t=0,n=e.curves.length;t<n;t++){let s=e.curves[t];this.curves.push(new Kc[s.type]().fromJSON(s))}return this.cacheLengths=null,this}},$a=class extends jc{constructor(e){super(),this.type="Path",this.currentPoint=new ue,e&&this.setFromPoints(e)}setFromPoints(e){this.moveTo(e[0].x,e[0].y);for(let t=1,n=e.length;t<n;t++)this.lineTo(e[t].x,e[t].y);return this}moveTo(e,t){return this.currentPoint.set(e,t),this}lineTo(e,t){let n=new Wa(this.currentPoint.clone(),new ue(e,t));return this.curves.push(n),this.currentPoint.set(e,t),this}quadraticCurveTo(e,t,n,s){let r=new Xa(this.currentPoint.clone(),new ue(e,t),new ue(n,s));return this.curves.push(r),this.currentPoint.set(n,s),this}bezierCurveTo(e,t,n,s,r,o){let a=new Ga(this.currentPoint.clone(),new ue(e,t),new ue(n,s),new ue(r,o));return this.curves.push(a),this.currentPoint.set(r,o),this}splineThru(e){let t=[this.currentPoint.clone()].concat(e),n=new Ya(t);return this.curves.push(n),this.currentPoint.copy(e[e.length-1]),this}arc(e,t,n,s,r,o){let a=this.currentPoint.x,l=this.currentPoint.y;return this.absarc(e+a,t+l,n,s,r,o),this}absarc(e,t,n,s,r,o){return this.absellipse(e,t,n,n,s,r,o),this}ellipse(e,t,n,s,r,o,a,l){let c=this.currentPoint.x,h=this.currentPoint.y;return this.absellipse(e+c,t+h,n,s,r,o,a,l),this}absellipse(e,t,n,s,r,o,a,l){let c=new Lo(e,t,n,s,r,o,a,l);if(this.curves.length>0){let u=c.getPoint(0);u.equals(this.currentPoint)||this.lineTo(u.x,u.y)}this.curves.push(c);let h=c.getPoint(1);return this.currentPoint.copy(h),this}copy(e){return super.copy(e),this.currentPoint.copy(e.currentPoint),this}toJSON(){let e=super.toJSON();return e.currentPoint=this.currentPoint.toArray(),e}fromJSON(e){return super.fromJSON(e),this.currentPoint.fromArray(e.currentPoint),this}},Do=class extends $a{constructor(e){super(e),this.uuid=Xs(),this.type="Shape",this.holes=[]}getPointsHoles(e){let t=[];for(let n=0,s=this.holes.length;n<s;n++)t[n]=this.holes[n].getPoints(e);return t}extractPoints(e){return{shape:this.getPoints(e),holes:this.getPointsHoles(e)}}copy(e){super.copy(e),this.holes=[];for(let t=0,n=e.holes.length;t<n;t++){let s=e.holes[t];this.holes.push(s.clone())}return this}toJSON(){let e=super.toJSON();e.uuid=this.uuid,e.holes=[];for(let t=0,n=this.holes.length;t<n;t++){let s=this.holes[t];e.holes.push(s.toJSON())}return e}fromJSON(e){super.fromJSON(e),this.uuid=e.uuid,this.holes=[];for(let t=0,n=e.holes.length;t<n;t++){let s=e.holes[t];this.holes.push(new $a().fromJSON(s))}return this}};function pb(i,e,t=2){let n=e&&e.length,s=n?e[0]*t:i.length,r=b0(i,0,s,t,!0),o=[];if(!r||r.next===r.prev)return o;let a,l,c;if(n&&(r=vb(i,e,r,t)),i.length>80*t){a=i[0],l=i[1];let h=a,u=l;for(let d=t;d<s;d+=t){let f=i[d],p=i[d+1];f<a&&(a=f),p<l&&(l=p),f>h&&(h=f),p>u&&(u=p)}c=Math.max(h-a,u-l),c=c!==0?32767/c:0}return Za(r,o,t,a,l,c,0),o}function b0(i,e,t,n,s){let r;if(s===Pb(i,e,t,n)>0)for(let o=e;o<t;o+=n)r=Eg(o/n|0,i[o],i[o+1],r);else for(let o=t-n;o>=e;o-=n)r=Eg(o/n|0,i[o],i[o+1],r);return r&&No(r,r.next)&&(Ka(r),r=r.next),r}function Ir(i,e){if(!i)return i;e||(e=i);let t=i,n;do if(n=!1,!t.steiner&&(No(t,t.next)||ln(t.prev,t,t.next)===0)){if(Ka(t),t=e=t.prev,t===t.next)break;n=!0}else t=t.next;while(n||t!==e);return e}function Za(i,e,t,n,s,r,o){if(!i)return;!o&&r&&Eb(i,n,s,r);let a=i;for(;i.prev!==i.next;){let l=i.prev,c=i.next;if(r?gb(i,n,s,r):mb(i)){e.push(l.i,i.i,c.i),Ka(i),i=c.next,a=c.next;continue}if(i=c,i===a){o?o===1?(i=yb(Ir(i),e),Za(i,e,t,n,s,r,2)):o===2&&xb(i,e,t,n,s,r):Za(Ir(i),e,t,n,s,r,1);break}}}function mb(i){let e=i.prev,t=i,n=i.next;if(ln(e,t,n)>=0)return!1;let s=e.x,r=t.x,o=n.x,a=e.y,l=t.y,c=n.y,h=Math.min(s,r,o),u=Math.min(a,l,c),d=Math.max(s,r,o),f=Math.max(a,l,c),p=n.next;for(;p!==e;){if(p.x>=h&&p.x<=d&&p.y>=u&&p.y<=f&&ba(s,a,r,l,o,c,p.x,p.y)&&ln(p.prev,p,p.next)>=0)return!1;p=p.next}return!0}function gb(i,e,t,n){let s=i.prev,r=i,o=i.next;if(ln(s,r,o)>=0)return!1;let a=s.x,l=r.x,c=o.x,h=s.y,u=r.y,d=o.y,f=Math.min(a,l,c),p=Math.min(h,u,d),y=Math.max(a,l,c),g=Math.max(h,u,d),m=vf(f,p,e,t,n),x=vf(y,g,e,t,n),M=i.prevZ,_=i.nextZ;for(;M&&M.z>=m&&_&&_.z<=x;){if(M.x>=f&&M.x<=y&&M.y>=p&&M.y<=g&&M!==s&&M!==o&&ba(a,h,l,u,c,d,M.x,M.y)&&ln(M.prev,M,M.next)>=0||(M=M.prevZ,_.x>=f&&_.x<=y&&_.y>=p&&_.y<=g&&_!==s&&_!==o&&ba(a,h,l,u,c,d,_.x,_.y)&&ln(_.prev,_,_.next)>=0))return!1;_=_.nextZ}for(;M&&M.z>=m;){if(M.x>=f&&M.x<=y&&M.y>=p&&M.y<=g&&M!==s&&M!==o&&ba(a,h,l,u,c,d,M.x,M.y)&&ln(M.prev,M,M.next)>=0)return!1;M=M.prevZ}for(;_&&_.z<=x;){if(_.x>=f&&_.x<=y&&_.y>=p&&_.y<=g&&_!==s&&_!==o&&ba(a,h,l,u,c,d,_.x,_.y)&&ln(_.prev,_,_.next)>=0)return!1;_=_.nextZ}return!0}function yb(i,e){let t=i;do{let n=t.prev,s=t.next.next;!No(n,s)&&S0(n,t,t.next,s)&&Ja(n,s)&&Ja(s,n)&&(e.push(n.i,t.i,s.i),Ka(t),Ka(t.next),t=i=s),t=t.next}while(t!==i);return Ir(t)}function xb(i,e,t,n,s,r){let o=i;do{let a=o.next.next;for(;a!==o.prev;){if(o.i!==a.i&&Ab(o,a)){let l=E0(o,a);o=Ir(o,o.next),l=Ir(l,l.next),Za(o,e,t,n,s,r,0),Za(l,e,t,n,s,r,0);return}a=a.next}o=o.next}while(o!==i)}function vb(i,e,t,n){let s=[];for(let r=0,o=e.length;r<o;r++){let a=e[r]*n,l=r<o-1?e[r+1]*n:i.length,c=b0(i,a,l,n,!1);c===c.next&&(c.steiner=!0),s.push(Tb(c))}s.sort(_b);for(let r=0;r<s.length;r++)t=bb(s[r],t);return t}function _b(i,e){let t=i.x-e.x;if(t===0&&(t=i.y-e.y,t===0)){let n=(i.next.y-i.y)/(i.next.x-i.x),s=(e.next.y-e.y)/(e.next.x-e.x);t=n-s}return t}function bb(i,e){let t=Mb(i,e);if(!t)return e;let n=E0(t,i);return Ir(n,n.next),Ir(t,t.next)}function Mb(i,e){let t=e,n=i.x,s=i.y,r=-1/0,o;if(No(i,t))return t;do{if(No(i,t.next))return t.next;if(s<=t.y&&s>=t.next.y&&t.next.y!==t.y){let u=t.x+(s-t.y)*(t.next.x-t.x)/(t.next.y-t.y);if(u<=n&&u>r&&(r=u,o=t.x<t.next.x?t:t.next,u===n))return o}t=t.next}while(t!==e);if(!o)return null;let a=o,l=o.x,c=o.y,h=1/0;t=o;do{if(n>=t.x&&t.x>=l&&n!==t.x&&M0(s<c?n:r,s,l,c,s<c?r:n,s,t.x,t.y)){let u=Math.abs(s-t.y)/(n-t.x);Ja(t,i)&&(u<h||u===h&&(t.x>o.x||t.x===o.x&&Sb(o,t)))&&(o=t,h=u)}t=t.next}while(t!==a);return o}function Sb(i,e){return ln(i.prev,i,e.prev)<0&&ln(e.next,i,i.next)<0}function Eb(i,e,t,n){let s=i;do s.z===0&&(s.z=vf(s.x,s.y,e,t,n)),s.prevZ=s.prev,s.nextZ=s.next,s=s.next;while(s!==i);s.prevZ.nextZ=null,s.prevZ=null,wb(s)}function wb(i){let e,t=1;do{let n=i,s;i=null;let r=null;for(e=0;n;){e++;let o=n,a=0;for(let c=0;c<t&&(a++,o=o.nextZ,!!o);c++);let l=t;for(;a>0||l>0&&o;)a!==0&&(l===0||!o||n.z<=o.z)?(s=n,n=n.nextZ,a--):(s=o,o=o.nextZ,l--),r?r.nextZ=s:i=s,s.prevZ=r,r=s;n=o}r.nextZ=null,t*=2}while(e>1);return i}function vf(i,e,t,n,s){return i=(i-t)*s|0,e=(e-n)*s|0,i=(i|i<<8)&16711935,i=(i|i<<4)&252645135,i=(i|i<<2)&858993459,i=(i|i<<1)&1431655765,e=(e|e<<8)&16711935,e=(e|e<<4)&252645135,e=(e|e<<2)&858993459,e=(e|e<<1)&1431655765,i|e<<1}function Tb(i){let e=i,t=i;do(e.x<t.x||e.x===t.x&&e.y<t.y)&&(t=e),e=e.next;while(e!==i);return t}function M0(i,e,t,n,s,r,o,a){return(s-o)*(e-a)>=(i-o)*(r-a)&&(i-o)*(n-a)>=(t-o)*(e-a)&&(t-o)*(r-a)>=(s-o)*(n-a)}function ba(i,e,t,n,s,r,o,a){return!(i===o&&e===a)&&M0(i,e,t,n,s,r,o,a)}function Ab(i,e){return i.next.i!==e.i&&i.prev.i!==e.i&&!Rb(i,e)&&(Ja(i,e)&&Ja(e,i)&&Cb(i,e)&&(ln(i.prev,i,e.prev)||ln(i,e.prev,e))||No(i,e)&&ln(i.prev,i,i.next)>0&&ln(e.prev,e,e.next)>0)}function ln(i,e,t){return(e.y-i.y)*(t.x-e.x)-(e.x-i.x)*(t.y-e.y)}function No(i,e){return i.x===e.x&&i.y===e.y}function S0(i,e,t,n){let s=wc(ln(i,e,t)),r=wc(ln(i,e,n)),o=wc(ln(t,n,i)),a=wc(ln(t,n,e));return!!(s!==r&&o!==a||s===0&&Ec(i,t,e)||r===0&&Ec(i,n,e)||o===0&&Ec(t,i,n)||a===0&&Ec(t,e,n))}function Ec(i,e,t){return e.x<=Math.max(i.x,t.x)&&e.x>=Math.min(i.x,t.x)&&e.y<=Math.max(i.y,t.y)&&e.y>=Math.min(i.y,t.y)}function wc(i){return i>0?1:i<0?-1:0}function Rb(i,e){let t=i;do{if(t.i!==i.i&&t.next.i!==i.i&&t.i!==e.i&&t.next.i!==e.i&&S0(t,t.next,i,e))return!0;t=t.next}while(t!==i);return!1}function Ja(i,e){return ln(i.prev,i,i.next)<0?ln(i,e,i.next)>=0&&ln(i,i.prev,e)>=0:ln(i,e,i.prev)<0||ln(i,i.next,e)<0}function Cb(i,e){let t=i,n=!1,s=(i.x+e.x)/2,r=(i.y+e.y)/2;do t.y>r!=t.next.y>r&&t.next.y!==t.y&&s<(t.next.x-t.x)*(r-t.y)/(t.next.y-t.y)+t.x&&(n=!n),t=t.next;while(t!==i);return n}function E0(i,e){let t=_f(i.i,i.x,i.y),n=_f(e.i,e.x,e.y),s=i.next,r=e.prev;return i.next=e,e.prev=i,t.next=s,s.prev=t,n.next=t,t.prev=n,r.next=n,n.prev=r,n}function Eg(i,e,t,n){let s=_f(i,e,t);return n?(s.next=n.next,s.prev=n,n.next.prev=s,n.next=s):(s.prev=s,s.next=s),s}function Ka(i){i.next.prev=i.prev,i.prev.next=i.next,i.prevZ&&(i.prevZ.nextZ=i.nextZ),i.nextZ&&(i.nextZ.prevZ=i.prevZ)}function _f(i,e,t){return{i,x:e,y:t,prev:null,next:null,z:0,prevZ:null,nextZ:null,steiner:!1}}function Pb(i,e,t,n){let s=0;for(let r=e,o=t-n;r<t;r+=n)s+=(i[o]-i[r])*(i[r+1]+i[o+1]),o=r;return s}var bf=class{static triangulate(e,t,n=2){return pb(e,t,n)}},Ds=class i{static area(e){let t=e.length,n=0;for(let s=t-1,r=0;r<t;s=r++)n+=e[s].x*e[r].y-e[r].x*e[s].y;return n*.5}static isClockWise(e){return i.area(e)<0}static triangulateShape(e,t){let n=[],s=[],r=[];wg(e),Tg(n,e);let o=e.length;t.forEach(wg);for(let l=0;l<t.length;l++)s.push(o),o+=t[l].length,Tg(n,t[l]);let a=bf.triangulate(n,s);for(let l=0;l<a.length;l+=3)r.push(a.slice(l,l+3));return r}};function wg(i){let e=i.length;e>2&&i[e-1].equals(i[0])&&i.pop()}function Tg(i,e){for(let t=0;t<e.length;t++)i.push(e[t].x),i.push(e[t].y)}var ja=class i extends wt{constructor(e=new Do([new ue(.5,.5),new ue(-.5,.5),new ue(-.5,-.5),new ue(.5,-.5)]),t={}){super(),this.type="ExtrudeGeometry",this.parameters={shapes:e,options:t},e=Array.isArray(e)?e:[e];let n=this,s=[],r=[];for(let a=0,l=e.length;a<l;a++){let c=e[a];o(c)}this.setAttribute("position",new ot(s,3)),this.setAttribute("uv",new ot(r,2)),this.computeVertexNormals();function o(a){let l=[],c=t.curveSegments!==void 0?t.curveSegments:12,h=t.steps!==void 0?t.steps:1,u=t.depth!==void 0?t.depth:1,d=t.bevelEnabled!==void 0?t.bevelEnabled:!0,f=t.bevelThickness!==void 0?t.bevelThickness:.2,p=t.bevelSize!==void 0?t.bevelSize:f-.1,y=t.bevelOffset!==void 0?t.bevelOffset:0,g=t.bevelSegments!==void 0?t.bevelSegments:3,m=t.extrudePath,x=t.UVGenerator!==void 0?t.UVGenerator:Ib,M,_=!1,C,T,v,E;if(m){M=m.getSpacedPoints(h),_=!0,d=!1;let oe=m.isCatmullRomCurve3?m.closed:!1;C=m.computeFrenetFrames(h,oe),T=new S,v=new S,E=new S}d||(g=0,f=0,p=0,y=0);let N=a.extractPoints(c),P=N.shape,I=N.holes;if(!Ds.isClockWise(P)){P=P.reverse();for(let oe=0,_e=I.length;oe<_e;oe++){let xe=I[oe];Ds.isClockWise(xe)&&(I[oe]=xe.reverse())}}function V(oe){let xe=10000000000000001e-36,Be=oe[0];for(let De=1;De<=oe.length;De++){let st=De%oe.length,ke=oe[st],vt=ke.x-Be.x,gt=ke.y-Be.y,bt=vt*vt+gt*gt,O=Math.max(Math.abs(ke.x),Math.abs(ke.y),Math.abs(Be.x),Math.abs(Be.y)),Me=xe*O*O;if(bt<=Me){oe.splice(st,1),De--;continue}Be=ke}}V(P),I.forEach(V);let F=I.length,z=P;for(let oe=0;oe<F;oe++){let _e=I[oe];P=P.concat(_e)}function Y(oe,_e,xe){return _e||ht("ExtrudeGeometry: vec does not exist"),oe.clone().addScaledVector(_e,xe)}let G=P.length;function ce(oe,_e,xe){let Be,De,st,ke=oe.x-_e.x,vt=oe.y-_e.y,gt=xe.x-oe.x,bt=xe.y-oe.y,O=ke*ke+vt*vt,Me=ke*bt-vt*gt;if(Math.abs(Me)>Number.EPSILON){let Xe=Math.sqrt(O),ft=Math.sqrt(gt*gt+bt*bt),we=_e.x-vt/Xe,zt=_e.y+ke/Xe,$e=xe.x-bt/ft,tt=xe.y+gt/ft,L=(($e-we)*bt-(tt-zt)*gt)/(ke*bt-vt*gt);Be=we+ke*L-oe.x,De=zt+vt*L-oe.y;let w=Be*Be+De*De;if(w<=2)return new ue(Be,De);st=Math.sqrt(w/2)}else{let Xe=!1;ke>Number.EPSILON?gt>Number.EPSILON&&(Xe=!0):ke<-Number.EPSILON?gt<-Number.EPSILON&&(Xe=!0):Math.sign(vt)===Math.sign(bt)&&(Xe=!0),Xe?(Be=-vt,De=ke,st=Math.sqrt(O)):(Be=ke,De=vt,st=Math.sqrt(O/2))}return new ue(Be/st,De/st)}let J=[];for(let oe=0,_e=z.length,xe=_e-1,Be=oe+1;oe<_e;oe++,xe++,Be++)xe===_e&&(xe=0),Be===_e&&(Be=0),J[oe]=ce(z[oe],z[xe],z[Be]);let Q=[],te,pe=J.concat();for(let oe=0,_e=F;oe<_e;oe++){let xe=I[oe];te=[];for(let Be=0,De=xe.length,st=De-1,ke=Be+1;Be<De;Be++,st++,ke++)st===De&&(st=0),ke===De&&(ke=0),te[Be]=ce(xe[Be],xe[st],xe[ke]);Q.push(te),pe=pe.concat(te)}let he;if(g===0)he=Ds.triangulateShape(z,I);else{let oe=[],_e=[];for(let xe=0;xe<g;xe++){let Be=xe/g,De=f*Math.cos(Be*Math.PI/2),st=p*Math.sin(Be*Math.PI/2)+y;for(let ke=0,vt=z.length;ke<vt;ke++){let gt=Y(z[ke],J[ke],st);Ve(gt.x,gt.y,-De),Be===0&&oe.push(gt)}for(let ke=0,vt=F;ke<vt;ke++){let gt=I[ke];te=Q[ke];let bt=[];for(let O=0,Me=gt.length;O<Me;O++){let Xe=Y(gt[O],te[O],st);Ve(Xe.x,Xe.y,-De),Be===0&&bt.push(Xe)}Be===0&&_e.push(bt)}}he=Ds.triangulateShape(oe,_e)}let ee=he.length,ye=p+y;for(let oe=0;oe<G;oe++){let _e=d?Y(P[oe],pe[oe],ye):P[oe];_?(v.copy(C.normals[0]).multiplyScalar(_e.x),T.copy(C.binormals[0]).multiplyScalar(_e.y),E.copy(M[0]).add(v).add(T),Ve(E.x,E.y,E.z)):Ve(_e.x,_e.y,0)}for(let oe=1;oe<=h;oe++)for(let _e=0;_e<G;_e++){let xe=d?Y(P[_e],pe[_e],ye):P[_e];_?(v.copy(C.normals[oe]).multiplyScalar(xe.x),T.copy(C.binormals[oe]).multiplyScalar(xe.y),E.copy(M[oe]).add(v).add(T),Ve(E.x,E.y,E.z)):Ve(xe.x,xe.y,u/h*oe)}for(let oe=g-1;oe>=0;oe--){let _e=oe/g,xe=f*Math.cos(_e*Math.PI/2),Be=p*Math.sin(_e*Math.PI/2)+y;for(let De=0,st=z.length;De<st;De++){let ke=Y(z[De],J[De],Be);Ve(ke.x,ke.y,u+xe)}for(let De=0,st=I.length;De<st;De++){let ke=I[De];te=Q[De];for(let vt=0,gt=ke.length;vt<gt;vt++){let bt=Y(ke[vt],te[vt],Be);_?Ve(bt.x,bt.y+M[h-1].y,M[h-1].x+xe):Ve(bt.x,bt.y,u+xe)}}}ve(),Le();function ve(){let oe=s.length/3;if(d){let _e=0,xe=G*_e;for(let Be=0;Be<ee;Be++){let De=he[Be];at(De[2]+xe,De[1]+xe,De[0]+xe)}_e=h+g*2,xe=G*_e;for(let Be=0;Be<ee;Be++){let De=he[Be];at(De[0]+xe,De[1]+xe,De[2]+xe)}}else{for(let _e=0;_e<ee;_e++){let xe=he[_e];at(xe[2],xe[1],xe[0])}for(let _e=0;_e<ee;_e++){let xe=he[_e];at(xe[0]+G*h,xe[1]+G*h,xe[2]+G*h)}}n.addGroup(oe,s.length/3-oe,0)}function Le(){let oe=s.length/3,_e=0;Ee(z,_e),_e+=z.length;for(let xe=0,Be=I.length;xe<Be;xe++){let De=I[xe];Ee(De,_e),_e+=De.length}n.addGroup(oe,s.length/3-oe,1)}function Ee(oe,_e){let xe=oe.length;for(;--xe>=0;){let Be=xe,De=xe-1;De<0&&(De=oe.length-1);for(let st=0,ke=h+g*2;st<ke;st++){let vt=G*st,gt=G*(st+1),bt=_e+Be+vt,O=_e+De+vt,Me=_e+De+gt,Xe=_e+Be+gt;Je(bt,O,Me,Xe)}}}function Ve(oe,_e,xe){l.push(oe),l.push(_e),l.push(xe)}function at(oe,_e,xe){lt(oe),lt(_e),lt(xe);let Be=s.length/3,De=x.generateTopUV(n,s,Be-3,Be-2,Be-1);rt(De[0]),rt(De[1]),rt(De[2])}function Je(oe,_e,xe,Be){lt(oe),lt(_e),lt(Be),lt(_e),lt(xe),lt(Be);let De=s.length/3,st=x.generateSideWallUV(n,s,De-6,De-3,De-2,De-1);rt(st[0]),rt(st[1]),rt(st[3]),rt(st[1]),rt(st[2]),rt(st[3])}function lt(oe){s.push(l[oe*3+0]),s.push(l[oe*3+1]),s.push(l[oe*3+2])}function rt(oe){r.push(oe.x),r.push(oe.y)}}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}toJSON(){let e=super.toJSON(),t=this.parameters.shapes,n=this.parameters.options;return Lb(t,n,e)}static fromJSON(e,t){let n=[];for(let r=0,o=e.shapes.length;r<o;r++){let a=t[e.shapes[r]];n.push(a)}let s=e.options.extrudePath;return s!==void 0&&(e.options.extrudePath=new Kc[s.type]().fromJSON(s)),new i(n,e.options)}},Ib={generateTopUV:function(i,e,t,n,s){let r=e[t*3],o=e[t*3+1],a=e[n*3],l=e[n*3+1],c=e[s*3],h=e[s*3+1];return[new ue(r,o),new ue(a,l),new ue(c,h)]},generateSideWallUV:function(i,e,t,n,s,r){let o=e[t*3],a=e[t*3+1],l=e[t*3+2],c=e[n*3],h=e[n*3+1],u=e[n*3+2],d=e[s*3],f=e[s*3+1],p=e[s*3+2],y=e[r*3],g=e[r*3+1],m=e[r*3+2];return Math.abs(a-h)<Math.abs(o-c)?[new ue(o,1-l),new ue(c,1-u),new ue(d,1-p),new ue(y,1-m)]:[new ue(a,1-l),new ue(h,1-u),new ue(f,1-p),new ue(g,1-m)]}};function Lb(i,e,t){if(t.shapes=[],Array.isArray(i))for(let n=0,s=i.length;n<s;n++){let r=i[n];t.shapes.push(r.uuid)}else t.shapes.push(i.uuid);return t.options=Object.assign({},e),e.extrudePath!==void 0&&(t.options.extrudePath=e.extrudePath.toJSON()),t}var Qa=class i extends wt{constructor(e=[new ue(0,-.5),new ue(.5,0),new ue(0,.5)],t=12,n=0,s=Math.PI*2){super(),this.type="LatheGeometry",this.parameters={points:e,segments:t,phiStart:n,phiLength:s},t=Math.floor(t),s=mt(s,0,Math.PI*2);let r=[],o=[],a=[],l=[],c=[],h=1/t,u=new S,d=new ue,f=new S,p=new S,y=new S,g=0,m=0;for(let x=0;x<=e.length-1;x++)switch(x){case 0:g=e[x+1].x-e[x].x,m=e[x+1].y-e[x].y,f.x=m*1,f.y=-g,f.z=m*0,y.copy(f),f.normalize(),l.push(f.x,f.y,f.z);break;case e.length-1:y.normalize(),l.push(y.x,y.y,y.z);break;default:g=e[x+1].x-e[x].x,m=e[x+1].y-e[x].y,f.x=m*1,f.y=-g,f.z=m*0,p.copy(f),f.x+=y.x,f.y+=y.y,f.z+=y.z,f.normalize(),l.push(f.x,f.y,f.z),y.copy(p)}for(let x=0;x<=t;x++){let M=n+x*h*s,_=Math.sin(M),C=Math.cos(M);for(let T=0;T<=e.length-1;T++){u.x=e[T].x*_,u.y=e[T].y,u.z=e[T].x*C,o.push(u.x,u.y,u.z),d.x=x/t,d.y=T/(e.length-1),a.push(d.x,d.y);let v=l[3*T+0]*_,E=l[3*T+1],N=l[3*T+0]*C;c.push(v,E,N)}}for(let x=0;x<t;x++)for(let M=0;M<e.length-1;M++){let _=M+x*e.length,C=_,T=_+e.length,v=_+e.length+1,E=_+1;r.push(C,T,E),r.push(v,E,T)}this.setIndex(r),this.setAttribute("position",new ot(o,3)),this.setAttribute("uv",new ot(a,2)),this.setAttribute("normal",new ot(c,3))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.points,e.segments,e.phiStart,e.phiLength)}},el=class i extends Yc{constructor(e=1,t=0){let n=[1,0,0,-1,0,0,0,1,0,0,-1,0,0,0,1,0,0,-1],s=[0,2,4,0,4,3,0,3,5,0,5,2,1,2,5,1,5,3,1,3,4,1,4,2];super(n,s,e,t),this.type="OctahedronGeometry",this.parameters={radius:e,detail:t}}static fromJSON(e){return new i(e.radius,e.detail)}},ks=class i extends wt{constructor(e=1,t=1,n=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:e,height:t,widthSegments:n,heightSegments:s};let r=e/2,o=t/2,a=Math.floor(n),l=Math.floor(s),c=a+1,h=l+1,u=e/a,d=t/l,f=[],p=[],y=[],g=[];for(let m=0;m<h;m++){let x=m*d-o;for(let M=0;M<c;M++){let _=M*u-r;p.push(_,-x,0),y.push(0,0,1),g.push(M/a),g.push(1-m/l)}}for(let m=0;m<l;m++)for(let x=0;x<a;x++){let M=x+c*m,_=x+c*(m+1),C=x+1+c*(m+1),T=x+1+c*m;f.push(M,_,T),f.push(_,C,T)}this.setIndex(f),this.setAttribute("position",new ot(p,3)),this.setAttribute("normal",new ot(y,3)),this.setAttribute("uv",new ot(g,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.width,e.height,e.widthSegments,e.heightSegments)}};var on=class i extends wt{constructor(e=1,t=32,n=16,s=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:e,widthSegments:t,heightSegments:n,phiStart:s,phiLength:r,thetaStart:o,thetaLength:a},t=Math.max(3,Math.floor(t)),n=Math.max(2,Math.floor(n));let l=Math.min(o+a,Math.PI),c=0,h=[],u=new S,d=new S,f=[],p=[],y=[],g=[];for(let m=0;m<=n;m++){let x=[],M=m/n,_=o+M*a,C=e*Math.cos(_),T=Math.sqrt(e*e-C*C),v=0;m===0&&o===0?v=.5/t:m===n&&l===Math.PI&&(v=-.5/t);for(let E=0;E<=t;E++){let N=E/t,P=s+N*r;u.x=-T*Math.cos(P),u.y=C,u.z=T*Math.sin(P),p.push(u.x,u.y,u.z),d.copy(u).normalize(),y.push(d.x,d.y,d.z),g.push(N+v,1-M),x.push(c++)}h.push(x)}for(let m=0;m<n;m++)for(let x=0;x<t;x++){let M=h[m][x+1],_=h[m][x],C=h[m+1][x],T=h[m+1][x+1];(m!==0||o>0)&&f.push(M,_,T),(m!==n-1||l<Math.PI)&&f.push(_,C,T)}this.setIndex(f),this.setAttribute("position",new ot(p,3)),this.setAttribute("normal",new ot(y,3)),this.setAttribute("uv",new ot(g,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.radius,e.widthSegments,e.heightSegments,e.phiStart,e.phiLength,e.thetaStart,e.thetaLength)}};var Ci=class i extends wt{constructor(e=1,t=.4,n=12,s=48,r=Math.PI*2,o=0,a=Math.PI*2){super(),this.type="TorusGeometry",this.parameters={radius:e,tube:t,radialSegments:n,tubularSegments:s,arc:r,thetaStart:o,thetaLength:a},n=Math.floor(n),s=Math.floor(s);let l=[],c=[],h=[],u=[],d=new S,f=new S,p=new S;for(let y=0;y<=n;y++){let g=o+y/n*a;for(let m=0;m<=s;m++){let x=m/s*r;f.x=(e+t*Math.cos(g))*Math.cos(x),f.y=(e+t*Math.cos(g))*Math.sin(x),f.z=t*Math.sin(g),c.push(f.x,f.y,f.z),d.x=e*Math.cos(x),d.y=e*Math.sin(x),p.subVectors(f,d).normalize(),h.push(p.x,p.y,p.z),u.push(m/s),u.push(y/n)}}for(let y=1;y<=n;y++)for(let g=1;g<=s;g++){let m=(s+1)*y+g-1,x=(s+1)*(y-1)+g-1,M=(s+1)*(y-1)+g,_=(s+1)*y+g;l.push(m,x,_),l.push(x,M,_)}this.setIndex(l),this.setAttribute("position",new ot(c,3)),this.setAttribute("normal",new ot(h,3)),this.setAttribute("uv",new ot(u,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.radius,e.tube,e.radialSegments,e.tubularSegments,e.arc,e.thetaStart,e.thetaLength)}};var Lr=class i extends wt{constructor(e=new qa(new S(-1,-1,0),new S(-1,1,0),new S(1,1,0)),t=64,n=1,s=8,r=!1){super(),this.type="TubeGeometry",this.parameters={path:e,tubularSegments:t,radius:n,radialSegments:s,closed:r};let o=e.computeFrenetFrames(t,r);this.tangents=o.tangents,this.normals=o.normals,this.binormals=o.binormals;let a=new S,l=new S,c=new ue,h=new S,u=[],d=[],f=[],p=[];y(),this.setIndex(p),this.setAttribute("position",new ot(u,3)),this.setAttribute("normal",new ot(d,3)),this.setAttribute("uv",new ot(f,2));function y(){for(let M=0;M<t;M++)g(M);g(r===!1?t:0),x(),m()}function g(M){h=e.getPointAt(M/t,h);let _=o.normals[M],C=o.binormals[M];for(let T=0;T<=s;T++){let v=T/s*Math.PI*2,E=Math.sin(v),N=-Math.cos(v);l.x=N*_.x+E*C.x,l.y=N*_.y+E*C.y,l.z=N*_.z+E*C.z,l.normalize(),d.push(l.x,l.y,l.z),a.x=h.x+n*l.x,a.y=h.y+n*l.y,a.z=h.z+n*l.z,u.push(a.x,a.y,a.z)}}function m(){for(let M=1;M<=t;M++)for(let _=1;_<=s;_++){let C=(s+1)*(M-1)+(_-1),T=(s+1)*M+(_-1),v=(s+1)*M+_,E=(s+1)*(M-1)+_;p.push(C,T,E),p.push(T,v,E)}}function x(){for(let M=0;M<=t;M++)for(let _=0;_<=s;_++)c.x=M/t,c.y=_/s,f.push(c.x,c.y)}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}toJSON(){let e=super.toJSON();return e.path=this.parameters.path.toJSON(),e}static fromJSON(e){return new i(new Kc[e.path.type]().fromJSON(e.path),e.tubularSegments,e.radius,e.radialSegments,e.closed)}},tl=class extends wt{constructor(e=null){if(super(),this.type="WireframeGeometry",this.parameters={geometry:e},e!==null){let t=[],n=new Set,s=new S,r=new S;if(e.index!==null){let o=e.attributes.position,a=e.index,l=e.groups;l.length===0&&(l=[{start:0,count:a.count,materialIndex:0}]);for(let c=0,h=l.length;c<h;++c){let u=l[c],d=u.start,f=u.count;for(let p=d,y=d+f;p<y;p+=3)for(let g=0;g<3;g++){let m=a.getX(p+g),x=a.getX(p+(g+1)%3);s.fromBufferAttribute(o,m),r.fromBufferAttribute(o,x),Ag(s,r,n)===!0&&(t.push(s.x,s.y,s.z),t.push(r.x,r.y,r.z))}}}else{let o=e.attributes.position;for(let a=0,l=o.count/3;a<l;a++)for(let c=0;c<3;c++){let h=3*a+c,u=3*a+(c+1)%3;s.fromBufferAttribute(o,h),r.fromBufferAttribute(o,u),Ag(s,r,n)===!0&&(t.push(s.x,s.y,s.z),t.push(r.x,r.y,r.z))}}this.setAttribute("position",new ot(t,3))}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}};function Ag(i,e,t){let n=`${i.x},${i.y},${i.z}-${e.x},${e.y},${e.z}`,s=`${e.x},${e.y},${e.z}-${i.x},${i.y},${i.z}`;return t.has(n)===!0||t.has(s)===!0?!1:(t.add(n),t.add(s),!0)}var nl=class extends Ki{constructor(e){super(),this.isShadowMaterial=!0,this.type="ShadowMaterial",this.color=new et(0),this.transparent=!0,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.fog=e.fog,this}};function Or(i){let e={};for(let t in i){e[t]={};for(let n in i[t]){let s=i[t][n];if(Rg(s))s.isRenderTargetTexture?(it("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),e[t][n]=null):e[t][n]=s.clone();else if(Array.isArray(s))if(Rg(s[0])){let r=[];for(let o=0,a=s.length;o<a;o++)r[o]=s[o].clone();e[t][n]=r}else e[t][n]=s.slice();else e[t][n]=s}}return e}function Kn(i){let e={};for(let t=0;t<i.length;t++){let n=Or(i[t]);for(let s in n)e[s]=n[s]}return e}function Rg(i){return i&&(i.isColor||i.isMatrix3||i.isMatrix4||i.isVector2||i.isVector3||i.isVector4||i.isTexture||i.isQuaternion)}function Db(i){let e=[];for(let t=0;t<i.length;t++)e.push(i[t].clone());return e}function ip(i){let e=i.getRenderTarget();return e===null?i.outputColorSpace:e.isXRRenderTarget===!0?e.texture.colorSpace:Ct.workingColorSpace}var Ml={clone:Or,merge:Kn},Nb=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,Fb=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,ki=class extends Ki{constructor(e){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=Nb,this.fragmentShader=Fb,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,e!==void 0&&this.setValues(e)}copy(e){return super.copy(e),this.fragmentShader=e.fragmentShader,this.vertexShader=e.vertexShader,this.uniforms=Or(e.uniforms),this.uniformsGroups=Db(e.uniformsGroups),this.defines=Object.assign({},e.defines),this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.fog=e.fog,this.lights=e.lights,this.clipping=e.clipping,this.extensions=Object.assign({},e.extensions),this.glslVersion=e.glslVersion,this.defaultAttributeValues=Object.assign({},e.defaultAttributeValues),this.index0AttributeName=e.index0AttributeName,this.uniformsNeedUpdate=e.uniformsNeedUpdate,this}toJSON(e){let t=super.toJSON(e);t.glslVersion=this.glslVersion,t.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?t.uniforms[s]={type:"t",value:o.toJSON(e).uuid}:o&&o.isColor?t.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?t.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?t.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?t.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?t.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?t.uniforms[s]={type:"m4",value:o.toArray()}:t.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(t.defines=this.defines),t.vertexShader=this.vertexShader,t.fragmentShader=this.fragmentShader,t.lights=this.lights,t.clipping=this.clipping;let n={};for(let s in this.extensions)this.extensions[s]===!0&&(n[s]=!0);return Object.keys(n).length>0&&(t.extensions=n),t}fromJSON(e,t){if(super.fromJSON(e,t),e.uniforms!==void 0)for(let n in e.uniforms){let s=e.uniforms[n];switch(this.uniforms[n]={},s.type){case"t":this.uniforms[n].value=t[s.value]||null;break;case"c":this.uniforms[n].value=new et().setHex(s.value);break;case"v2":this.uniforms[n].value=new ue().fromArray(s.value);break;case"v3":this.uniforms[n].value=new S().fromArray(s.value);break;case"v4":this.uniforms[n].value=new Gt().fromArray(s.value);break;case"m3":this.uniforms[n].value=new yt().fromArray(s.value);break;case"m4":this.uniforms[n].value=new Qe().fromArray(s.value);break;default:this.uniforms[n].value=s.value}}if(e.defines!==void 0&&(this.defines=e.defines),e.vertexShader!==void 0&&(this.vertexShader=e.vertexShader),e.fragmentShader!==void 0&&(this.fragmentShader=e.fragmentShader),e.glslVersion!==void 0&&(this.glslVersion=e.glslVersion),e.extensions!==void 0)for(let n in e.extensions)this.extensions[n]=e.extensions[n];return e.lights!==void 0&&(this.lights=e.lights),e.clipping!==void 0&&(this.clipping=e.clipping),this}},Qc=class extends ki{constructor(e){super(e),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var Hs=class extends Ki{constructor(e){super(),this.isMeshPhongMaterial=!0,this.type="MeshPhongMaterial",this.color=new et(16777215),this.specular=new et(1118481),this.shininess=30,this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new et(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=bl,this.normalScale=new ue(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new fs,this.combine=dl,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.specular.copy(e.specular),this.shininess=e.shininess,this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.emissive.copy(e.emissive),this.emissiveMap=e.emissiveMap,this.emissiveIntensity=e.emissiveIntensity,this.bumpMap=e.bumpMap,this.bumpScale=e.bumpScale,this.normalMap=e.normalMap,this.normalMapType=e.normalMapType,this.normalScale.copy(e.normalScale),this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.envMapIntensity=e.envMapIntensity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.flatShading=e.flatShading,this.fog=e.fog,this}};var ai=class extends Ki{constructor(e){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new et(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new et(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=bl,this.normalScale=new ue(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new fs,this.combine=dl,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.emissive.copy(e.emissive),this.emissiveMap=e.emissiveMap,this.emissiveIntensity=e.emissiveIntensity,this.bumpMap=e.bumpMap,this.bumpScale=e.bumpScale,this.normalMap=e.normalMap,this.normalMapType=e.normalMapType,this.normalScale.copy(e.normalScale),this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.envMapIntensity=e.envMapIntensity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.flatShading=e.flatShading,this.fog=e.fog,this}},eh=class extends Ki{constructor(e){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=l0,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(e)}copy(e){return super.copy(e),this.depthPacking=e.depthPacking,this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this}},th=class extends Ki{constructor(e){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(e)}copy(e){return super.copy(e),this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this}};function yo(i,e){return!i||i.constructor===e?i:typeof e.BYTES_PER_ELEMENT=="number"?new e(i):Array.prototype.slice.call(i)}function Tc(i){return i!==void 0&&i.inTangents!==void 0&&i.outTangents!==void 0}var cr=class{constructor(e,t,n,s){this.parameterPositions=e,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new t.constructor(n),this.sampleValues=t,this.valueSize=n,this.settings=null,this.DefaultSettings_={}}evaluate(e){let t=this.parameterPositions,n=this._cachedIndex,s=t[n],r=t[n-1];n:{e:{let o;t:{i:if(!(e<s)){for(let a=n+2;;){if(s===void 0){if(e<r)break i;return n=t.length,this._cachedIndex=n,this.copySampleValue_(n-1)}if(n===a)break;if(r=s,s=t[++n],e<s)break e}o=t.length;break t}if(!(e>=r)){let a=t[1];e<a&&(n=2,r=a);for(let l=n-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(n===l)break;if(s=r,r=t[--n-1],e>=r)break e}o=n,n=0;break t}break n}for(;n<o;){let a=n+o>>>1;e<t[a]?o=a:n=a+1}if(s=t[n],r=t[n-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return n=t.length,this._cachedIndex=n,this.copySampleValue_(n-1)}this._cachedIndex=n,this.intervalChanged_(n,r,s)}return this.interpolate_(n,r,e,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(e){let t=this.resultBuffer,n=this.sampleValues,s=this.valueSize,r=e*s;for(let o=0;o!==s;++o)t[o]=n[r+o];return t}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},nh=class extends cr{constructor(e,t,n,s){super(e,t,n,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:mf,endingEnd:mf}}intervalChanged_(e,t,n){let s=this.parameterPositions,r=e-2,o=e+1,a=s[r],l=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case gf:r=e,a=2*t-n;break;case yf:r=s.length-2,a=t+s[r]-s[r+1];break;default:r=e,a=n}if(l===void 0)switch(this.getSettings_().endingEnd){case gf:o=e,l=2*n-t;break;case yf:o=1,l=n+s[1]-s[0];break;default:o=e-1,l=t}let c=(n-t)*.5,h=this.valueSize;this._weightPrev=c/(t-a),this._weightNext=c/(l-n),this._offsetPrev=r*h,this._offsetNext=o*h}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=this._offsetPrev,u=this._offsetNext,d=this._weightPrev,f=this._weightNext,p=(n-t)/(s-t),y=p*p,g=y*p,m=-d*g+2*d*y-d*p,x=(1+d)*g+(-1.5-2*d)*y+(-.5+d)*p+1,M=(-1-f)*g+(1.5+f)*y+.5*p,_=f*g-f*y;for(let C=0;C!==a;++C)r[C]=m*o[h+C]+x*o[c+C]+M*o[l+C]+_*o[u+C];return r}},ih=class extends cr{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=(n-t)/(s-t),u=1-h;for(let d=0;d!==a;++d)r[d]=o[c+d]*u+o[l+d]*h;return r}},sh=class extends cr{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e){return this.copySampleValue_(e-1)}},rh=class extends cr{interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=this.inTangents,u=this.outTangents;if(!h||!u){let p=(n-t)/(s-t),y=1-p;for(let g=0;g!==a;++g)r[g]=o[c+g]*y+o[l+g]*p;return r}let d=a*2,f=e-1;for(let p=0;p!==a;++p){let y=o[c+p],g=o[l+p],m=f*d+p*2,x=u[m],M=u[m+1],_=e*d+p*2,C=h[_],T=h[_+1],v=Ob(n,t,x,C,s);r[p]=w0(v,y,M,T,g)}return r}};function w0(i,e,t,n,s){let r=1-i;return r*r*r*e+3*r*r*i*t+3*r*i*i*n+i*i*i*s}function Ub(i,e,t,n,s){let r=1-i;return 3*r*r*(t-e)+6*r*i*(n-t)+3*i*i*(s-n)}function Ob(i,e,t,n,s){let r=(i-e)/(s-e);for(let o=0;o<8;o++){let a=w0(r,e,t,n,s)-i;if(Math.abs(a)<1e-10)break;let l=Ub(r,e,t,n,s);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-a/l))}return r}var Pi=class{constructor(e,t,n,s){if(e===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(t===void 0||t.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+e);this.name=e,this.times=yo(t,this.TimeBufferType),this.values=yo(n,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(e){let t=e.constructor,n;if(t.toJSON!==this.toJSON)n=t.toJSON(e);else{n={name:e.name,times:yo(e.times,Array),values:yo(e.values,Array)};let s=e.getInterpolation();s!==e.DefaultInterpolation&&(n.interpolation=s),Tc(e.settings)&&(n.settings={inTangents:yo(e.settings.inTangents,Array),outTangents:yo(e.settings.outTangents,Array)})}return n.type=e.ValueTypeName,n}InterpolantFactoryMethodDiscrete(e){return new sh(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodLinear(e){return new ih(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodSmooth(e){return new nh(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodBezier(e){let t=new rh(this.times,this.values,this.getValueSize(),e);return this.settings&&(t.inTangents=this.settings.inTangents,t.outTangents=this.settings.outTangents),t}setInterpolation(e){let t;switch(e){case Ta:t=this.InterpolantFactoryMethodDiscrete;break;case zc:t=this.InterpolantFactoryMethodLinear;break;case Pc:t=this.InterpolantFactoryMethodSmooth;break;case pf:t=this.InterpolantFactoryMethodBezier;break}if(t===void 0){let n="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(e!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(n);return it("KeyframeTrack:",n),this}return this.createInterpolant=t,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return Ta;case this.InterpolantFactoryMethodLinear:return zc;case this.InterpolantFactoryMethodSmooth:return Pc;case this.InterpolantFactoryMethodBezier:return pf}}getValueSize(){return this.values.length/this.times.length}shift(e){if(e!==0){let t=this.times;for(let n=0,s=t.length;n!==s;++n)t[n]+=e;Tc(this.settings)&&(Cg(this.settings.inTangents,e),Cg(this.settings.outTangents,e))}return this}scale(e){if(e!==1){let t=this.times;for(let n=0,s=t.length;n!==s;++n)t[n]*=e;Tc(this.settings)&&(Pg(this.settings.inTangents,e),Pg(this.settings.outTangents,e))}return this}trim(e,t){let n=this.times,s=n.length,r=0,o=s-1;for(;r!==s&&n[r]<e;)++r;for(;o!==-1&&n[o]>t;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=n.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let e=!0,t=this.getValueSize();t-Math.floor(t)!==0&&(ht("KeyframeTrack: Invalid value size in track.",this),e=!1);let n=this.times,s=this.values,r=n.length;r===0&&(ht("KeyframeTrack: Track is empty.",this),e=!1);let o=null;for(let a=0;a!==r;a++){let l=n[a];if(typeof l=="number"&&isNaN(l)){ht("KeyframeTrack: Time is not a valid number.",this,a,l),e=!1;break}if(o!==null&&o>l){ht("KeyframeTrack: Out of order keys.",this,a,l,o),e=!1;break}o=l}if(s!==void 0&&v_(s))for(let a=0,l=s.length;a!==l;++a){let c=s[a];if(isNaN(c)){ht("KeyframeTrack: Value is not a valid number.",this,a,c),e=!1;break}}return e}optimize(){let e=this.times.slice(),t=this.values.slice(),n=this.getValueSize(),s=this.getInterpolation()===Pc,r=e.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=e[a],h=e[a+1];if(c!==h&&(a!==1||c!==e[0]))if(s)l=!0;else{let u=a*n,d=u-n,f=u+n;for(let p=0;p!==n;++p){let y=t[u+p];if(y!==t[d+p]||y!==t[f+p]){l=!0;break}}}if(l){if(a!==o){e[o]=e[a];let u=a*n,d=o*n;for(let f=0;f!==n;++f)t[d+f]=t[u+f]}++o}}if(r>0){e[o]=e[r];for(let a=r*n,l=o*n,c=0;c!==n;++c)t[l+c]=t[a+c];++o}return o!==e.length?(this.times=e.slice(0,o),this.values=t.slice(0,o*n)):(this.times=e,this.values=t),this}clone(){let e=this.times.slice(),t=this.values.slice(),n=this.constructor,s=new n(this.name,e,t);return s.createInterpolant=this.createInterpolant,Tc(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function Cg(i,e){for(let t=0,n=i.length;t!==n;t+=2)i[t]+=e}function Pg(i,e){for(let t=0,n=i.length;t!==n;t+=2)i[t]*=e}Pi.prototype.ValueTypeName="";Pi.prototype.TimeBufferType=Float32Array;Pi.prototype.ValueBufferType=Float32Array;Pi.prototype.DefaultInterpolation=zc;var hr=class extends Pi{constructor(e,t,n){super(e,t,n)}};hr.prototype.ValueTypeName="bool";hr.prototype.ValueBufferType=Array;hr.prototype.DefaultInterpolation=Ta;hr.prototype.InterpolantFactoryMethodLinear=void 0;hr.prototype.InterpolantFactoryMethodSmooth=void 0;var oh=class extends Pi{constructor(e,t,n,s){super(e,t,n,s)}};oh.prototype.ValueTypeName="color";var ah=class extends Pi{constructor(e,t,n,s){super(e,t,n,s)}};ah.prototype.ValueTypeName="number";var lh=class extends cr{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(n-t)/(s-t),c=e*a;for(let h=c+a;c!==h;c+=4)nt.slerpFlat(r,0,o,c-a,o,c,l);return r}},il=class extends Pi{constructor(e,t,n,s){super(e,t,n,s)}InterpolantFactoryMethodLinear(e){return new lh(this.times,this.values,this.getValueSize(),e)}};il.prototype.ValueTypeName="quaternion";il.prototype.InterpolantFactoryMethodSmooth=void 0;var ur=class extends Pi{constructor(e,t,n){super(e,t,n)}};ur.prototype.ValueTypeName="string";ur.prototype.ValueBufferType=Array;ur.prototype.DefaultInterpolation=Ta;ur.prototype.InterpolantFactoryMethodLinear=void 0;ur.prototype.InterpolantFactoryMethodSmooth=void 0;var ch=class extends Pi{constructor(e,t,n,s){super(e,t,n,s)}};ch.prototype.ValueTypeName="vector";var hh=class{constructor(e,t,n){let s=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=e,this.onProgress=t,this.onError=n,this._abortController=null,this.itemStart=function(h){a++,r===!1&&s.onStart!==void 0&&s.onStart(h,o,a),r=!0},this.itemEnd=function(h){o++,s.onProgress!==void 0&&s.onProgress(h,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(h){s.onError!==void 0&&s.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),l?l(h):h},this.setURLModifier=function(h){return l=h,this},this.addHandler=function(h,u){return c.push(h,u),this},this.removeHandler=function(h){let u=c.indexOf(h);return u!==-1&&c.splice(u,2),this},this.getHandler=function(h){for(let u=0,d=c.length;u<d;u+=2){let f=c[u],p=c[u+1];if(f.global&&(f.lastIndex=0),f.test(h))return p}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},T0=new hh,uh=class{constructor(e){this.manager=e!==void 0?e:T0,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(e,t){let n=this;return new Promise(function(s,r){n.load(e,s,t,r)})}parse(){}setCrossOrigin(e){return this.crossOrigin=e,this}setWithCredentials(e){return this.withCredentials=e,this}setPath(e){return this.path=e,this}setResourcePath(e){return this.resourcePath=e,this}setRequestHeader(e){return this.requestHeader=e,this}setPriority(e){return this.priority=e,this}setCache(e){return this.cache=e,this}abort(){return this}};uh.DEFAULT_MATERIAL_NAME="__DEFAULT";var sl=class extends cn{static registerNode(e){this.prototype._lightNode=e}constructor(e,t=1){super(),this.isLight=!0,this.type="Light",this.color=new et(e),this.intensity=t}copy(e,t){return super.copy(e,t),this.color.copy(e.color),this.intensity=e.intensity,this}toJSON(e){let t=super.toJSON(e);return t.object.color=this.color.getHex(),t.object.intensity=this.intensity,t}},rl=class extends sl{constructor(e,t,n){super(e,n),this.isHemisphereLight=!0,this.type="HemisphereLight",this.position.copy(cn.DEFAULT_UP),this.updateMatrix(),this.groundColor=new et(t)}copy(e,t){return super.copy(e,t),this.groundColor.copy(e.groundColor),this}toJSON(e){let t=super.toJSON(e);return t.object.groundColor=this.groundColor.getHex(),t}},df=new Qe,Ig=new S,Lg=new S,dh=class{constructor(e){this.camera=e,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new ue(512,512),this.mapType=yi,this.map=null,this.mapPass=null,this.matrix=new Qe,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new Us,this._frameExtents=new ue(1,1),this._viewportCount=1,this._viewports=[new Gt(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(e){let t=this.camera;Ig.setFromMatrixPosition(e.matrixWorld),t.position.copy(Ig),Lg.setFromMatrixPosition(e.target.matrixWorld),t.lookAt(Lg),t.updateMatrixWorld(),this._updateMatrix(t,this.matrix,this._frustum)}_updateMatrix(e,t,n,s){df.multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse),n.setFromProjectionMatrix(df,e.coordinateSystem,e.reversedDepth);let r=this._frameExtents,o=s?s.z/r.x:1,a=s?s.w/r.y:1,l=s?s.x/r.x:0,c=s?s.y/r.y:0;e.coordinateSystem===wo||e.reversedDepth?t.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,1,0,0,0,0,1):t.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,.5,.5,0,0,0,1),t.multiply(df)}getViewport(e){return this._viewports[e]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(e){return this.camera=e.camera.clone(),this.intensity=e.intensity,this.bias=e.bias,this.radius=e.radius,this.autoUpdate=e.autoUpdate,this.needsUpdate=e.needsUpdate,this.normalBias=e.normalBias,this.blurSamples=e.blurSamples,this.mapSize.copy(e.mapSize),this.mapType=e.mapType,this.biasNode=e.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let e={};return e.intensity=this.intensity,e.bias=this.bias,e.normalBias=this.normalBias,e.radius=this.radius,e.blurSamples=this.blurSamples,e.mapSize=this.mapSize.toArray(),e.mapType=this.mapType,e.camera=this.camera.toJSON(!1).object,delete e.camera.matrix,e}},Ac=new S,Rc=new nt,us=new S,ol=class extends cn{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new Qe,this.projectionMatrix=new Qe,this.projectionMatrixInverse=new Qe,this.coordinateSystem=Oi,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(e,t){return super.copy(e,t),this.matrixWorldInverse.copy(e.matrixWorldInverse),this.projectionMatrix.copy(e.projectionMatrix),this.projectionMatrixInverse.copy(e.projectionMatrixInverse),this.coordinateSystem=e.coordinateSystem,this}getWorldDirection(e){return super.getWorldDirection(e).negate()}updateMatrixWorld(e){super.updateMatrixWorld(e),this.matrixWorld.decompose(Ac,Rc,us),us.x===1&&us.y===1&&us.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Ac,Rc,us.set(1,1,1)).invert()}updateWorldMatrix(e,t,n=!1){super.updateWorldMatrix(e,t,n),this.matrixWorld.decompose(Ac,Rc,us),us.x===1&&us.y===1&&us.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Ac,Rc,us.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},rr=new S,Dg=new ue,Ng=new ue,ri=class extends ol{constructor(e=50,t=1,n=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=e,this.zoom=1,this.near=n,this.far=s,this.focus=10,this.aspect=t,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.fov=e.fov,this.zoom=e.zoom,this.near=e.near,this.far=e.far,this.focus=e.focus,this.aspect=e.aspect,this.view=e.view===null?null:Object.assign({},e.view),this.filmGauge=e.filmGauge,this.filmOffset=e.filmOffset,this}setFocalLength(e){let t=.5*this.getFilmHeight()/e;this.fov=Ao*2*Math.atan(t),this.updateProjectionMatrix()}getFocalLength(){let e=Math.tan(Mo*.5*this.fov);return .5*this.getFilmHeight()/e}getEffectiveFOV(){return Ao*2*Math.atan(Math.tan(Mo*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(e,t,n){rr.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),t.set(rr.x,rr.y).multiplyScalar(-e/rr.z),rr.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(rr.x,rr.y).multiplyScalar(-e/rr.z)}getViewSize(e,t){return this.getViewBounds(e,Dg,Ng),t.subVectors(Ng,Dg)}setViewOffset(e,t,n,s,r,o){this.aspect=e/t,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=this.near,t=e*Math.tan(Mo*.5*this.fov)/this.zoom,n=2*t,s=this.aspect*n,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*s/l,t-=o.offsetY*n/c,s*=o.width/l,n*=o.height/c}let a=this.filmOffset;a!==0&&(r+=e*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,t,t-n,e,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.fov=this.fov,t.object.zoom=this.zoom,t.object.near=this.near,t.object.far=this.far,t.object.focus=this.focus,t.object.aspect=this.aspect,this.view!==null&&(t.object.view=Object.assign({},this.view)),t.object.filmGauge=this.filmGauge,t.object.filmOffset=this.filmOffset,t}};var al=class extends ol{constructor(e=-1,t=1,n=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=e,this.right=t,this.top=n,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.left=e.left,this.right=e.right,this.top=e.top,this.bottom=e.bottom,this.near=e.near,this.far=e.far,this.zoom=e.zoom,this.view=e.view===null?null:Object.assign({},e.view),this}setViewOffset(e,t,n,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=(this.right-this.left)/(2*this.zoom),t=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=n-e,o=n+e,a=s+t,l=s-t;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=h*this.view.offsetY,l=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.zoom=this.zoom,t.object.left=this.left,t.object.right=this.right,t.object.top=this.top,t.object.bottom=this.bottom,t.object.near=this.near,t.object.far=this.far,this.view!==null&&(t.object.view=Object.assign({},this.view)),t}},Mf=class extends dh{constructor(){super(new al(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},ll=class extends sl{constructor(e,t){super(e,t),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(cn.DEFAULT_UP),this.updateMatrix(),this.target=new cn,this.shadow=new Mf}dispose(){super.dispose(),this.shadow.dispose()}copy(e){return super.copy(e),this.target=e.target.clone(),this.shadow=e.shadow.clone(),this}toJSON(e){let t=super.toJSON(e);return t.object.shadow=this.shadow.toJSON(),t.object.target=this.target.uuid,t}};var cl=class extends wt{constructor(){super(),this.isInstancedBufferGeometry=!0,this.type="InstancedBufferGeometry",this.instanceCount=1/0}copy(e){return super.copy(e),this.instanceCount=e.instanceCount,this}toJSON(){let e=super.toJSON();return e.instanceCount=this.instanceCount,e.isInstancedBufferGeometry=!0,e}};var xo=-90,vo=1,Fo=class extends cn{constructor(e,t,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new ri(xo,vo,e,t);s.layers=this.layers,this.add(s);let r=new ri(xo,vo,e,t);r.layers=this.layers,this.add(r);let o=new ri(xo,vo,e,t);o.layers=this.layers,this.add(o);let a=new ri(xo,vo,e,t);a.layers=this.layers,this.add(a);let l=new ri(xo,vo,e,t);l.layers=this.layers,this.add(l);let c=new ri(xo,vo,e,t);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let e=this.coordinateSystem,t=this.children.concat(),[n,s,r,o,a,l]=t;for(let c of t)this.remove(c);if(e===Oi)n.up.set(0,1,0),n.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(e===wo)n.up.set(0,-1,0),n.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+e);for(let c of t)this.add(c),c.updateMatrixWorld()}update(e,t){this.parent===null&&this.updateMatrixWorld();let{renderTarget:n,activeMipmapLevel:s}=this;this.coordinateSystem!==e.coordinateSystem&&(this.coordinateSystem=e.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,h]=this.children,u=e.getRenderTarget(),d=e.getActiveCubeFace(),f=e.getActiveMipmapLevel(),p=e.xr.enabled;e.xr.enabled=!1;let y=n.texture.mipmapsAutoUpdate;n.texture.mipmapsAutoUpdate=!1;let g=!1;e.isWebGLRenderer===!0?g=e.state.buffers.depth.getReversed():g=e.reversedDepthBuffer,e.setRenderTarget(n,0,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,r),e.setRenderTarget(n,1,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,o),e.setRenderTarget(n,2,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,a),e.setRenderTarget(n,3,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,l),e.setRenderTarget(n,4,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,c),n.texture.mipmapsAutoUpdate=y,e.setRenderTarget(n,5,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,h),e.setRenderTarget(u,d,f),e.xr.enabled=p,n.texture.needsPMREMUpdate=!0}},fh=class extends ri{constructor(e=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=e,this.perCameraFrustumCulled=!1}};var sp="\\[\\]\\.:\\/",Bb=new RegExp("["+sp+"]","g"),rp="[^"+sp+"]",kb="[^"+sp.replace("\\.","")+"]",Hb=/((?:WC+[\/:])*)/.source.replace("WC",rp),zb=/(WCOD+)?/.source.replace("WCOD",kb),Vb=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",rp),Gb=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",rp),Wb=new RegExp("^"+Hb+zb+Vb+Gb+"$"),Xb=["material","materials","bones","map"],Sf=class{constructor(e,t,n){let s=n||nn.parseTrackName(t);this._targetGroup=e,this._bindings=e.subscribe_(t,s)}getValue(e,t){this.bind();let n=this._targetGroup.nCachedObjects_,s=this._bindings[n];s!==void 0&&s.getValue(e,t)}setValue(e,t){let n=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=n.length;s!==r;++s)n[s].setValue(e,t)}bind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,n=e.length;t!==n;++t)e[t].bind()}unbind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,n=e.length;t!==n;++t)e[t].unbind()}},nn=class i{constructor(e,t,n){this.path=t,this.parsedPath=n||i.parseTrackName(t),this.node=i.findNode(e,this.parsedPath.nodeName),this.rootNode=e,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(e,t,n){return e&&e.isAnimationObjectGroup?new i.Composite(e,t,n):new i(e,t,n)}static sanitizeNodeName(e){return e.replace(/\s/g,"_").replace(Bb,"")}static parseTrackName(e){let t=Wb.exec(e);if(t===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+e);let n={nodeName:t[2],objectName:t[3],objectIndex:t[4],propertyName:t[5],propertyIndex:t[6]},s=n.nodeName&&n.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=n.nodeName.substring(s+1);Xb.indexOf(r)!==-1&&(n.nodeName=n.nodeName.substring(0,s),n.objectName=r)}if(n.propertyName===null||n.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+e);return n}static findNode(e,t){if(t===void 0||t===""||t==="."||t===-1||t===e.name||t===e.uuid)return e;if(e.skeleton){let n=e.skeleton.getBoneByName(t);if(n!==void 0)return n}if(e.children){let n=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===t||a.uuid===t)return a;let l=n(a.children);if(l)return l}return null},s=n(e.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(e,t){e[t]=this.targetObject[this.propertyName]}_getValue_array(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)e[t++]=n[s]}_getValue_arrayElement(e,t){e[t]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(e,t){this.resolvedProperty.toArray(e,t)}_setValue_direct(e,t){this.targetObject[this.propertyName]=e[t]}_setValue_direct_setNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++]}_setValue_array_setNeedsUpdate(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(e,t){this.resolvedProperty[this.propertyIndex]=e[t]}_setValue_arrayElement_setNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(e,t){this.resolvedProperty.fromArray(e,t)}_setValue_fromArray_setNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(e,t){this.bind(),this.getValue(e,t)}_setValue_unbound(e,t){this.bind(),this.setValue(e,t)}bind(){let e=this.node,t=this.parsedPath,n=t.objectName,s=t.propertyName,r=t.propertyIndex;if(e||(e=i.findNode(this.rootNode,t.nodeName),this.node=e),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!e){it("PropertyBinding: No target node found for track: "+this.path+".");return}if(n){let c=t.objectIndex;switch(n){case"materials":if(!e.material){ht("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.materials){ht("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}e=e.material.materials;break;case"bones":if(!e.skeleton){ht("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}e=e.skeleton.bones;for(let h=0;h<e.length;h++)if(e[h].name===c){c=h;break}break;case"map":if("map"in e){e=e.map;break}if(!e.material){ht("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.map){ht("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}e=e.material.map;break;default:if(e[n]===void 0){ht("PropertyBinding: Can not bind to objectName of node undefined.",this);return}e=e[n]}if(c!==void 0){if(e[c]===void 0){ht("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,e);return}e=e[c]}}let o=e[s];if(o===void 0){let c=t.nodeName;ht("PropertyBinding: Trying to update property for track: "+c+"."+s+" but it wasn't found.",e);return}let a=this.Versioning.None;this.targetObject=e,e.isMaterial===!0?a=this.Versioning.NeedsUpdate:e.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!e.geometry){ht("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!e.geometry.morphAttributes){ht("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}e.morphTargetDictionary[r]!==void 0&&(r=e.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};nn.Composite=Sf;nn.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};nn.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};nn.prototype.GetterByBindingType=[nn.prototype._getValue_direct,nn.prototype._getValue_array,nn.prototype._getValue_arrayElement,nn.prototype._getValue_toArray];nn.prototype.SetterByBindingTypeAndVersioning=[[nn.prototype._setValue_direct,nn.prototype._setValue_direct_setNeedsUpdate,nn.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[nn.prototype._setValue_array,nn.prototype._setValue_array_setNeedsUpdate,nn.prototype._setValue_array_setMatrixWorldNeedsUpdate],[nn.prototype._setValue_arrayElement,nn.prototype._setValue_arrayElement_setNeedsUpdate,nn.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[nn.prototype._setValue_fromArray,nn.prototype._setValue_fromArray_setNeedsUpdate,nn.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var n3=new Float32Array(1);var dr=class extends Fa{constructor(e,t,n=1){super(e,t),this.isInstancedInterleavedBuffer=!0,this.meshPerAttribute=n}copy(e){return super.copy(e),this.meshPerAttribute=e.meshPerAttribute,this}clone(e){let t=super.clone(e);return t.meshPerAttribute=this.meshPerAttribute,t}toJSON(e){let t=super.toJSON(e);return t.isInstancedInterleavedBuffer=!0,t.meshPerAttribute=this.meshPerAttribute,t}};var Fg=new Qe,zs=class{constructor(e,t,n=0,s=1/0){this.ray=new ar(e,t),this.near=n,this.far=s,this.camera=null,this.layers=new Co,this.params={Mesh:{},Line:{threshold:1},LOD:{},Points:{threshold:1},Sprite:{}}}set(e,t){this.ray.set(e,t)}setFromCamera(e,t){t.isPerspectiveCamera?(this.ray.origin.setFromMatrixPosition(t.matrixWorld),this.ray.direction.set(e.x,e.y,.5).unproject(t).sub(this.ray.origin).normalize(),this.camera=t):t.isOrthographicCamera?(this.ray.origin.set(e.x,e.y,t.projectionMatrix.elements[14]).unproject(t),this.ray.direction.set(0,0,-1).transformDirection(t.matrixWorld),this.camera=t):ht("Raycaster: Unsupported camera type: "+t.type)}setFromXRController(e){return Fg.identity().extractRotation(e.matrixWorld),this.ray.origin.setFromMatrixPosition(e.matrixWorld),this.ray.direction.set(0,0,-1).applyMatrix4(Fg),this}intersectObject(e,t=!0,n=[]){return Ef(e,this,n,t),n.sort(Ug),n}intersectObjects(e,t=!0,n=[]){for(let s=0,r=e.length;s<r;s++)Ef(e[s],this,n,t);return n.sort(Ug),n}};function Ug(i,e){return i.distance-e.distance}function Ef(i,e,t,n){let s=!0;if(i.layers.test(e.layers)&&i.raycast(e,t)===!1&&(s=!1),s===!0&&n===!0){let r=i.children;for(let o=0,a=r.length;o<a;o++)Ef(r[o],e,t,!0)}}var Uo=class{constructor(e=1,t=0,n=0){this.radius=e,this.phi=t,this.theta=n}set(e,t,n){return this.radius=e,this.phi=t,this.theta=n,this}copy(e){return this.radius=e.radius,this.phi=e.phi,this.theta=e.theta,this}makeSafe(){return this.phi=mt(this.phi,1e-6,Math.PI-1e-6),this}setFromVector3(e){return this.setFromCartesianCoords(e.x,e.y,e.z)}setFromCartesianCoords(e,t,n){return this.radius=Math.sqrt(e*e+t*t+n*n),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(e,n),this.phi=Math.acos(mt(t/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var wf=class{static{this.prototype.isMatrix2=!0}constructor(e,t,n,s){this.elements=[1,0,0,1],e!==void 0&&this.set(e,t,n,s)}identity(){return this.set(1,0,0,1),this}fromArray(e,t=0){for(let n=0;n<4;n++)this.elements[n]=e[n+t];return this}set(e,t,n,s){let r=this.elements;return r[0]=e,r[2]=t,r[1]=n,r[3]=s,this}};var Og=new S,Cc=new S,_o=new S,bo=new S,ff=new S,qb=new S,Yb=new S,hl=class{constructor(e=new S,t=new S){this.start=e,this.end=t}set(e,t){return this.start.copy(e),this.end.copy(t),this}copy(e){return this.start.copy(e.start),this.end.copy(e.end),this}getCenter(e){return e.addVectors(this.start,this.end).multiplyScalar(.5)}delta(e){return e.subVectors(this.end,this.start)}distanceSq(){return this.start.distanceToSquared(this.end)}distance(){return this.start.distanceTo(this.end)}at(e,t){return this.delta(t).multiplyScalar(e).add(this.start)}closestPointToPointParameter(e,t){Og.subVectors(e,this.start),Cc.subVectors(this.end,this.start);let n=Cc.dot(Cc);if(n===0)return 0;let r=Cc.dot(Og)/n;return t&&(r=mt(r,0,1)),r}closestPointToPoint(e,t,n){let s=this.closestPointToPointParameter(e,t);return this.delta(n).multiplyScalar(s).add(this.start)}distanceSqToLine3(e,t=qb,n=Yb){let s=10000000000000001e-32,r,o,a=this.start,l=e.start,c=this.end,h=e.end;_o.subVectors(c,a),bo.subVectors(h,l),ff.subVectors(a,l);let u=_o.dot(_o),d=bo.dot(bo),f=bo.dot(ff);if(u<=s&&d<=s)return t.copy(a),n.copy(l),t.distanceToSquared(n);if(u<=s)r=0,o=f/d,o=mt(o,0,1);else{let p=_o.dot(ff);if(d<=s)o=0,r=mt(-p/u,0,1);else{let y=_o.dot(bo),g=u*d-y*y;g!==0?r=mt((y*f-p*d)/g,0,1):r=0,o=(y*r+f)/d,o<0?(o=0,r=mt(-p/u,0,1)):o>1&&(o=1,r=mt((y-p)/u,0,1))}}return t.copy(a).addScaledVector(_o,r),n.copy(l).addScaledVector(bo,o),t.distanceToSquared(n)}applyMatrix4(e){return this.start.applyMatrix4(e),this.end.applyMatrix4(e),this}equals(e){return e.start.equals(this.start)&&e.end.equals(this.end)}clone(){return new this.constructor().copy(this)}};var ul=class extends Ji{constructor(e,t=null){super(),this.object=e,this.domElement=t,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(e){this.domElement!==null&&this.disconnect(),this.domElement=e}disconnect(){}dispose(){}update(){}};function op(i,e,t,n){let s=$b(n);switch(t){case Xf:return i*e;case _h:return i*e/s.components*s.byteLength;case pl:return i*e/s.components*s.byteLength;case yr:return i*e*2/s.components*s.byteLength;case bh:return i*e*2/s.components*s.byteLength;case qf:return i*e*3/s.components*s.byteLength;case Ti:return i*e*4/s.components*s.byteLength;case Mh:return i*e*4/s.components*s.byteLength;case ml:case gl:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*8;case yl:case xl:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case Eh:case Th:return Math.max(i,16)*Math.max(e,8)/4;case Sh:case wh:return Math.max(i,8)*Math.max(e,8)/2;case Ah:case Rh:case Ph:case Ih:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*8;case Ch:case vl:case Lh:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case Dh:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case Nh:return Math.floor((i+4)/5)*Math.floor((e+3)/4)*16;case Fh:return Math.floor((i+4)/5)*Math.floor((e+4)/5)*16;case Uh:return Math.floor((i+5)/6)*Math.floor((e+4)/5)*16;case Oh:return Math.floor((i+5)/6)*Math.floor((e+5)/6)*16;case Bh:return Math.floor((i+7)/8)*Math.floor((e+4)/5)*16;case kh:return Math.floor((i+7)/8)*Math.floor((e+5)/6)*16;case Hh:return Math.floor((i+7)/8)*Math.floor((e+7)/8)*16;case zh:return Math.floor((i+9)/10)*Math.floor((e+4)/5)*16;case Vh:return Math.floor((i+9)/10)*Math.floor((e+5)/6)*16;case Gh:return Math.floor((i+9)/10)*Math.floor((e+7)/8)*16;case Wh:return Math.floor((i+9)/10)*Math.floor((e+9)/10)*16;case Xh:return Math.floor((i+11)/12)*Math.floor((e+9)/10)*16;case qh:return Math.floor((i+11)/12)*Math.floor((e+11)/12)*16;case Yh:case $h:case Zh:return Math.ceil(i/4)*Math.ceil(e/4)*16;case Jh:case Kh:return Math.ceil(i/4)*Math.ceil(e/4)*8;case _l:case jh:return Math.ceil(i/4)*Math.ceil(e/4)*16}throw new Error(`Unable to determine texture byte length for ${t} format.`)}function $b(i){switch(i){case yi:case zf:return{byteLength:1,components:1};case Ho:case Vf:case ji:return{byteLength:2,components:1};case xh:case vh:return{byteLength:2,components:4};case zi:case yh:case pi:return{byteLength:4,components:1};case Gf:case Wf:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${i}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?it("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function $0(){let i=null,e=!1,t=null,n=null;function s(r,o){n=i.requestAnimationFrame(s),t(r,o)}return{start:function(){e!==!0&&t!==null&&i!==null&&(n=i.requestAnimationFrame(s),e=!0)},stop:function(){i!==null&&i.cancelAnimationFrame(n),e=!1},setAnimationLoop:function(r){t=r},setContext:function(r){i=r}}}function Qb(i){let e=new WeakMap;function t(a,l){let c=a.array,h=a.usage,u=c.byteLength,d=i.createBuffer();i.bindBuffer(l,d),i.bufferData(l,c,h),a.onUploadCallback();let f;if(c instanceof Float32Array)f=i.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)f=i.HALF_FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?f=i.HALF_FLOAT:f=i.UNSIGNED_SHORT;else if(c instanceof Int16Array)f=i.SHORT;else if(c instanceof Uint32Array)f=i.UNSIGNED_INT;else if(c instanceof Int32Array)f=i.INT;else if(c instanceof Int8Array)f=i.BYTE;else if(c instanceof Uint8Array)f=i.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)f=i.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:d,type:f,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:u}}function n(a,l,c){let h=l.array,u=l.updateRanges;if(i.bindBuffer(c,a),u.length===0)i.bufferSubData(c,0,h);else{u.sort((f,p)=>f.start-p.start);let d=0;for(let f=1;f<u.length;f++){let p=u[d],y=u[f];y.start<=p.start+p.count+1?p.count=Math.max(p.count,y.start+y.count-p.start):(++d,u[d]=y)}u.length=d+1;for(let f=0,p=u.length;f<p;f++){let y=u[f];i.bufferSubData(c,y.start*h.BYTES_PER_ELEMENT,h,y.start,y.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),e.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=e.get(a);l&&(i.deleteBuffer(l.buffer),e.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let h=e.get(a);(!h||h.version<a.version)&&e.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let c=e.get(a);if(c===void 0)e.set(a,t(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(c.buffer,a,l),c.version=a.version}}return{get:s,remove:r,update:o}}var eM=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,tM=`#ifdef USE_ALPHAHASH
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
#endif`,nM=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,iM=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,sM=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,rM=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,oM=`#ifdef USE_AOMAP
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
#endif`,aM=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,lM=`#ifdef USE_BATCHING
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
#endif`,cM=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,hM=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,uM=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,dM=`float G_BlinnPhong_Implicit( ) {
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
} // validated`,fM=`#ifdef USE_IRIDESCENCE
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
#endif`,pM=`#ifdef USE_BUMPMAP
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
#endif`,mM=`#if NUM_CLIPPING_PLANES > 0
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
#endif`,gM=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,yM=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,xM=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,vM=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,_M=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,bM=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,MM=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
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
#endif`,SM=`#define PI 3.141592653589793
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
} // validated`,EM=`vec3 transformedNormal = objectNormal;
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
#endif`,wM=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,TM=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,AM=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,RM=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,CM="gl_FragColor = linearToOutputTexel( gl_FragColor );",PM=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,IM=`#ifdef USE_ENVMAP
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
#endif`,LM=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,DM=`#ifdef USE_ENVMAP
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
#endif`,NM=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,FM=`#ifdef USE_ENVMAP
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
#endif`,UM=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,OM=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,BM=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,kM=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,HM=`#ifdef USE_GRADIENTMAP
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
}`,zM=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,VM=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,GM=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,WM=`uniform bool receiveShadow;
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
#include <lightprobes_pars_fragment>`,XM=`#ifdef USE_ENVMAP
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
#endif`,qM=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,YM=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,$M=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,ZM=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,JM=`PhysicalMaterial material;
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
#endif`,KM=`uniform sampler2D dfgLUT;
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
}`,jM=`
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
#endif`,QM=`#if defined( RE_IndirectDiffuse )
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
#endif`,eS=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,tS=`#if NUM_LIGHT_PROBE_GRIDS > 0
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
#endif`,nS=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,iS=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,sS=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,rS=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,oS=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,aS=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,lS=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
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
#endif`,cS=`#if defined( USE_POINTS_UV )
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
#endif`,hS=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,uS=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,dS=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,fS=`#if defined( USE_MORPHCOLORS )
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
#endif`,pS=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,mS=`#ifdef USE_MORPHTARGETS
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
#endif`,gS=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,yS=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
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
vec3 nonPerturbedNormal = normal;`,xS=`#ifdef USE_NORMALMAP_OBJECTSPACE
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
#endif`,vS=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,_S=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,bS=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,MS=`#ifdef USE_NORMALMAP
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
#endif`,SS=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,ES=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,wS=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,TS=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,AS=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,RS=`vec3 packNormalToRGB( const in vec3 normal ) {
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
}`,CS=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,PS=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,IS=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,LS=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,DS=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,NS=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,FS=`#if NUM_SPOT_LIGHT_COORDS > 0
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
#endif`,US=`#if NUM_SPOT_LIGHT_COORDS > 0
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
#endif`,OS=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
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
#endif`,BS=`float getShadowMask() {
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
}`,kS=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,HS=`#ifdef USE_SKINNING
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
#endif`,zS=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,VS=`#ifdef USE_SKINNING
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
#endif`,GS=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,WS=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,XS=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,qS=`#ifndef saturate
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
vec3 CustomToneMapping( vec3 color ) { return color; }`,YS=`#ifdef USE_TRANSMISSION
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
#endif`,$S=`#ifdef USE_TRANSMISSION
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
#endif`,ZS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,JS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,KS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,jS=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,QS=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,eE=`uniform sampler2D t2D;
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
}`,tE=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,nE=`uniform float backgroundBlurriness;
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
}`,iE=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,sE=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,rE=`#include <common>
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
}`,oE=`#if DEPTH_PACKING == 3200
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
}`,aE=`#define DISTANCE
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
}`,lE=`#define DISTANCE
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
}`,cE=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,hE=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,uE=`uniform float scale;
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
}`,dE=`uniform vec3 diffuse;
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
}`,fE=`#include <common>
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
}`,pE=`uniform vec3 diffuse;
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
}`,mE=`#define LAMBERT
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
}`,gE=`#define LAMBERT
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
}`,yE=`#define MATCAP
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
}`,xE=`#define MATCAP
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
}`,vE=`#define NORMAL
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
}`,_E=`#define NORMAL
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
}`,bE=`#define PHONG
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
}`,ME=`#define PHONG
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
}`,SE=`#define STANDARD
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
}`,EE=`#define STANDARD
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
}`,wE=`#define TOON
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
}`,TE=`#define TOON
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
}`,AE=`uniform float size;
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
}`,RE=`uniform vec3 diffuse;
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
}`,CE=`#include <common>
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
}`,PE=`uniform vec3 color;
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
}`,IE=`uniform float rotation;
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
}`,LE=`uniform vec3 diffuse;
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
}`,Et={alphahash_fragment:eM,alphahash_pars_fragment:tM,alphamap_fragment:nM,alphamap_pars_fragment:iM,alphatest_fragment:sM,alphatest_pars_fragment:rM,aomap_fragment:oM,aomap_pars_fragment:aM,batching_pars_vertex:lM,batching_vertex:cM,begin_vertex:hM,beginnormal_vertex:uM,bsdfs:dM,iridescence_fragment:fM,bumpmap_pars_fragment:pM,clipping_planes_fragment:mM,clipping_planes_pars_fragment:gM,clipping_planes_pars_vertex:yM,clipping_planes_vertex:xM,color_fragment:vM,color_pars_fragment:_M,color_pars_vertex:bM,color_vertex:MM,common:SM,defaultnormal_vertex:EM,displacementmap_pars_vertex:wM,displacementmap_vertex:TM,emissivemap_fragment:AM,emissivemap_pars_fragment:RM,colorspace_fragment:CM,colorspace_pars_fragment:PM,envmap_fragment:IM,envmap_common_pars_fragment:LM,envmap_pars_fragment:DM,envmap_pars_vertex:NM,envmap_physical_pars_fragment:XM,envmap_vertex:FM,fog_vertex:UM,fog_pars_vertex:OM,fog_fragment:BM,fog_pars_fragment:kM,gradientmap_pars_fragment:HM,lightmap_pars_fragment:zM,lights_lambert_fragment:VM,lights_lambert_pars_fragment:GM,lights_pars_begin:WM,lights_toon_fragment:qM,lights_toon_pars_fragment:YM,lights_phong_fragment:$M,lights_phong_pars_fragment:ZM,lights_physical_fragment:JM,lights_physical_pars_fragment:KM,lights_fragment_begin:jM,lights_fragment_maps:QM,lights_fragment_end:eS,lightprobes_pars_fragment:tS,logdepthbuf_fragment:nS,logdepthbuf_pars_fragment:iS,logdepthbuf_pars_vertex:sS,logdepthbuf_vertex:rS,map_fragment:oS,map_pars_fragment:aS,map_particle_fragment:lS,map_particle_pars_fragment:cS,metalnessmap_fragment:hS,metalnessmap_pars_fragment:uS,morphinstance_vertex:dS,morphcolor_vertex:fS,morphnormal_vertex:pS,morphtarget_pars_vertex:mS,morphtarget_vertex:gS,normal_fragment_begin:yS,normal_fragment_maps:xS,normal_pars_fragment:vS,normal_pars_vertex:_S,normal_vertex:bS,normalmap_pars_fragment:MS,clearcoat_normal_fragment_begin:SS,clearcoat_normal_fragment_maps:ES,clearcoat_pars_fragment:wS,iridescence_pars_fragment:TS,opaque_fragment:AS,packing:RS,premultiplied_alpha_fragment:CS,project_vertex:PS,dithering_fragment:IS,dithering_pars_fragment:LS,roughnessmap_fragment:DS,roughnessmap_pars_fragment:NS,shadowmap_pars_fragment:FS,shadowmap_pars_vertex:US,shadowmap_vertex:OS,shadowmask_pars_fragment:BS,skinbase_vertex:kS,skinning_pars_vertex:HS,skinning_vertex:zS,skinnormal_vertex:VS,specularmap_fragment:GS,specularmap_pars_fragment:WS,tonemapping_fragment:XS,tonemapping_pars_fragment:qS,transmission_fragment:YS,transmission_pars_fragment:$S,uv_pars_fragment:ZS,uv_pars_vertex:JS,uv_vertex:KS,worldpos_vertex:jS,background_vert:QS,background_frag:eE,backgroundCube_vert:tE,backgroundCube_frag:nE,cube_vert:iE,cube_frag:sE,depth_vert:rE,depth_frag:oE,distance_vert:aE,distance_frag:lE,equirect_vert:cE,equirect_frag:hE,linedashed_vert:uE,linedashed_frag:dE,meshbasic_vert:fE,meshbasic_frag:pE,meshlambert_vert:mE,meshlambert_frag:gE,meshmatcap_vert:yE,meshmatcap_frag:xE,meshnormal_vert:vE,meshnormal_frag:_E,meshphong_vert:bE,meshphong_frag:ME,meshphysical_vert:SE,meshphysical_frag:EE,meshtoon_vert:wE,meshtoon_frag:TE,points_vert:AE,points_frag:RE,shadow_vert:CE,shadow_frag:PE,sprite_vert:IE,sprite_frag:LE},Fe={common:{diffuse:{value:new et(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new yt},alphaMap:{value:null},alphaMapTransform:{value:new yt},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new yt}},envmap:{envMap:{value:null},envMapRotation:{value:new yt},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new yt}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new yt}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new yt},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new yt},normalScale:{value:new ue(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new yt},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new yt}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new yt}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new yt}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new et(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new et(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new yt},alphaTest:{value:0},uvTransform:{value:new yt}},sprite:{diffuse:{value:new et(16777215)},opacity:{value:1},center:{value:new ue(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new yt},alphaMap:{value:null},alphaMapTransform:{value:new yt},alphaTest:{value:0}}},hi={basic:{uniforms:Kn([Fe.common,Fe.specularmap,Fe.envmap,Fe.aomap,Fe.lightmap,Fe.fog]),vertexShader:Et.meshbasic_vert,fragmentShader:Et.meshbasic_frag},lambert:{uniforms:Kn([Fe.common,Fe.specularmap,Fe.envmap,Fe.aomap,Fe.lightmap,Fe.emissivemap,Fe.bumpmap,Fe.normalmap,Fe.displacementmap,Fe.fog,Fe.lights,{emissive:{value:new et(0)},envMapIntensity:{value:1}}]),vertexShader:Et.meshlambert_vert,fragmentShader:Et.meshlambert_frag},phong:{uniforms:Kn([Fe.common,Fe.specularmap,Fe.envmap,Fe.aomap,Fe.lightmap,Fe.emissivemap,Fe.bumpmap,Fe.normalmap,Fe.displacementmap,Fe.fog,Fe.lights,{emissive:{value:new et(0)},specular:{value:new et(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:Et.meshphong_vert,fragmentShader:Et.meshphong_frag},standard:{uniforms:Kn([Fe.common,Fe.envmap,Fe.aomap,Fe.lightmap,Fe.emissivemap,Fe.bumpmap,Fe.normalmap,Fe.displacementmap,Fe.roughnessmap,Fe.metalnessmap,Fe.fog,Fe.lights,{emissive:{value:new et(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:Et.meshphysical_vert,fragmentShader:Et.meshphysical_frag},toon:{uniforms:Kn([Fe.common,Fe.aomap,Fe.lightmap,Fe.emissivemap,Fe.bumpmap,Fe.normalmap,Fe.displacementmap,Fe.gradientmap,Fe.fog,Fe.lights,{emissive:{value:new et(0)}}]),vertexShader:Et.meshtoon_vert,fragmentShader:Et.meshtoon_frag},matcap:{uniforms:Kn([Fe.common,Fe.bumpmap,Fe.normalmap,Fe.displacementmap,Fe.fog,{matcap:{value:null}}]),vertexShader:Et.meshmatcap_vert,fragmentShader:Et.meshmatcap_frag},points:{uniforms:Kn([Fe.points,Fe.fog]),vertexShader:Et.points_vert,fragmentShader:Et.points_frag},dashed:{uniforms:Kn([Fe.common,Fe.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:Et.linedashed_vert,fragmentShader:Et.linedashed_frag},depth:{uniforms:Kn([Fe.common,Fe.displacementmap]),vertexShader:Et.depth_vert,fragmentShader:Et.depth_frag},normal:{uniforms:Kn([Fe.common,Fe.bumpmap,Fe.normalmap,Fe.displacementmap,{opacity:{value:1}}]),vertexShader:Et.meshnormal_vert,fragmentShader:Et.meshnormal_frag},sprite:{uniforms:Kn([Fe.sprite,Fe.fog]),vertexShader:Et.sprite_vert,fragmentShader:Et.sprite_frag},background:{uniforms:{uvTransform:{value:new yt},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:Et.background_vert,fragmentShader:Et.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new yt}},vertexShader:Et.backgroundCube_vert,fragmentShader:Et.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:Et.cube_vert,fragmentShader:Et.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:Et.equirect_vert,fragmentShader:Et.equirect_frag},distance:{uniforms:Kn([Fe.common,Fe.displacementmap,{referencePosition:{value:new S},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:Et.distance_vert,fragmentShader:Et.distance_frag},shadow:{uniforms:Kn([Fe.lights,Fe.fog,{color:{value:new et(0)},opacity:{value:1}}]),vertexShader:Et.shadow_vert,fragmentShader:Et.shadow_frag}};hi.physical={uniforms:Kn([hi.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new yt},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new yt},clearcoatNormalScale:{value:new ue(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new yt},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new yt},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new yt},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new yt},sheen:{value:0},sheenColor:{value:new et(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new yt},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new yt},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new yt},transmissionSamplerSize:{value:new ue},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new yt},attenuationDistance:{value:0},attenuationColor:{value:new et(0)},specularColor:{value:new et(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new yt},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new yt},anisotropyVector:{value:new ue},anisotropyMap:{value:null},anisotropyMapTransform:{value:new yt}}]),vertexShader:Et.meshphysical_vert,fragmentShader:Et.meshphysical_frag};var eu={r:0,b:0,g:0},DE=new Qe,Z0=new yt;Z0.set(-1,0,0,0,1,0,0,0,1);function NE(i,e,t,n,s,r){let o=new et(0),a=s===!0?0:1,l,c,h=null,u=0,d=null;function f(x){let M=x.isScene===!0?x.background:null;if(M&&M.isTexture){let _=x.backgroundBlurriness>0;M=e.get(M,_)}return M}function p(x){let M=!1,_=f(x);_===null?g(o,a):_&&_.isColor&&(g(_,1),M=!0);let C=i.xr.getEnvironmentBlendMode();C==="additive"?t.buffers.color.setClear(0,0,0,1,r):C==="alpha-blend"&&t.buffers.color.setClear(0,0,0,0,r),(i.autoClear||M)&&(t.buffers.depth.setTest(!0),t.buffers.depth.setMask(!0),t.buffers.color.setMask(!0),i.clear(i.autoClearColor,i.autoClearDepth,i.autoClearStencil))}function y(x,M){let _=f(M);_&&_.isCubeTexture?(c===void 0&&(c=new St(new pn(1,1,1),new ki({name:"BackgroundCubeMaterial",uniforms:Or(hi.backgroundCube.uniforms),vertexShader:hi.backgroundCube.vertexShader,fragmentShader:hi.backgroundCube.fragmentShader,side:li,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(C,T,v){this.matrixWorld.copyPosition(v.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),n.update(c)),c.material.uniforms.envMap.value=_,c.material.uniforms.backgroundBlurriness.value=M.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=M.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(DE.makeRotationFromEuler(M.backgroundRotation)).transpose(),_.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(Z0),c.material.toneMapped=Ct.getTransfer(_.colorSpace)!==Vt,(h!==_||u!==_.version||d!==i.toneMapping)&&(c.material.needsUpdate=!0,h=_,u=_.version,d=i.toneMapping),c.layers.enableAll(),x.unshift(c,c.geometry,c.material,0,0,null)):_&&_.isTexture&&(l===void 0&&(l=new St(new ks(2,2),new ki({name:"BackgroundMaterial",uniforms:Or(hi.background.uniforms),vertexShader:hi.background.vertexShader,fragmentShader:hi.background.fragmentShader,side:gr,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),n.update(l)),l.material.uniforms.t2D.value=_,l.material.uniforms.backgroundIntensity.value=M.backgroundIntensity,l.material.toneMapped=Ct.getTransfer(_.colorSpace)!==Vt,_.matrixAutoUpdate===!0&&_.updateMatrix(),l.material.uniforms.uvTransform.value.copy(_.matrix),(h!==_||u!==_.version||d!==i.toneMapping)&&(l.material.needsUpdate=!0,h=_,u=_.version,d=i.toneMapping),l.layers.enableAll(),x.unshift(l,l.geometry,l.material,0,0,null))}function g(x,M){x.getRGB(eu,ip(i)),t.buffers.color.setClear(eu.r,eu.g,eu.b,M,r)}function m(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return o},setClearColor:function(x,M=1){o.set(x),a=M,g(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(x){a=x,g(o,a)},render:p,addToRenderList:y,dispose:m}}function FE(i,e){let t=i.getParameter(i.MAX_VERTEX_ATTRIBS),n={},s=d(null),r=s,o=!1;function a(I,k,V,F,z){let Y=!1,G=u(I,F,V,k);r!==G&&(r=G,c(r.object)),Y=f(I,F,V,z),Y&&p(I,F,V,z),z!==null&&e.update(z,i.ELEMENT_ARRAY_BUFFER),(Y||o)&&(o=!1,_(I,k,V,F),z!==null&&i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,e.get(z).buffer))}function l(){return i.createVertexArray()}function c(I){return i.bindVertexArray(I)}function h(I){return i.deleteVertexArray(I)}function u(I,k,V,F){let z=F.wireframe===!0,Y=n[k.id];Y===void 0&&(Y={},n[k.id]=Y);let G=I.isInstancedMesh===!0?I.id:0,ce=Y[G];ce===void 0&&(ce={},Y[G]=ce);let J=ce[V.id];J===void 0&&(J={},ce[V.id]=J);let Q=J[z];return Q===void 0&&(Q=d(l()),J[z]=Q),Q}function d(I){let k=[],V=[],F=[];for(let z=0;z<t;z++)k[z]=0,V[z]=0,F[z]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:k,enabledAttributes:V,attributeDivisors:F,object:I,attributes:{},index:null}}function f(I,k,V,F){let z=r.attributes,Y=k.attributes,G=0,ce=V.getAttributes();for(let J in ce)if(ce[J].location>=0){let te=z[J],pe=Y[J];if(pe===void 0&&(J==="instanceMatrix"&&I.instanceMatrix&&(pe=I.instanceMatrix),J==="instanceColor"&&I.instanceColor&&(pe=I.instanceColor)),te===void 0||te.attribute!==pe||pe&&te.data!==pe.data)return!0;G++}return r.attributesNum!==G||r.index!==F}function p(I,k,V,F){let z={},Y=k.attributes,G=0,ce=V.getAttributes();for(let J in ce)if(ce[J].location>=0){let te=Y[J];te===void 0&&(J==="instanceMatrix"&&I.instanceMatrix&&(te=I.instanceMatrix),J==="instanceColor"&&I.instanceColor&&(te=I.instanceColor));let pe={};pe.attribute=te,te&&te.data&&(pe.data=te.data),z[J]=pe,G++}r.attributes=z,r.attributesNum=G,r.index=F}function y(){let I=r.newAttributes;for(let k=0,V=I.length;k<V;k++)I[k]=0}function g(I){m(I,0)}function m(I,k){let V=r.newAttributes,F=r.enabledAttributes,z=r.attributeDivisors;V[I]=1,F[I]===0&&(i.enableVertexAttribArray(I),F[I]=1),z[I]!==k&&(i.vertexAttribDivisor(I,k),z[I]=k)}function x(){let I=r.newAttributes,k=r.enabledAttributes;for(let V=0,F=k.length;V<F;V++)k[V]!==I[V]&&(i.disableVertexAttribArray(V),k[V]=0)}function M(I,k,V,F,z,Y,G){G===!0?i.vertexAttribIPointer(I,k,V,z,Y):i.vertexAttribPointer(I,k,V,F,z,Y)}function _(I,k,V,F){y();let z=F.attributes,Y=V.getAttributes(),G=k.defaultAttributeValues;for(let ce in Y){let J=Y[ce];if(J.location>=0){let Q=z[ce];if(Q===void 0&&(ce==="instanceMatrix"&&I.instanceMatrix&&(Q=I.instanceMatrix),ce==="instanceColor"&&I.instanceColor&&(Q=I.instanceColor)),Q!==void 0){let te=Q.normalized,pe=Q.itemSize,he=e.get(Q);if(he===void 0)continue;let ee=he.buffer,ye=he.type,ve=he.bytesPerElement,Le=ye===i.INT||ye===i.UNSIGNED_INT||Q.gpuType===yh;if(Q.isInterleavedBufferAttribute){let Ee=Q.data,Ve=Ee.isInterleavedBuffer===!0?Ee.stride:Ee.itemSize,at=Q.offset;if(Ee.isInstancedInterleavedBuffer||Ee.isInstancedBufferAttribute){for(let Je=0;Je<J.locationSize;Je++)m(J.location+Je,Ee.meshPerAttribute);I.isInstancedMesh!==!0&&F._maxInstanceCount===void 0&&(F._maxInstanceCount=Ee.meshPerAttribute*Ee.count)}else for(let Je=0;Je<J.locationSize;Je++)g(J.location+Je);i.bindBuffer(i.ARRAY_BUFFER,ee);for(let Je=0;Je<J.locationSize;Je++)M(J.location+Je,pe/J.locationSize,ye,te,Ve*ve,(at+pe/J.locationSize*Je)*ve,Le)}else{if(Q.isInstancedBufferAttribute){for(let Ee=0;Ee<J.locationSize;Ee++)m(J.location+Ee,Q.meshPerAttribute);I.isInstancedMesh!==!0&&F._maxInstanceCount===void 0&&(F._maxInstanceCount=Q.meshPerAttribute*Q.count)}else for(let Ee=0;Ee<J.locationSize;Ee++)g(J.location+Ee);i.bindBuffer(i.ARRAY_BUFFER,ee);for(let Ee=0;Ee<J.locationSize;Ee++)M(J.location+Ee,pe/J.locationSize,ye,te,pe*ve,pe/J.locationSize*Ee*ve,Le)}}else if(G!==void 0){let te=G[ce];if(te!==void 0)switch(te.length){case 2:i.vertexAttrib2fv(J.location,te);break;case 3:i.vertexAttrib3fv(J.location,te);break;case 4:i.vertexAttrib4fv(J.location,te);break;default:i.vertexAttrib1fv(J.location,te)}}}}x()}function C(){N();for(let I in n){let k=n[I];for(let V in k){let F=k[V];for(let z in F){let Y=F[z];for(let G in Y)h(Y[G].object),delete Y[G];delete F[z]}}delete n[I]}}function T(I){if(n[I.id]===void 0)return;let k=n[I.id];for(let V in k){let F=k[V];for(let z in F){let Y=F[z];for(let G in Y)h(Y[G].object),delete Y[G];delete F[z]}}delete n[I.id]}function v(I){for(let k in n){let V=n[k];for(let F in V){let z=V[F];if(z[I.id]===void 0)continue;let Y=z[I.id];for(let G in Y)h(Y[G].object),delete Y[G];delete z[I.id]}}}function E(I){for(let k in n){let V=n[k],F=I.isInstancedMesh===!0?I.id:0,z=V[F];if(z!==void 0){for(let Y in z){let G=z[Y];for(let ce in G)h(G[ce].object),delete G[ce];delete z[Y]}delete V[F],Object.keys(V).length===0&&delete n[k]}}}function N(){P(),o=!0,r!==s&&(r=s,c(r.object))}function P(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:N,resetDefaultState:P,dispose:C,releaseStatesOfGeometry:T,releaseStatesOfObject:E,releaseStatesOfProgram:v,initAttributes:y,enableAttribute:g,disableUnusedAttributes:x}}function UE(i,e,t){let n;function s(l){n=l}function r(l,c){i.drawArrays(n,l,c),t.update(c,n,1)}function o(l,c,h){h!==0&&(i.drawArraysInstanced(n,l,c,h),t.update(c,n,h))}function a(l,c,h){if(h===0)return;e.get("WEBGL_multi_draw").multiDrawArraysWEBGL(n,l,0,c,0,h);let d=0;for(let f=0;f<h;f++)d+=c[f];t.update(d,n,1)}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function OE(i,e,t,n){let s;function r(){if(s!==void 0)return s;if(e.has("EXT_texture_filter_anisotropic")===!0){let v=e.get("EXT_texture_filter_anisotropic");s=i.getParameter(v.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(v){return!(v!==Ti&&n.convert(v)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(v){let E=v===ji&&(e.has("EXT_color_buffer_half_float")||e.has("EXT_color_buffer_float"));return!(v!==yi&&v!==pi&&!E&&n.convert(v)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_TYPE))}function l(v){if(v==="highp"){if(i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.HIGH_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.HIGH_FLOAT).precision>0)return"highp";v="mediump"}return v==="mediump"&&i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.MEDIUM_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=t.precision!==void 0?t.precision:"highp",h=l(c);h!==c&&(it("WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);let u=t.reversedDepthBuffer===!0&&e.has("EXT_clip_control"),d=t.logarithmicDepthBuffer===!0&&u===!1;t.reversedDepthBuffer===!0&&u===!1&&it("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),t.logarithmicDepthBuffer===!0&&u===!0&&it("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let f=i.getParameter(i.MAX_TEXTURE_IMAGE_UNITS),p=i.getParameter(i.MAX_VERTEX_TEXTURE_IMAGE_UNITS),y=i.getParameter(i.MAX_TEXTURE_SIZE),g=i.getParameter(i.MAX_CUBE_MAP_TEXTURE_SIZE),m=i.getParameter(i.MAX_VERTEX_ATTRIBS),x=i.getParameter(i.MAX_VERTEX_UNIFORM_VECTORS),M=i.getParameter(i.MAX_VARYING_VECTORS),_=i.getParameter(i.MAX_FRAGMENT_UNIFORM_VECTORS),C=i.getParameter(i.MAX_SAMPLES),T=i.getParameter(i.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:d,reversedDepthBuffer:u,maxTextures:f,maxVertexTextures:p,maxTextureSize:y,maxCubemapSize:g,maxAttributes:m,maxVertexUniforms:x,maxVaryings:M,maxFragmentUniforms:_,maxSamples:C,samples:T}}function BE(i){let e=this,t=null,n=0,s=!1,r=!1,o=new si,a=new yt,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,d){let f=u.length!==0||d||n!==0||s;return s=d,n=u.length,f},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,d){t=h(u,d,0)},this.setState=function(u,d,f){let p=u.clippingPlanes,y=u.clipIntersection,g=u.clipShadows,m=i.get(u);if(!s||p===null||p.length===0||r&&!g)r?h(null):c();else{let x=r?0:n,M=x*4,_=m.clippingState||null;l.value=_,_=h(p,d,M,f);for(let C=0;C!==M;++C)_[C]=t[C];m.clippingState=_,this.numIntersection=y?this.numPlanes:0,this.numPlanes+=x}};function c(){l.value!==t&&(l.value=t,l.needsUpdate=n>0),e.numPlanes=n,e.numIntersection=0}function h(u,d,f,p){let y=u!==null?u.length:0,g=null;if(y!==0){if(g=l.value,p!==!0||g===null){let m=f+y*4,x=d.matrixWorldInverse;a.getNormalMatrix(x),(g===null||g.length<m)&&(g=new Float32Array(m));for(let M=0,_=f;M!==y;++M,_+=4)o.copy(u[M]).applyMatrix4(x,a),o.normal.toArray(g,_),g[_+3]=o.constant}l.value=g,l.needsUpdate=!0}return e.numPlanes=y,e.numIntersection=0,g}}var wl=class extends Ai{constructor(e=1,t={}){super(e,e,t),this.isWebGLCubeRenderTarget=!0;let n={width:e,height:e,depth:1},s=[n,n,n,n,n,n];this.texture=new Ba(s),this._setTextureOptions(t),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(e,t){this.texture.type=t.type,this.texture.colorSpace=t.colorSpace,this.texture.generateMipmaps=t.generateMipmaps,this.texture.minFilter=t.minFilter,this.texture.magFilter=t.magFilter;let n={uniforms:{tEquirect:{value:null}},vertexShader:`

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
			`},s=new pn(5,5,5),r=new ki({name:"CubemapFromEquirect",uniforms:Or(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:li,blending:Dr});r.uniforms.tEquirect.value=t;let o=new St(s,r),a=t.minFilter;return t.minFilter===Vs&&(t.minFilter=oi),new Fo(1,10,this).update(e,o),t.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(e,t=!0,n=!0,s=!0){let r=e.getRenderTarget();for(let o=0;o<6;o++)e.setRenderTarget(this,o),e.clear(t,n,s);e.setRenderTarget(r)}},A0=256,kE=3,HE=20,J0=256,K0=16,zE=3,VE=new S,GE=new et,nu=class i{constructor(e){this._renderer=e,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new Fo(1,10,null),this._boxMesh=new St(new pn(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(e,t=0,n=.1,s=100,r={}){let{size:o=256,position:a=VE}=r,l=this._renderer;this._setSize(o);let c=this._allocateTarget(),h=this._getSourceTarget(!0);t>0&&(h.texture.mipmapsAutoUpdate=!1);let u=l.autoClear,d=l.autoClearColor,f=l.autoClearDepth,p=l.autoClearStencil,y=e.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,y===null&&(e.background=l.getClearColor(GE));let g=new Fo(n,s,h);return g.position.copy(a),g.update(l,e),l.autoClear=u,l.autoClearColor=d,l.autoClearDepth=f,l.autoClearStencil=p,e.background=y,t>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(c,t)),this._applyPMREM(c),c}fromEquirectangular(e,t=null){return this._fromTexture(e,t)}fromCubemap(e,t=null){return this._fromTexture(e,t)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=P0(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=C0(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(e,t){return t>0?1-Math.sqrt(1-e/t):0}_setSize(e){this._cubeSize=Math.max(A0,Qf(e))}_fromTexture(e,t){e.mapping===Fr||e.mapping===ko?this._setSize(e.image.length===0?A0:e.image[0].width||e.image[0].image.width):this._setSize(e.image.width/4);let n=t||this._allocateTarget();return this._textureToCubemap(e),this._applyPMREM(n),n}_allocateTarget(){let e=this._cubeSize,t=R0(e,!1,!1),n=Math.log2(e)-kE;for(let s=0;s<=n;s++)t.texture.mipmaps.push({width:e>>s,height:e>>s});return t.texture.name="PMREM",t.texture.isPMREMTexture=!0,t}_getSourceTarget(e=!1){let t=this._cubeSize,n=this._sourceTarget;return(n===null||n.width!==t||e&&n.depthBuffer===!1)&&(n!==null&&n.dispose(),this._sourceTarget=R0(t,!0,e)),this._sourceTarget}_compileMaterial(e){this._boxMesh.material=e,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(e,t,n){let s=this._boxMesh,r=this._cubeCamera;s.material=n,r.renderTarget=e,r.activeMipmapLevel=t;let o=e.width>>t;e.viewport.set(0,0,o,o),r.update(this._renderer,s),e.viewport.set(0,0,e.width,e.height)}_textureToCubemap(e){let t;e.mapping===Fr||e.mapping===ko?(this._cubemapMaterial===null&&(this._cubemapMaterial=P0()),t=this._cubemapMaterial,t.uniforms.flipEnvMap.value=e.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=C0()),t=this._equirectMaterial),t.uniforms.envMap.value=e,this._renderCube(this._getSourceTarget(),0,t)}_applyPMREM(e){this._ggxMaterial===null&&(this._ggxMaterial=WE(),this._integrationMaterial=XE());let t=this._cubeSize,n=e.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(t/K0);for(let o=0;o<=n;o++){let a=i.lodToRoughness(o,n);if(o>n-zE)r.roughness.value=a,this._renderCube(e,o,this._integrationMaterial);else{let l=a>0?Math.log2(t)+.5*Math.log2(6/(J0*Math.pow(a,4)))+.5:0;s.roughness.value=a,s.lodBias.value=l,this._renderCube(e,o,this._ggxMaterial)}}}_blur(e,t){this._blurMaterial===null&&(this._blurMaterial=qE());let n=this._blurMaterial,s=n.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(t,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(e,0,n),s.envMap.value=e.texture,this._renderCube(r,0,n)}};function R0(i,e,t){return new wl(i,{minFilter:Vs,generateMipmaps:e,type:ji,colorSpace:Aa,depthBuffer:t})}function Tl(i,e,t){return new ki({name:i,uniforms:e,vertexShader:Et.cube_vert,fragmentShader:t,side:li,blending:Dr,depthTest:!1,depthWrite:!1})}function WE(){return Tl("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${J0}u

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
	`)}function XE(){return Tl("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:K0}},`

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
	`)}function qE(){return Tl("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${HE}
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
	`)}function C0(){return Tl("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

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
	`)}function P0(){return Tl("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function YE(i){let e=new WeakMap,t=new WeakMap,n=null;function s(d,f=!1){return d==null?null:f?o(d):r(d)}function r(d){if(d&&d.isTexture){let f=d.mapping;if(f===ph||f===mh)if(e.has(d)){let p=e.get(d).texture;return a(p,d.mapping)}else{let p=d.image;if(p&&p.height>0){let y=new wl(p.height);return y.fromEquirectangularTexture(i,d),e.set(d,y),d.addEventListener("dispose",c),a(y.texture,d.mapping)}else return null}}return d}function o(d){if(d&&d.isTexture&&d.isPMREMTexture!==!0){let f=d.mapping,p=f===ph||f===mh,y=f===Fr||f===ko;if(p||y){let g=t.get(d),m=g!==void 0?g.texture.pmremVersion:0;if(d.isRenderTargetTexture&&d.pmremVersion!==m)return n===null&&(n=new nu(i)),g=p?n.fromEquirectangular(d,g):n.fromCubemap(d,g),g.texture.pmremVersion=d.pmremVersion,t.set(d,g),g.texture;if(g!==void 0)return g.texture;{let x=d.image;return p&&x&&x.height>0||y&&x&&l(x)?(n===null&&(n=new nu(i)),g=p?n.fromEquirectangular(d):n.fromCubemap(d),g.texture.pmremVersion=d.pmremVersion,t.set(d,g),d.addEventListener("dispose",h),g.texture):null}}}return d}function a(d,f){return f===ph?d.mapping=Fr:f===mh&&(d.mapping=ko),d}function l(d){let f=0,p=6;for(let y=0;y<p;y++)d[y]!==void 0&&f++;return f===p}function c(d){let f=d.target;f.removeEventListener("dispose",c);let p=e.get(f);p!==void 0&&(e.delete(f),p.dispose())}function h(d){let f=d.target;f.removeEventListener("dispose",h);let p=t.get(f);p!==void 0&&(t.delete(f),p.dispose())}function u(){e=new WeakMap,t=new WeakMap,n!==null&&(n.dispose(),n=null)}return{get:s,dispose:u}}function $E(i){let e={};function t(n){if(e[n]!==void 0)return e[n];let s=i.getExtension(n);return e[n]=s,s}return{has:function(n){return t(n)!==null},init:function(){t("EXT_color_buffer_float"),t("WEBGL_clip_cull_distance"),t("OES_texture_float_linear"),t("EXT_color_buffer_half_float"),t("WEBGL_multisampled_render_to_texture"),t("WEBGL_render_shared_exponent")},get:function(n){let s=t(n);return s===null&&Ma("WebGLRenderer: "+n+" extension not supported."),s}}}function ZE(i,e,t,n){let s={},r=new WeakMap,o=new FinalizationRegistry(p=>delete s[p]);function a(p){l(p.target)}function l(p){p.index!==null&&e.remove(p.index);for(let g in p.attributes)e.remove(p.attributes[g]);p.removeEventListener("dispose",a),delete s[p.id],o.unregister(p);let y=r.get(p);y&&(e.remove(y),r.delete(p)),n.releaseStatesOfGeometry(p),p.isInstancedBufferGeometry===!0&&delete p._maxInstanceCount,t.memory.geometries--}function c(p,y){return s[y.id]!==void 0||(y.addEventListener("dispose",a),s[y.id]=new WeakRef(y),o.register(y,y.id,y),t.memory.geometries++),y}function h(p){let y=p.attributes;for(let g in y)e.update(y[g],i.ARRAY_BUFFER)}function u(p){let y=p.index,g=p.attributes.position,m=0;if(g===void 0)return;let x=y!==null?y.array.length:g.array.length/3-1,M=g.count>=65535?Na:Da,_=new M(Math.ceil(x/3)*6,1),C=_.array;if(y!==null){let v=y.array;m=y.version;for(let E=0,N=0;E<x;E+=3){let P=v[E+0],I=v[E+1],k=v[E+2];C[N++]=P,C[N++]=I,C[N++]=I,C[N++]=k,C[N++]=k,C[N++]=P}}else{m=g.version;for(let v=0,E=0;v<x;v+=3){let N=v+0,P=v+1,I=v+2;C[E++]=N,C[E++]=P,C[E++]=P,C[E++]=I,C[E++]=I,C[E++]=N}}_.version=m;let T=r.get(p);T&&e.remove(T),r.set(p,_)}function d(p){let y=r.get(p);if(y){let g=p.index;g!==null&&y.version<g.version&&u(p)}else u(p);return r.get(p)}function f(){for(let p in s){let y=s[p].deref();y!==void 0&&l(y)}}return{get:c,update:h,getWireframeAttribute:d,dispose:f}}function JE(i,e,t){let n;function s(u){n=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function l(u,d){i.drawElements(n,d,r,u*o),t.update(d,n,1)}function c(u,d,f){f!==0&&(i.drawElementsInstanced(n,d,r,u*o,f),t.update(d,n,f))}function h(u,d,f){if(f===0)return;e.get("WEBGL_multi_draw").multiDrawElementsWEBGL(n,d,0,r,u,0,f);let y=0;for(let g=0;g<f;g++)y+=d[g];t.update(y,n,1)}this.setMode=s,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=h}function KE(i){let e={geometries:0,textures:0},t={frame:0,calls:0,triangles:0,points:0,lines:0};function n(r,o,a){switch(t.calls++,o){case i.TRIANGLES:t.triangles+=a*(r/3);break;case i.LINES:t.lines+=a*(r/2);break;case i.LINE_STRIP:t.lines+=a*(r-1);break;case i.LINE_LOOP:t.lines+=a*r;break;case i.POINTS:t.points+=a*r;break;default:ht("WebGLInfo: Unknown draw mode:",o);break}}function s(){t.calls=0,t.triangles=0,t.points=0,t.lines=0}return{memory:e,render:t,programs:null,autoReset:!0,reset:s,update:n}}function jE(i,e,t){let n=new WeakMap,s=new Gt;function r(o,a,l){let c=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=h!==void 0?h.length:0,d=n.get(a);if(d===void 0||d.count!==u){let N=function(){v.dispose(),n.delete(a),a.removeEventListener("dispose",N)};d!==void 0&&d.texture.dispose();let f=a.morphAttributes.position!==void 0,p=a.morphAttributes.normal!==void 0,y=a.morphAttributes.color!==void 0,g=a.morphAttributes.position||[],m=a.morphAttributes.normal||[],x=a.morphAttributes.color||[],M=0;f===!0&&(M=1),p===!0&&(M=2),y===!0&&(M=3);let _=a.attributes.position.count*M,C=1;_>e.maxTextureSize&&(C=Math.ceil(_/e.maxTextureSize),_=e.maxTextureSize);let T=new Float32Array(_*C*4*u),v=new Ia(T,_,C,u);v.type=pi,v.needsUpdate=!0;let E=M*4;for(let P=0;P<u;P++){let I=g[P],k=m[P],V=x[P],F=_*C*4*P;for(let z=0;z<I.count;z++){let Y=z*E;f===!0&&(s.fromBufferAttribute(I,z),T[F+Y+0]=s.x,T[F+Y+1]=s.y,T[F+Y+2]=s.z,T[F+Y+3]=0),p===!0&&(s.fromBufferAttribute(k,z),T[F+Y+4]=s.x,T[F+Y+5]=s.y,T[F+Y+6]=s.z,T[F+Y+7]=0),y===!0&&(s.fromBufferAttribute(V,z),T[F+Y+8]=s.x,T[F+Y+9]=s.y,T[F+Y+10]=s.z,T[F+Y+11]=V.itemSize===4?s.w:1)}}d={count:u,texture:v,size:new ue(_,C)},n.set(a,d),a.addEventListener("dispose",N)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(i,"morphTexture",o.morphTexture,t);else{let f=0;for(let y=0;y<c.length;y++)f+=c[y];let p=a.morphTargetsRelative?1:1-f;l.getUniforms().setValue(i,"morphTargetBaseInfluence",p),l.getUniforms().setValue(i,"morphTargetInfluences",c)}l.getUniforms().setValue(i,"morphTargetsTexture",d.texture,t),l.getUniforms().setValue(i,"morphTargetsTextureSize",d.size)}return{update:r}}function QE(i,e,t,n,s){let r=new WeakMap;function o(c){let h=s.render.frame,u=c.geometry,d=e.get(c,u);if(r.get(d)!==h&&(e.update(d),r.set(d,h)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==h&&(t.update(c.instanceMatrix,i.ARRAY_BUFFER),c.instanceColor!==null&&t.update(c.instanceColor,i.ARRAY_BUFFER),r.set(c,h))),c.isSkinnedMesh){let f=c.skeleton;r.get(f)!==h&&(f.update(),r.set(f,h))}return d}function a(){r=new WeakMap}function l(c){let h=c.target;h.removeEventListener("dispose",l),n.releaseStatesOfObject(h),t.remove(h.instanceMatrix),h.instanceColor!==null&&t.remove(h.instanceColor)}return{update:o,dispose:a}}var ew={[Df]:"LINEAR_TONE_MAPPING",[Nf]:"REINHARD_TONE_MAPPING",[Ff]:"CINEON_TONE_MAPPING",[Uf]:"ACES_FILMIC_TONE_MAPPING",[Bf]:"AGX_TONE_MAPPING",[kf]:"NEUTRAL_TONE_MAPPING",[Of]:"CUSTOM_TONE_MAPPING"};function tw(i,e,t,n,s,r){let o=new Ai(e,t,{type:i,depthBuffer:s,stencilBuffer:r,samples:n?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,l=null,c=null,h=new wt;h.setAttribute("position",new ot([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new ot([0,2,0,0,2,0],2));let u=new Qc({uniforms:{tDiffuse:{value:null}},vertexShader:`
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
			}`,depthTest:!1,depthWrite:!1}),d=new St(h,u),f=new al(-1,1,1,-1,0,1),p=null,y=null,g=!1,m,x=null,M=[],_=!1;this.setSize=function(C,T){o.setSize(C,T),a!==null&&a.setSize(C,T),l!==null&&l.setSize(C,T);for(let v=0;v<M.length;v++){let E=M[v];E.setSize&&E.setSize(C,T)}},this.setEffects=function(C){M=C,_=M.length>0&&M[0].isRenderPass===!0;let T=o.width,v=o.height;M.length>0&&a===null&&(a=new Ai(T,v,{type:ji,depthBuffer:!1,stencilBuffer:!1}),l=new Ai(T,v,{type:ji,depthBuffer:!1,stencilBuffer:!1}));let E=s===!0&&M.some(N=>N.needsDepthTexture===!0);E!==(o.depthTexture!==null)&&(E===!0&&c===null&&(c=new Bs(T,v),r===!0&&(c.format=Gs,c.type=Ur)),o.dispose(),o.depthTexture=E?c:null,o.resolveDepthBuffer=E,o.storeMultisampledDepthBuffer=E);for(let N=0;N<M.length;N++){let P=M[N];P.setSize&&P.setSize(T,v),E&&P.needsDepthTexture===!0&&P.setDepthTexture&&P.setDepthTexture(c)}},this.begin=function(C,T){if(g||C.toneMapping===Hi&&M.length===0)return!1;if(x=T,T!==null){let v=T.width,E=T.height;(o.width!==v||o.height!==E)&&this.setSize(v,E)}return _===!1&&C.setRenderTarget(o),m=C.toneMapping,C.toneMapping=Hi,!0},this.hasRenderPass=function(){return _},this.end=function(C,T){C.toneMapping=m,g=!0;let v=o,E=a;for(let N=0;N<M.length;N++){let P=M[N];P.enabled!==!1&&(P.render(C,E,v,T),P.needsSwap!==!1&&(v=E,E=E===a?l:a))}if(p!==C.outputColorSpace||y!==C.toneMapping){p=C.outputColorSpace,y=C.toneMapping,u.defines={},Ct.getTransfer(p)===Vt&&(u.defines.SRGB_TRANSFER="");let N=ew[y];N&&(u.defines[N]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=v.texture,C.setRenderTarget(x),C.render(d,f),x=null,g=!1},this.isCompositing=function(){return g},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),l!==null&&l.dispose(),h.dispose(),u.dispose()}}var j0=new mi,Q0=new Bs(1,1),ey=new ka(1),ty=new Ia,ny=new Wc,iy=new Ba,I0=[],L0=[],D0=new Float32Array(16),N0=new Float32Array(9),F0=new Float32Array(4);function Vo(i,e,t){let n=i[0];if(n<=0||n>0)return i;let s=e*t,r=I0[s];if(r===void 0&&(r=new Float32Array(s),I0[s]=r),e!==0){n.toArray(r,0);for(let o=1,a=0;o!==e;++o)a+=t,i[o].toArray(r,a)}return r}function Cn(i,e){if(i.length!==e.length)return!1;for(let t=0,n=i.length;t<n;t++)if(i[t]!==e[t])return!1;return!0}function Pn(i,e){for(let t=0,n=e.length;t<n;t++)i[t]=e[t]}function su(i,e){let t=L0[e];t===void 0&&(t=new Int32Array(e),L0[e]=t);for(let n=0;n!==e;++n)t[n]=i.allocateTextureUnit();return t}function nw(i,e){let t=this.cache;t[0]!==e&&(i.uniform1f(this.addr,e),t[0]=e)}function iw(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2f(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(Cn(t,e))return;i.uniform2fv(this.addr,e),Pn(t,e)}}function sw(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3f(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else if(e.r!==void 0)(t[0]!==e.r||t[1]!==e.g||t[2]!==e.b)&&(i.uniform3f(this.addr,e.r,e.g,e.b),t[0]=e.r,t[1]=e.g,t[2]=e.b);else{if(Cn(t,e))return;i.uniform3fv(this.addr,e),Pn(t,e)}}function rw(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4f(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(Cn(t,e))return;i.uniform4fv(this.addr,e),Pn(t,e)}}function ow(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(Cn(t,e))return;i.uniformMatrix2fv(this.addr,!1,e),Pn(t,e)}else{if(Cn(t,n))return;F0.set(n),i.uniformMatrix2fv(this.addr,!1,F0),Pn(t,n)}}function aw(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(Cn(t,e))return;i.uniformMatrix3fv(this.addr,!1,e),Pn(t,e)}else{if(Cn(t,n))return;N0.set(n),i.uniformMatrix3fv(this.addr,!1,N0),Pn(t,n)}}function lw(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(Cn(t,e))return;i.uniformMatrix4fv(this.addr,!1,e),Pn(t,e)}else{if(Cn(t,n))return;D0.set(n),i.uniformMatrix4fv(this.addr,!1,D0),Pn(t,n)}}function cw(i,e){let t=this.cache;t[0]!==e&&(i.uniform1i(this.addr,e),t[0]=e)}function hw(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2i(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(Cn(t,e))return;i.uniform2iv(this.addr,e),Pn(t,e)}}function uw(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3i(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(Cn(t,e))return;i.uniform3iv(this.addr,e),Pn(t,e)}}function dw(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4i(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(Cn(t,e))return;i.uniform4iv(this.addr,e),Pn(t,e)}}function fw(i,e){let t=this.cache;t[0]!==e&&(i.uniform1ui(this.addr,e),t[0]=e)}function pw(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2ui(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(Cn(t,e))return;i.uniform2uiv(this.addr,e),Pn(t,e)}}function mw(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3ui(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(Cn(t,e))return;i.uniform3uiv(this.addr,e),Pn(t,e)}}function gw(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4ui(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(Cn(t,e))return;i.uniform4uiv(this.addr,e),Pn(t,e)}}function ru(i){return i.version===0&&(i.compareFunction=Zf,i.needsUpdate=!0),i}function yw(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_2D_SHADOW?r=ru(Q0):r=j0,t.setTexture2D(e||r,s)}function xw(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),t.setTexture3D(e||ny,s)}function vw(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_CUBE_SHADOW?r=ru(ey):r=iy,t.setTextureCube(e||r,s)}function _w(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),t.setTexture2DArray(e||ty,s)}function bw(i){switch(i){case 5126:return nw;case 35664:return iw;case 35665:return sw;case 35666:return rw;case 35674:return ow;case 35675:return aw;case 35676:return lw;case 5124:case 35670:return cw;case 35667:case 35671:return hw;case 35668:case 35672:return uw;case 35669:case 35673:return dw;case 5125:return fw;case 36294:return pw;case 36295:return mw;case 36296:return gw;case 35678:case 36198:case 36298:case 36306:case 35682:return yw;case 35679:case 36299:case 36307:return xw;case 35680:case 36300:case 36308:case 36293:return vw;case 36289:case 36303:case 36311:case 36292:return _w}}function Mw(i,e){i.uniform1fv(this.addr,e)}function Sw(i,e){let t=Vo(e,this.size,2);i.uniform2fv(this.addr,t)}function Ew(i,e){let t=Vo(e,this.size,3);i.uniform3fv(this.addr,t)}function ww(i,e){let t=Vo(e,this.size,4);i.uniform4fv(this.addr,t)}function Tw(i,e){let t=Vo(e,this.size,4);i.uniformMatrix2fv(this.addr,!1,t)}function Aw(i,e){let t=Vo(e,this.size,9);i.uniformMatrix3fv(this.addr,!1,t)}function Rw(i,e){let t=Vo(e,this.size,16);i.uniformMatrix4fv(this.addr,!1,t)}function Cw(i,e){i.uniform1iv(this.addr,e)}function Pw(i,e){i.uniform2iv(this.addr,e)}function Iw(i,e){i.uniform3iv(this.addr,e)}function Lw(i,e){i.uniform4iv(this.addr,e)}function Dw(i,e){i.uniform1uiv(this.addr,e)}function Nw(i,e){i.uniform2uiv(this.addr,e)}function Fw(i,e){i.uniform3uiv(this.addr,e)}function Uw(i,e){i.uniform4uiv(this.addr,e)}function Ow(i,e,t){let n=this.cache,s=e.length,r=su(t,s);Cn(n,r)||(i.uniform1iv(this.addr,r),Pn(n,r));let o;this.type===i.SAMPLER_2D_SHADOW?o=ru(Q0):o=j0;for(let a=0;a!==s;++a)t.setTexture2D(e[a]||o,r[a])}function Bw(i,e,t){let n=this.cache,s=e.length,r=su(t,s);Cn(n,r)||(i.uniform1iv(this.addr,r),Pn(n,r));for(let o=0;o!==s;++o)t.setTexture3D(e[o]||ny,r[o])}function kw(i,e,t){let n=this.cache,s=e.length,r=su(t,s);Cn(n,r)||(i.uniform1iv(this.addr,r),Pn(n,r));let o;this.type===i.SAMPLER_CUBE_SHADOW?o=ru(ey):o=iy;for(let a=0;a!==s;++a)t.setTextureCube(e[a]||o,r[a])}function Hw(i,e,t){let n=this.cache,s=e.length,r=su(t,s);Cn(n,r)||(i.uniform1iv(this.addr,r),Pn(n,r));for(let o=0;o!==s;++o)t.setTexture2DArray(e[o]||ty,r[o])}function zw(i){switch(i){case 5126:return Mw;case 35664:return Sw;case 35665:return Ew;case 35666:return ww;case 35674:return Tw;case 35675:return Aw;case 35676:return Rw;case 5124:case 35670:return Cw;case 35667:case 35671:return Pw;case 35668:case 35672:return Iw;case 35669:case 35673:return Lw;case 5125:return Dw;case 36294:return Nw;case 36295:return Fw;case 36296:return Uw;case 35678:case 36198:case 36298:case 36306:case 35682:return Ow;case 35679:case 36299:case 36307:return Bw;case 35680:case 36300:case 36308:case 36293:return kw;case 36289:case 36303:case 36311:case 36292:return Hw}}var cp=class{constructor(e,t,n){this.id=e,this.addr=n,this.cache=[],this.type=t.type,this.setValue=bw(t.type)}},hp=class{constructor(e,t,n){this.id=e,this.addr=n,this.cache=[],this.type=t.type,this.size=t.size,this.setValue=zw(t.type)}},up=class{constructor(e){this.id=e,this.seq=[],this.map={}}setValue(e,t,n){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(e,t[a.id],n)}}},ap=/(\w+)(\])?(\[|\.)?/g;function U0(i,e){i.seq.push(e),i.map[e.id]=e}function Vw(i,e,t){let n=i.name,s=n.length;for(ap.lastIndex=0;;){let r=ap.exec(n),o=ap.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===s){U0(t,c===void 0?new cp(a,i,e):new hp(a,i,e));break}else{let u=t.map[a];u===void 0&&(u=new up(a),U0(t,u)),t=u}}}var zo=class{constructor(e,t){this.seq=[],this.map={};let n=e.getProgramParameter(t,e.ACTIVE_UNIFORMS);for(let o=0;o<n;++o){let a=e.getActiveUniform(t,o),l=e.getUniformLocation(t,a.name);Vw(a,l,this)}let s=[],r=[];for(let o of this.seq)o.type===e.SAMPLER_2D_SHADOW||o.type===e.SAMPLER_CUBE_SHADOW||o.type===e.SAMPLER_2D_ARRAY_SHADOW?s.push(o):r.push(o);s.length>0&&(this.seq=s.concat(r))}setValue(e,t,n,s){let r=this.map[t];r!==void 0&&r.setValue(e,n,s)}setOptional(e,t,n){let s=t[n];s!==void 0&&this.setValue(e,n,s)}static upload(e,t,n,s){for(let r=0,o=t.length;r!==o;++r){let a=t[r],l=n[a.id];l.needsUpdate!==!1&&a.setValue(e,l.value,s)}}static seqWithValue(e,t){let n=[];for(let s=0,r=e.length;s!==r;++s){let o=e[s];o.id in t&&n.push(o)}return n}};function O0(i,e,t){let n=i.createShader(e);return i.shaderSource(n,t),i.compileShader(n),n}var Gw=37297,Ww=0;function Xw(i,e){let t=i.split(`
`),n=[],s=Math.max(e-6,0),r=Math.min(e+6,t.length);for(let o=s;o<r;o++){let a=o+1;n.push(`${a===e?">":" "} ${a}: ${t[o]}`)}return n.join(`
`)}var B0=new yt;function qw(i){Ct._getMatrix(B0,Ct.workingColorSpace,i);let e=`mat3( ${B0.elements.map(t=>t.toFixed(4))} )`;switch(Ct.getTransfer(i)){case Ra:return[e,"LinearTransferOETF"];case Vt:return[e,"sRGBTransferOETF"];default:return it("WebGLProgram: Unsupported color space: ",i),[e,"LinearTransferOETF"]}}function k0(i,e,t){let n=i.getShaderParameter(e,i.COMPILE_STATUS),r=(i.getShaderInfoLog(e)||"").trim();if(n&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return t.toUpperCase()+`

`+r+`

`+Xw(i.getShaderSource(e),a)}else return r}function Yw(i,e){let t=qw(e);return[`vec4 ${i}( vec4 value ) {`,`	return ${t[1]}( vec4( ${t[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var $w={[Df]:"Linear",[Nf]:"Reinhard",[Ff]:"Cineon",[Uf]:"ACESFilmic",[Bf]:"AgX",[kf]:"Neutral",[Of]:"Custom"};function Zw(i,e){let t=$w[e];return t===void 0?(it("WebGLProgram: Unsupported toneMapping:",e),"vec3 "+i+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+i+"( vec3 color ) { return "+t+"ToneMapping( color ); }"}var tu=new S;function Jw(){Ct.getLuminanceCoefficients(tu);let i=tu.x.toFixed(4),e=tu.y.toFixed(4),t=tu.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${i}, ${e}, ${t} );`,"	return dot( weights, rgb );","}"].join(`
`)}function Kw(i){return[i.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",i.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(El).join(`
`)}function jw(i){let e=[];for(let t in i){let n=i[t];n!==!1&&e.push("#define "+t+" "+n)}return e.join(`
`)}function Qw(i,e){let t={},n=i.getProgramParameter(e,i.ACTIVE_ATTRIBUTES);for(let s=0;s<n;s++){let r=i.getActiveAttrib(e,s),o=r.name,a=1;r.type===i.FLOAT_MAT2&&(a=2),r.type===i.FLOAT_MAT3&&(a=3),r.type===i.FLOAT_MAT4&&(a=4),t[o]={type:r.type,location:i.getAttribLocation(e,o),locationSize:a}}return t}function El(i){return i!==""}function H0(i,e){let t=e.numSpotLightShadows+e.numSpotLightMaps-e.numSpotLightShadowsWithMaps;return i.replace(/NUM_SUN_LIGHTS/g,e.numSunLights).replace(/NUM_DIR_LIGHTS/g,e.numDirLights).replace(/NUM_SPOT_LIGHTS/g,e.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,e.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,t).replace(/NUM_RECT_AREA_LIGHTS/g,e.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,e.numPointLights).replace(/NUM_HEMI_LIGHTS/g,e.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,e.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,e.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,e.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,e.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,e.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,e.numLightProbeGrids)}function z0(i,e){return i.replace(/NUM_CLIPPING_PLANES/g,e.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,e.numClippingPlanes-e.numClipIntersection)}var eT=/^[ \t]*#include +<([\w\d./]+)>/gm;function dp(i){return i.replace(eT,tT)}function tT(i,e){let t=Et[e];if(t===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+e+">");return dp(t)}var nT=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function V0(i){return i.replace(nT,iT)}function iT(i,e,t,n){let s="";for(let r=parseInt(e);r<parseInt(t);r++)s+=n.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function G0(i){let e=`precision ${i.precision} float;
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
#define LOW_PRECISION`),e}var sT={[mr]:"SHADOWMAP_TYPE_PCF",[Oo]:"SHADOWMAP_TYPE_VSM"};function rT(i){return sT[i.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var oT={[ko]:"ENVMAP_MODE_REFRACTION"};function aT(i){return i.envMap===!1?"ENVMAP_MODE_REFLECTION":oT[i.envMapMode]||"ENVMAP_MODE_REFLECTION"}var lT={[dl]:"ENVMAP_BLENDING_MULTIPLY",[r0]:"ENVMAP_BLENDING_MIX",[o0]:"ENVMAP_BLENDING_ADD"};function cT(i){return i.envMap===!1?"ENVMAP_BLENDING_NONE":lT[i.combine]||"ENVMAP_BLENDING_NONE"}function hT(i,e,t,n){let s=i.getContext(),r=t.defines,o=t.vertexShader,a=t.fragmentShader,l=rT(t),c=t.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=aT(t),u=cT(t),d=Kw(t),f=jw(r),p=s.createProgram(),y,g,m=t.glslVersion?"#version "+t.glslVersion+`
`:"";t.isRawShaderMaterial?(y=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f].filter(El).join(`
`),y.length>0&&(y+=`
`),g=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f].filter(El).join(`
`),g.length>0&&(g+=`
`)):(y=[G0(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f,t.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",t.batching?"#define USE_BATCHING":"",t.batchingColor?"#define USE_BATCHING_COLOR":"",t.instancing?"#define USE_INSTANCING":"",t.instancingColor?"#define USE_INSTANCING_COLOR":"",t.instancingMorph?"#define USE_INSTANCING_MORPH":"",t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.map?"#define USE_MAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+h:"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.displacementMap?"#define USE_DISPLACEMENTMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.mapUv?"#define MAP_UV "+t.mapUv:"",t.alphaMapUv?"#define ALPHAMAP_UV "+t.alphaMapUv:"",t.lightMapUv?"#define LIGHTMAP_UV "+t.lightMapUv:"",t.aoMapUv?"#define AOMAP_UV "+t.aoMapUv:"",t.emissiveMapUv?"#define EMISSIVEMAP_UV "+t.emissiveMapUv:"",t.bumpMapUv?"#define BUMPMAP_UV "+t.bumpMapUv:"",t.normalMapUv?"#define NORMALMAP_UV "+t.normalMapUv:"",t.displacementMapUv?"#define DISPLACEMENTMAP_UV "+t.displacementMapUv:"",t.metalnessMapUv?"#define METALNESSMAP_UV "+t.metalnessMapUv:"",t.roughnessMapUv?"#define ROUGHNESSMAP_UV "+t.roughnessMapUv:"",t.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+t.anisotropyMapUv:"",t.clearcoatMapUv?"#define CLEARCOATMAP_UV "+t.clearcoatMapUv:"",t.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+t.clearcoatNormalMapUv:"",t.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+t.clearcoatRoughnessMapUv:"",t.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+t.diffuseRoughnessMapUv:"",t.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+t.iridescenceMapUv:"",t.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+t.iridescenceThicknessMapUv:"",t.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+t.sheenColorMapUv:"",t.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+t.sheenRoughnessMapUv:"",t.specularMapUv?"#define SPECULARMAP_UV "+t.specularMapUv:"",t.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+t.specularColorMapUv:"",t.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+t.specularIntensityMapUv:"",t.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+t.transmissionMapUv:"",t.thicknessMapUv?"#define THICKNESSMAP_UV "+t.thicknessMapUv:"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexNormals?"#define HAS_NORMAL":"",t.vertexColors?"#define USE_COLOR":"",t.vertexAlphas?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.flatShading?"#define FLAT_SHADED":"",t.skinning?"#define USE_SKINNING":"",t.morphTargets?"#define USE_MORPHTARGETS":"",t.morphNormals&&t.flatShading===!1?"#define USE_MORPHNORMALS":"",t.morphColors?"#define USE_MORPHCOLORS":"",t.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+t.morphTextureStride:"",t.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+t.morphTargetsCount:"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.sizeAttenuation?"#define USE_SIZEATTENUATION":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(El).join(`
`),g=[G0(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f,t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",t.map?"#define USE_MAP":"",t.matcap?"#define USE_MATCAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+c:"",t.envMap?"#define "+h:"",t.envMap?"#define "+u:"",t.envMapPMREM?"#define ENVMAP_MAX_LOD "+t.envMapMaxLod+".0":"",t.envMapPMREM?"#define ENVMAP_SIZE "+t.envMapSize+".0":"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoat?"#define USE_CLEARCOAT":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.dispersion?"#define USE_DISPERSION":"",t.retroreflection?"#define USE_RETROREFLECTION":"",t.iridescence?"#define USE_IRIDESCENCE":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaTest?"#define USE_ALPHATEST":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.sheen?"#define USE_SHEEN":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexColors||t.instancingColor?"#define USE_COLOR":"",t.vertexAlphas||t.batchingColor?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.gradientMap?"#define USE_GRADIENTMAP":"",t.flatShading?"#define FLAT_SHADED":"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",t.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",t.toneMapping!==Hi?"#define TONE_MAPPING":"",t.toneMapping!==Hi?Et.tonemapping_pars_fragment:"",t.toneMapping!==Hi?Zw("toneMapping",t.toneMapping):"",t.dithering?"#define DITHERING":"",t.opaque?"#define OPAQUE":"",Et.colorspace_pars_fragment,Yw("linearToOutputTexel",t.outputColorSpace),Jw(),t.useDepthPacking?"#define DEPTH_PACKING "+t.depthPacking:"",`
`].filter(El).join(`
`)),o=dp(o),o=H0(o,t),o=z0(o,t),a=dp(a),a=H0(a,t),a=z0(a,t),o=V0(o),a=V0(a),t.isRawShaderMaterial!==!0&&(m=`#version 300 es
`,y=[d,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+y,g=["#define varying in",t.glslVersion===Kf?"":"layout(location = 0) out highp vec4 pc_fragColor;",t.glslVersion===Kf?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+g);let x=m+y+o,M=m+g+a,_=O0(s,s.VERTEX_SHADER,x),C=O0(s,s.FRAGMENT_SHADER,M);s.attachShader(p,_),s.attachShader(p,C),t.index0AttributeName!==void 0?s.bindAttribLocation(p,0,t.index0AttributeName):t.hasPositionAttribute===!0&&s.bindAttribLocation(p,0,"position"),s.linkProgram(p);function T(P){if(i.debug.checkShaderErrors){let I=s.getProgramInfoLog(p)||"",k=s.getShaderInfoLog(_)||"",V=s.getShaderInfoLog(C)||"",F=I.trim(),z=k.trim(),Y=V.trim(),G=!0,ce=!0;if(s.getProgramParameter(p,s.LINK_STATUS)===!1)if(G=!1,typeof i.debug.onShaderError=="function")i.debug.onShaderError(s,p,_,C);else{let J=k0(s,_,"vertex"),Q=k0(s,C,"fragment");ht("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(p,s.VALIDATE_STATUS)+`

Material Name: `+P.name+`
Material Type: `+P.type+`

Program Info Log: `+F+`
`+J+`
`+Q)}else F!==""?it("WebGLProgram: Program Info Log:",F):(z===""||Y==="")&&(ce=!1);ce&&(P.diagnostics={runnable:G,programLog:F,vertexShader:{log:z,prefix:y},fragmentShader:{log:Y,prefix:g}})}s.deleteShader(_),s.deleteShader(C),v=new zo(s,p),E=Qw(s,p)}let v;this.getUniforms=function(){return v===void 0&&T(this),v};let E;this.getAttributes=function(){return E===void 0&&T(this),E};let N=t.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return N===!1&&(N=s.getProgramParameter(p,Gw)),N},this.destroy=function(){n.releaseStatesOfProgram(this),s.deleteProgram(p),this.program=void 0},this.type=t.shaderType,this.name=t.shaderName,this.id=Ww++,this.cacheKey=e,this.usedTimes=1,this.program=p,this.vertexShader=_,this.fragmentShader=C,this}var uT=0,fp=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(e,t,n){let s=this._getShaderCacheForMaterial(e);return s.has(t)===!1&&(s.add(t),t.usedTimes++),s.has(n)===!1&&(s.add(n),n.usedTimes++),this}remove(e){let t=this.materialCache.get(e);for(let n of t)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(e),this}getVertexShaderStage(e){return this._getShaderStage(e.vertexShader)}getFragmentShaderStage(e){return this._getShaderStage(e.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(e){let t=this.materialCache,n=t.get(e);return n===void 0&&(n=new Set,t.set(e,n)),n}_getShaderStage(e){let t=this.shaderCache,n=t.get(e);return n===void 0&&(n=new pp(e),t.set(e,n)),n}},pp=class{constructor(e){this.id=uT++,this.code=e,this.usedTimes=0}};function dT(i){return i===yr||i===vl||i===_l}function fT(i,e,t,n,s,r){let o=new Co,a=new fp,l=new Set,c=[],h=new Map,u=n.logarithmicDepthBuffer,d={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function f(v){return l.add(v),v===0?"uv":`uv${v}`}function p(v,E,N,P,I,k){let V=P.fog,F=I.geometry,z=v.isMeshStandardMaterial||v.isMeshLambertMaterial||v.isMeshPhongMaterial?P.environment:null,Y=v.isMeshStandardMaterial||v.isMeshLambertMaterial&&!v.envMap||v.isMeshPhongMaterial&&!v.envMap,G=e.get(v.envMap||z,Y),ce=d[v.type],J=n.precision;v.precision!==null&&(J=n.getMaxPrecision(v.precision),J!==v.precision&&it("WebGLProgram.getParameters:",v.precision,"not supported, using",J,"instead."));let Q=F.morphAttributes.position||F.morphAttributes.normal||F.morphAttributes.color,te=Q!==void 0?Q.length:0,pe=0;F.morphAttributes.position!==void 0&&(pe=1),F.morphAttributes.normal!==void 0&&(pe=2),F.morphAttributes.color!==void 0&&(pe=3);let he,ee,ye,ve;if(ce){let Ne=hi[ce];he=Ne.vertexShader,ee=Ne.fragmentShader}else{he=v.vertexShader,ee=v.fragmentShader;let Ne=a.getVertexShaderStage(v),_t=a.getFragmentShaderStage(v);a.update(v,Ne,_t),ye=Ne.id,ve=_t.id}let Le=i.getRenderTarget(),Ee=i.state.buffers.depth.getReversed(),Ve=I.isInstancedMesh===!0,at=I.isBatchedMesh===!0,Je=!!v.map,lt=!!v.matcap,rt=!!G,oe=rt&&G.isPMREMTexture===!0,_e=!!v.aoMap,xe=!!v.lightMap,Be=!!v.bumpMap&&v.wireframe===!1,De=!!v.normalMap,st=!!v.displacementMap,ke=!!v.emissiveMap,vt=!!v.metalnessMap,gt=!!v.roughnessMap,bt=v.anisotropy>0,O=v.clearcoat>0,Me=v.diffuseRoughness>0,Xe=v.dispersion>0,ft=v.retroreflectivity>0,we=v.iridescence>0,zt=v.sheen>0,$e=v.transmission>0,tt=bt&&!!v.anisotropyMap,L=O&&!!v.clearcoatMap,w=O&&!!v.clearcoatNormalMap,q=O&&!!v.clearcoatRoughnessMap,fe=Me&&!!v.diffuseRoughnessMap,ae=we&&!!v.iridescenceMap,Se=we&&!!v.iridescenceThicknessMap,Te=zt&&!!v.sheenColorMap,ne=zt&&!!v.sheenRoughnessMap,se=!!v.specularMap,ge=!!v.specularColorMap,B=!!v.specularIntensityMap,re=$e&&!!v.transmissionMap,ie=$e&&!!v.thicknessMap,Ce=!!v.gradientMap,be=!!v.alphaMap,Re=v.alphaTest>0,Ke=!!v.alphaHash,ut=!!v.extensions,de=Hi;v.toneMapped&&(Le===null||Le.isXRRenderTarget===!0)&&(de=i.toneMapping);let qe=oe?G.isCompressedCubeTexture?G.image[0].mipmaps:G.mipmaps:null,dt={shaderID:ce,shaderType:v.type,shaderName:v.name,vertexShader:he,fragmentShader:ee,defines:v.defines,customVertexShaderID:ye,customFragmentShaderID:ve,isRawShaderMaterial:v.isRawShaderMaterial===!0,glslVersion:v.glslVersion,precision:J,batching:at,batchingColor:at&&I._colorsTexture!==null,instancing:Ve,instancingColor:Ve&&I.instanceColor!==null,instancingMorph:Ve&&I.morphTexture!==null,outputColorSpace:Le===null?i.outputColorSpace:Le.isXRRenderTarget===!0?Le.texture.colorSpace:Ct.workingColorSpace,alphaToCoverage:!!v.alphaToCoverage,map:Je,matcap:lt,envMap:rt,envMapMode:rt&&G.mapping,envMapPMREM:oe,envMapMaxLod:oe?qe.length-1:null,envMapSize:oe?qe[0].width:null,aoMap:_e,lightMap:xe,bumpMap:Be,normalMap:De,displacementMap:st,emissiveMap:ke,normalMapObjectSpace:De&&v.normalMapType===c0,normalMapTangentSpace:De&&v.normalMapType===bl,packedNormalMap:De&&v.normalMapType===bl&&dT(v.normalMap.format),metalnessMap:vt,roughnessMap:gt,anisotropy:bt,anisotropyMap:tt,clearcoat:O,clearcoatMap:L,clearcoatNormalMap:w,clearcoatRoughnessMap:q,diffuseRoughness:Me,diffuseRoughnessMap:fe,dispersion:Xe,retroreflection:ft,iridescence:we,iridescenceMap:ae,iridescenceThicknessMap:Se,sheen:zt,sheenColorMap:Te,sheenRoughnessMap:ne,specularMap:se,specularColorMap:ge,specularIntensityMap:B,transmission:$e,transmissionMap:re,thicknessMap:ie,gradientMap:Ce,opaque:v.transparent===!1&&v.blending===Bo&&v.alphaToCoverage===!1,alphaMap:be,alphaTest:Re,alphaHash:Ke,combine:v.combine,mapUv:Je&&f(v.map.channel),aoMapUv:_e&&f(v.aoMap.channel),lightMapUv:xe&&f(v.lightMap.channel),bumpMapUv:Be&&f(v.bumpMap.channel),normalMapUv:De&&f(v.normalMap.channel),displacementMapUv:st&&f(v.displacementMap.channel),emissiveMapUv:ke&&f(v.emissiveMap.channel),metalnessMapUv:vt&&f(v.metalnessMap.channel),roughnessMapUv:gt&&f(v.roughnessMap.channel),anisotropyMapUv:tt&&f(v.anisotropyMap.channel),clearcoatMapUv:L&&f(v.clearcoatMap.channel),clearcoatNormalMapUv:w&&f(v.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:q&&f(v.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:fe&&f(v.diffuseRoughnessMap.channel),iridescenceMapUv:ae&&f(v.iridescenceMap.channel),iridescenceThicknessMapUv:Se&&f(v.iridescenceThicknessMap.channel),sheenColorMapUv:Te&&f(v.sheenColorMap.channel),sheenRoughnessMapUv:ne&&f(v.sheenRoughnessMap.channel),specularMapUv:se&&f(v.specularMap.channel),specularColorMapUv:ge&&f(v.specularColorMap.channel),specularIntensityMapUv:B&&f(v.specularIntensityMap.channel),transmissionMapUv:re&&f(v.transmissionMap.channel),thicknessMapUv:ie&&f(v.thicknessMap.channel),alphaMapUv:be&&f(v.alphaMap.channel),vertexTangents:!!F.attributes.tangent&&(De||bt),vertexNormals:!!F.attributes.normal,vertexColors:v.vertexColors,vertexAlphas:v.vertexColors===!0&&!!F.attributes.color&&F.attributes.color.itemSize===4,pointsUvs:I.isPoints===!0&&!!F.attributes.uv&&(Je||be),fog:!!V,useFog:v.fog===!0,fogExp2:!!V&&V.isFogExp2,flatShading:v.wireframe===!1&&(v.flatShading===!0||F.attributes.normal===void 0&&De===!1&&(v.isMeshLambertMaterial||v.isMeshPhongMaterial||v.isMeshStandardMaterial||v.isMeshPhysicalMaterial)),sizeAttenuation:v.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:Ee,skinning:I.isSkinnedMesh===!0,hasPositionAttribute:F.attributes.position!==void 0,morphTargets:F.morphAttributes.position!==void 0,morphNormals:F.morphAttributes.normal!==void 0,morphColors:F.morphAttributes.color!==void 0,morphTargetsCount:te,morphTextureStride:pe,numSunLights:E.sun.length,numDirLights:E.directional.length,numPointLights:E.point.length,numSpotLights:E.spot.length,numSpotLightMaps:E.spotLightMap.length,numRectAreaLights:E.rectArea.length,numHemiLights:E.hemi.length,numSunLightShadows:E.sunShadowMap.length,numDirLightShadows:E.directionalShadowMap.length,numPointLightShadows:E.pointShadowMap.length,numSpotLightShadows:E.spotShadowMap.length,numSpotLightShadowsWithMaps:E.numSpotLightShadowsWithMaps,numLightProbes:E.numLightProbes,numLightProbeGrids:k.filter(Ne=>Ne.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:v.dithering,shadowMapEnabled:i.shadowMap.enabled&&N.length>0,shadowMapType:i.shadowMap.type,toneMapping:de,decodeVideoTexture:Je&&v.map.isVideoTexture===!0&&Ct.getTransfer(v.map.colorSpace)===Vt,decodeVideoTextureEmissive:ke&&v.emissiveMap.isVideoTexture===!0&&Ct.getTransfer(v.emissiveMap.colorSpace)===Vt,premultipliedAlpha:v.premultipliedAlpha,doubleSided:v.side===Sn,flipSided:v.side===li,useDepthPacking:v.depthPacking>=0,depthPacking:v.depthPacking||0,index0AttributeName:v.index0AttributeName,extensionClipCullDistance:ut&&v.extensions.clipCullDistance===!0&&t.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(ut&&v.extensions.multiDraw===!0||at)&&t.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:t.has("KHR_parallel_shader_compile"),customProgramCacheKey:v.customProgramCacheKey()};return dt.vertexUv1s=l.has(1),dt.vertexUv2s=l.has(2),dt.vertexUv3s=l.has(3),l.clear(),dt}function y(v){let E=[];if(v.shaderID?E.push(v.shaderID):(E.push(v.customVertexShaderID),E.push(v.customFragmentShaderID)),v.defines!==void 0)for(let N in v.defines)E.push(N),E.push(v.defines[N]);return v.isRawShaderMaterial===!1&&(g(E,v),m(E,v),E.push(i.outputColorSpace)),E.push(v.customProgramCacheKey),E.join()}function g(v,E){v.push(E.precision),v.push(E.outputColorSpace),v.push(E.envMapMode),v.push(E.envMapPMREM),v.push(E.envMapMaxLod),v.push(E.envMapSize),v.push(E.mapUv),v.push(E.alphaMapUv),v.push(E.lightMapUv),v.push(E.aoMapUv),v.push(E.bumpMapUv),v.push(E.normalMapUv),v.push(E.displacementMapUv),v.push(E.emissiveMapUv),v.push(E.metalnessMapUv),v.push(E.roughnessMapUv),v.push(E.anisotropyMapUv),v.push(E.clearcoatMapUv),v.push(E.clearcoatNormalMapUv),v.push(E.clearcoatRoughnessMapUv),v.push(E.diffuseRoughnessMapUv),v.push(E.iridescenceMapUv),v.push(E.iridescenceThicknessMapUv),v.push(E.sheenColorMapUv),v.push(E.sheenRoughnessMapUv),v.push(E.specularMapUv),v.push(E.specularColorMapUv),v.push(E.specularIntensityMapUv),v.push(E.transmissionMapUv),v.push(E.thicknessMapUv),v.push(E.combine),v.push(E.fogExp2),v.push(E.sizeAttenuation),v.push(E.morphTargetsCount),v.push(E.numSunLights),v.push(E.numDirLights),v.push(E.numPointLights),v.push(E.numSpotLights),v.push(E.numSpotLightMaps),v.push(E.numHemiLights),v.push(E.numRectAreaLights),v.push(E.numSunLightShadows),v.push(E.numDirLightShadows),v.push(E.numPointLightShadows),v.push(E.numSpotLightShadows),v.push(E.numSpotLightShadowsWithMaps),v.push(E.numLightProbes),v.push(E.numLightProbeGrids),v.push(E.shadowMapType),v.push(E.toneMapping),v.push(E.numClippingPlanes),v.push(E.numClipIntersection),v.push(E.depthPacking)}function m(v,E){o.disableAll(),E.instancing&&o.enable(0),E.instancingColor&&o.enable(1),E.instancingMorph&&o.enable(2),E.matcap&&o.enable(3),E.envMap&&o.enable(4),E.normalMapObjectSpace&&o.enable(5),E.normalMapTangentSpace&&o.enable(6),E.clearcoat&&o.enable(7),E.iridescence&&o.enable(8),E.alphaTest&&o.enable(9),E.vertexColors&&o.enable(10),E.vertexAlphas&&o.enable(11),E.vertexUv1s&&o.enable(12),E.vertexUv2s&&o.enable(13),E.vertexUv3s&&o.enable(14),E.vertexTangents&&o.enable(15),E.anisotropy&&o.enable(16),E.alphaHash&&o.enable(17),E.batching&&o.enable(18),E.dispersion&&o.enable(19),E.retroreflection&&o.enable(24),E.diffuseRoughness&&o.enable(25),E.batchingColor&&o.enable(20),E.gradientMap&&o.enable(21),E.packedNormalMap&&o.enable(22),E.vertexNormals&&o.enable(23),v.push(o.mask),o.disableAll(),E.fog&&o.enable(0),E.useFog&&o.enable(1),E.flatShading&&o.enable(2),E.logarithmicDepthBuffer&&o.enable(3),E.reversedDepthBuffer&&o.enable(4),E.skinning&&o.enable(5),E.morphTargets&&o.enable(6),E.morphNormals&&o.enable(7),E.morphColors&&o.enable(8),E.premultipliedAlpha&&o.enable(9),E.shadowMapEnabled&&o.enable(10),E.doubleSided&&o.enable(11),E.flipSided&&o.enable(12),E.useDepthPacking&&o.enable(13),E.dithering&&o.enable(14),E.transmission&&o.enable(15),E.sheen&&o.enable(16),E.opaque&&o.enable(17),E.pointsUvs&&o.enable(18),E.decodeVideoTexture&&o.enable(19),E.decodeVideoTextureEmissive&&o.enable(20),E.alphaToCoverage&&o.enable(21),E.numLightProbeGrids>0&&o.enable(22),E.hasPositionAttribute&&o.enable(23),v.push(o.mask)}function x(v){let E=d[v.type],N;if(E){let P=hi[E];N=Ml.clone(P.uniforms)}else N=v.uniforms;return N}function M(v,E){let N=h.get(E);return N!==void 0?++N.usedTimes:(N=new hT(i,E,v,s),c.push(N),h.set(E,N)),N}function _(v){if(--v.usedTimes===0){let E=c.indexOf(v);c[E]=c[c.length-1],c.pop(),h.delete(v.cacheKey),v.destroy()}}function C(v){a.remove(v)}function T(){a.dispose()}return{getParameters:p,getProgramCacheKey:y,getUniforms:x,acquireProgram:M,releaseProgram:_,releaseShaderCache:C,programs:c,dispose:T}}function pT(){let i=new WeakMap;function e(o){return i.has(o)}function t(o){let a=i.get(o);return a===void 0&&(a={},i.set(o,a)),a}function n(o){i.delete(o)}function s(o,a,l){i.get(o)[a]=l}function r(){i=new WeakMap}return{has:e,get:t,remove:n,update:s,dispose:r}}function mT(i,e){return i.groupOrder!==e.groupOrder?i.groupOrder-e.groupOrder:i.renderOrder!==e.renderOrder?i.renderOrder-e.renderOrder:i.material.id!==e.material.id?i.material.id-e.material.id:i.materialVariant!==e.materialVariant?i.materialVariant-e.materialVariant:i.z!==e.z?i.z-e.z:i.id-e.id}function W0(i,e){return i.groupOrder!==e.groupOrder?i.groupOrder-e.groupOrder:i.renderOrder!==e.renderOrder?i.renderOrder-e.renderOrder:i.z!==e.z?e.z-i.z:i.id-e.id}function X0(){let i=[],e=0,t=[],n=[],s=[];function r(){e=0,t.length=0,n.length=0,s.length=0}function o(d){let f=0;return d.isInstancedMesh&&(f+=2),d.isSkinnedMesh&&(f+=1),f}function a(d,f,p,y,g,m){let x=i[e];return x===void 0?(x={id:d.id,object:d,geometry:f,material:p,materialVariant:o(d),groupOrder:y,renderOrder:d.renderOrder,z:g,group:m},i[e]=x):(x.id=d.id,x.object=d,x.geometry=f,x.material=p,x.materialVariant=o(d),x.groupOrder=y,x.renderOrder=d.renderOrder,x.z=g,x.group=m),e++,x}function l(d,f,p,y,g,m,x){x.reversedDepth===!0&&(g=-g);let M=a(d,f,p,y,g,m);p.transmission>0?n.push(M):p.transparent===!0?s.push(M):t.push(M)}function c(d,f,p,y,g,m){let x=a(d,f,p,y,g,m);p.transmission>0?n.unshift(x):p.transparent===!0?s.unshift(x):t.unshift(x)}function h(d,f){t.length>1&&t.sort(d||mT),n.length>1&&n.sort(f||W0),s.length>1&&s.sort(f||W0)}function u(){for(let d=e,f=i.length;d<f;d++){let p=i[d];if(p.id===null)break;p.id=null,p.object=null,p.geometry=null,p.material=null,p.group=null}}return{opaque:t,transmissive:n,transparent:s,init:r,push:l,unshift:c,finish:u,sort:h}}function gT(){let i=new WeakMap;function e(n,s){let r=i.get(n),o;return r===void 0?(o=new X0,i.set(n,[o])):s>=r.length?(o=new X0,r.push(o)):o=r[s],o}function t(){i=new WeakMap}return{get:e,dispose:t}}function yT(){let i={};return{get:function(e){if(i[e.id]!==void 0)return i[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={direction:new S,color:new et};break;case"SpotLight":t={position:new S,direction:new S,color:new et,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":t={position:new S,color:new et,distance:0,decay:0};break;case"HemisphereLight":t={direction:new S,skyColor:new et,groundColor:new et};break;case"RectAreaLight":t={color:new et,position:new S,halfWidth:new S,halfHeight:new S};break}return i[e.id]=t,t}}}function xT(){let i={};return{get:function(e){if(i[e.id]!==void 0)return i[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new ue};break;case"SpotLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new ue};break;case"PointLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new ue,shadowCameraNear:1,shadowCameraFar:1e3};break}return i[e.id]=t,t}}}var vT=0;function _T(i,e){return(e.castShadow?2:0)-(i.castShadow?2:0)+(e.map?1:0)-(i.map?1:0)}function bT(i){let e=new yT,t=xT(),n={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)n.probe.push(new S);let s=new S,r=new Qe,o=new Qe;function a(c){let h=0,u=0,d=0;for(let k=0;k<9;k++)n.probe[k].set(0,0,0);let f=0,p=0,y=0,g=0,m=0,x=0,M=0,_=0,C=0,T=0,v=0,E=0,N=0,P=0;c.sort(_T);for(let k=0,V=c.length;k<V;k++){let F=c[k],z=F.color,Y=F.intensity,G=F.distance,ce=null;if(F.shadow&&F.shadow.map&&(F.shadow.map.texture.format===yr?ce=F.shadow.map.texture:ce=F.shadow.map.depthTexture||F.shadow.map.texture),F.isAmbientLight)h+=z.r*Y,u+=z.g*Y,d+=z.b*Y;else if(F.isLightProbe){for(let J=0;J<9;J++)n.probe[J].addScaledVector(F.sh.coefficients[J],Y);P++}else if(F.isSunLight){let J=e.get(F);if(J.color.copy(F.color).multiplyScalar(F.intensity),F.castShadow){let Q=F.shadow,te=t.get(F);te.shadowIntensity=Q.intensity,te.shadowBias=Q.bias,te.shadowNormalBias=Q.normalBias,te.shadowRadius=Q.radius,te.shadowMapSize.copy(Q.mapSize).multiply(Q.getFrameExtents()),n.sunShadow[p]=te,n.sunShadowMap[p]=ce;let pe=Q.getViewportCount();for(let he=0;he<pe;he++)n.sunShadowMatrix[y+he]=Q.getMatrix(he),n.sunShadowCascade[y+he]=Q._cascadeData[he];y+=pe,p++}n.sun[f]=J,f++}else if(F.isDirectionalLight){let J=e.get(F);if(J.color.copy(F.color).multiplyScalar(F.intensity),F.castShadow){let Q=F.shadow,te=t.get(F);te.shadowIntensity=Q.intensity,te.shadowBias=Q.bias,te.shadowNormalBias=Q.normalBias,te.shadowRadius=Q.radius,te.shadowMapSize=Q.mapSize,n.directionalShadow[g]=te,n.directionalShadowMap[g]=ce,n.directionalShadowMatrix[g]=F.shadow.matrix,C++}n.directional[g]=J,g++}else if(F.isSpotLight){let J=e.get(F);J.position.setFromMatrixPosition(F.matrixWorld),J.color.copy(z).multiplyScalar(Y),J.distance=G,J.coneCos=Math.cos(F.angle),J.penumbraCos=Math.cos(F.angle*(1-F.penumbra)),J.decay=F.decay,n.spot[x]=J;let Q=F.shadow;if(F.map&&(n.spotLightMap[E]=F.map,E++,Q.updateMatrices(F),F.castShadow&&N++),n.spotLightMatrix[x]=Q.matrix,F.castShadow){let te=t.get(F);te.shadowIntensity=Q.intensity,te.shadowBias=Q.bias,te.shadowNormalBias=Q.normalBias,te.shadowRadius=Q.radius,te.shadowMapSize=Q.mapSize,n.spotShadow[x]=te,n.spotShadowMap[x]=ce,v++}x++}else if(F.isRectAreaLight){let J=e.get(F);J.color.copy(z).multiplyScalar(Y),J.halfWidth.set(F.width*.5,0,0),J.halfHeight.set(0,F.height*.5,0),n.rectArea[M]=J,M++}else if(F.isPointLight){let J=e.get(F);if(J.color.copy(F.color).multiplyScalar(F.intensity),J.distance=F.distance,J.decay=F.decay,F.castShadow){let Q=F.shadow,te=t.get(F);te.shadowIntensity=Q.intensity,te.shadowBias=Q.bias,te.shadowNormalBias=Q.normalBias,te.shadowRadius=Q.radius,te.shadowMapSize=Q.mapSize,te.shadowCameraNear=Q.camera.near,te.shadowCameraFar=Q.camera.far,n.pointShadow[m]=te,n.pointShadowMap[m]=ce,n.pointShadowMatrix[m]=F.shadow.matrix,T++}n.point[m]=J,m++}else if(F.isHemisphereLight){let J=e.get(F);J.skyColor.copy(F.color).multiplyScalar(Y),J.groundColor.copy(F.groundColor).multiplyScalar(Y),n.hemi[_]=J,_++}}M>0&&(i.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=Fe.LTC_FLOAT_1,n.rectAreaLTC2=Fe.LTC_FLOAT_2):(n.rectAreaLTC1=Fe.LTC_HALF_1,n.rectAreaLTC2=Fe.LTC_HALF_2)),n.ambient[0]=h,n.ambient[1]=u,n.ambient[2]=d;let I=n.hash;(I.sunLength!==f||I.directionalLength!==g||I.pointLength!==m||I.spotLength!==x||I.rectAreaLength!==M||I.hemiLength!==_||I.numSunShadows!==p||I.numDirectionalShadows!==C||I.numPointShadows!==T||I.numSpotShadows!==v||I.numSpotMaps!==E||I.numLightProbes!==P)&&(n.sun.length=f,n.directional.length=g,n.spot.length=x,n.rectArea.length=M,n.point.length=m,n.hemi.length=_,n.sunShadow.length=p,n.sunShadowMap.length=p,n.sunShadowMatrix.length=y,n.sunShadowCascade.length=y,n.directionalShadow.length=C,n.directionalShadowMap.length=C,n.directionalShadowMatrix.length=C,n.pointShadow.length=T,n.pointShadowMap.length=T,n.pointShadowMatrix.length=T,n.spotShadow.length=v,n.spotShadowMap.length=v,n.spotLightMatrix.length=v+E-N,n.spotLightMap.length=E,n.numSpotLightShadowsWithMaps=N,n.numLightProbes=P,I.sunLength=f,I.directionalLength=g,I.pointLength=m,I.spotLength=x,I.rectAreaLength=M,I.hemiLength=_,I.numSunShadows=p,I.numDirectionalShadows=C,I.numPointShadows=T,I.numSpotShadows=v,I.numSpotMaps=E,I.numLightProbes=P,n.version=vT++)}function l(c,h){let u=0,d=0,f=0,p=0,y=0,g=0,m=h.matrixWorldInverse;for(let x=0,M=c.length;x<M;x++){let _=c[x];if(_.isSunLight){let C=n.sun[u];C.direction.setFromMatrixPosition(_.matrixWorld),C.direction.transformDirection(m),u++}else if(_.isDirectionalLight){let C=n.directional[d];C.direction.setFromMatrixPosition(_.matrixWorld),s.setFromMatrixPosition(_.target.matrixWorld),C.direction.sub(s),C.direction.transformDirection(m),d++}else if(_.isSpotLight){let C=n.spot[p];C.position.setFromMatrixPosition(_.matrixWorld),C.position.applyMatrix4(m),C.direction.setFromMatrixPosition(_.matrixWorld),s.setFromMatrixPosition(_.target.matrixWorld),C.direction.sub(s),C.direction.transformDirection(m),p++}else if(_.isRectAreaLight){let C=n.rectArea[y];C.position.setFromMatrixPosition(_.matrixWorld),C.position.applyMatrix4(m),o.identity(),r.copy(_.matrixWorld),r.premultiply(m),o.extractRotation(r),C.halfWidth.set(_.width*.5,0,0),C.halfHeight.set(0,_.height*.5,0),C.halfWidth.applyMatrix4(o),C.halfHeight.applyMatrix4(o),y++}else if(_.isPointLight){let C=n.point[f];C.position.setFromMatrixPosition(_.matrixWorld),C.position.applyMatrix4(m),f++}else if(_.isHemisphereLight){let C=n.hemi[g];C.direction.setFromMatrixPosition(_.matrixWorld),C.direction.transformDirection(m),g++}}}return{setup:a,setupView:l,state:n}}function q0(i){let e=new bT(i),t=[],n=[],s=[];function r(u){h.camera=u,t.length=0,n.length=0,s.length=0}function o(u){u.isLightProbeGrid?s.push(u):t.push(u)}function a(u){n.push(u)}function l(){e.setup(t),s.sort((u,d)=>u.priority-d.priority||u.id-d.id)}function c(u){e.setupView(t,u)}let h={lightsArray:t,shadowsArray:n,lightProbeGridArray:s,camera:null,lights:e,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:l,setupLightsView:c,pushLight:o,pushShadow:a}}function MT(i){let e=new WeakMap;function t(s,r=0){let o=e.get(s),a;return o===void 0?(a=new q0(i),e.set(s,[a])):r>=o.length?(a=new q0(i),o.push(a)):a=o[r],a}function n(){e=new WeakMap}return{get:t,dispose:n}}var ST=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,ET=`uniform sampler2D shadow_pass;
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
}`,wT=[new S(1,0,0),new S(-1,0,0),new S(0,1,0),new S(0,-1,0),new S(0,0,1),new S(0,0,-1)],TT=[new S(0,-1,0),new S(0,-1,0),new S(0,0,1),new S(0,0,-1),new S(0,-1,0),new S(0,-1,0)],Y0=new Qe,Sl=new S,lp=new S;function AT(i,e,t){let n=new Us,s=new ue,r=new ue,o=new Gt,a=new eh,l=new th,c={},h=t.maxTextureSize,u={[gr]:li,[li]:gr,[Sn]:Sn},d=new ki({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new ue},radius:{value:4}},vertexShader:ST,fragmentShader:ET}),f=d.clone();f.defines.HORIZONTAL_PASS=1;let p=new wt;p.setAttribute("position",new Bt(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let y=new St(p,d),g=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=mr;let m=this.type;this.render=function(T,v,E){if(g.enabled===!1||g.autoUpdate===!1&&g.needsUpdate===!1||T.length===0)return;this.type===Hg&&(it("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=mr);let N=i.getRenderTarget(),P=i.getActiveCubeFace(),I=i.getActiveMipmapLevel(),k=i.state;k.setBlending(Dr),k.buffers.depth.getReversed()===!0?k.buffers.color.setClear(0,0,0,0):k.buffers.color.setClear(1,1,1,1),k.buffers.depth.setTest(!0),k.setScissorTest(!1);let V=m!==this.type;V&&v.traverse(function(F){F.material&&(Array.isArray(F.material)?F.material.forEach(z=>z.needsUpdate=!0):F.material.needsUpdate=!0)});for(let F=0,z=T.length;F<z;F++){let Y=T[F],G=Y.shadow;if(G===void 0){it("WebGLShadowMap:",Y,"has no shadow.");continue}if(G.autoUpdate===!1&&G.needsUpdate===!1)continue;s.copy(G.mapSize);let ce=G.getFrameExtents();s.multiply(ce),r.copy(G.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/ce.x),s.x=r.x*ce.x,G.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/ce.y),s.y=r.y*ce.y,G.mapSize.y=r.y));let J=i.state.buffers.depth.getReversed();if(G.camera._reversedDepth=J,G.map===null||V===!0){if(G.map!==null&&(G.map.depthTexture!==null&&(G.map.depthTexture.dispose(),G.map.depthTexture=null),G.map.dispose()),this.type===Oo){if(Y.isPointLight){it("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}G.map=new Ai(s.x,s.y,{format:yr,type:ji,minFilter:oi,magFilter:oi,generateMipmaps:!1}),G.map.texture.name=Y.name+".shadowMap",G.map.depthTexture=new Bs(s.x,s.y,pi),G.map.depthTexture.name=Y.name+".shadowMapDepth",G.map.depthTexture.format=Fs,G.map.depthTexture.compareFunction=null,G.map.depthTexture.minFilter=kn,G.map.depthTexture.magFilter=kn}else Y.isPointLight?(G.map=new wl(s.x),G.map.depthTexture=new ka(s.x,zi)):(G.map=new Ai(s.x,s.y),G.map.depthTexture=new Bs(s.x,s.y,zi)),G.map.depthTexture.name=Y.name+".shadowMap",G.map.depthTexture.format=Fs,this.type===mr?(G.map.depthTexture.compareFunction=J?$f:Yf,G.map.depthTexture.minFilter=oi,G.map.depthTexture.magFilter=oi):(G.map.depthTexture.compareFunction=null,G.map.depthTexture.minFilter=kn,G.map.depthTexture.magFilter=kn);G.camera.updateProjectionMatrix()}G.map.isWebGLCubeRenderTarget!==!0&&(G.map.width!==s.x||G.map.height!==s.y)&&G.map.setSize(s.x,s.y);let Q=G.map.isWebGLCubeRenderTarget?6:G.getViewportCount();Y.isPointLight!==!0&&G.updateMatrices(Y,E);let te=(G.camera.layers.mask&4294967294)!==0?G.camera.layers:E.layers;for(let pe=0;pe<Q;pe++){let he=G.getCamera(pe);if(Y.isPointLight){let ee=G.camera,ye=G.matrix,ve=Y.distance||ee.far;ve!==ee.far&&(ee.far=ve,ee.updateProjectionMatrix()),Sl.setFromMatrixPosition(Y.matrixWorld),ee.position.copy(Sl),lp.copy(ee.position),lp.add(wT[pe]),ee.up.copy(TT[pe]),ee.lookAt(lp),ee.updateMatrixWorld(),ye.makeTranslation(-Sl.x,-Sl.y,-Sl.z),Y0.multiplyMatrices(ee.projectionMatrix,ee.matrixWorldInverse),G._frustum.setFromProjectionMatrix(Y0,ee.coordinateSystem,ee.reversedDepth)}if(G.map.isWebGLCubeRenderTarget)i.setRenderTarget(G.map,pe),i.clear();else{pe===0&&(i.setRenderTarget(G.map),i.clear());let ee=G.getViewport(pe);o.set(r.x*ee.x,r.y*ee.y,r.x*ee.z,r.y*ee.w),k.viewport(o)}n=G.getFrustum(pe),_(v,E,he,Y,te,this.type)}G.isPointLightShadow!==!0&&this.type===Oo&&x(G,E),G.needsUpdate=!1}m=this.type,g.needsUpdate=!1,i.setRenderTarget(N,P,I)};function x(T,v){let E=e.update(y);d.defines.VSM_SAMPLES!==T.blurSamples&&(d.defines.VSM_SAMPLES=T.blurSamples,f.defines.VSM_SAMPLES=T.blurSamples,d.needsUpdate=!0,f.needsUpdate=!0),T.mapPass===null?T.mapPass=new Ai(s.x,s.y,{format:yr,type:ji}):(T.mapPass.width!==T.map.width||T.mapPass.height!==T.map.height)&&T.mapPass.setSize(T.map.width,T.map.height),d.uniforms.shadow_pass.value=T.map.depthTexture,d.uniforms.resolution.value.set(T.map.width,T.map.height),d.uniforms.radius.value=T.radius,i.setRenderTarget(T.mapPass),i.clear(),i.renderBufferDirect(v,null,E,d,y,null),f.uniforms.shadow_pass.value=T.mapPass.texture,f.uniforms.resolution.value.set(T.map.width,T.map.height),f.uniforms.radius.value=T.radius,i.setRenderTarget(T.map),i.clear(),i.renderBufferDirect(v,null,E,f,y,null)}function M(T,v,E,N){let P=null,I=E.isPointLight===!0?T.customDistanceMaterial:T.customDepthMaterial;if(I!==void 0)P=I;else if(P=E.isPointLight===!0?l:a,i.localClippingEnabled&&v.clipShadows===!0&&Array.isArray(v.clippingPlanes)&&v.clippingPlanes.length!==0||v.displacementMap&&v.displacementScale!==0||v.alphaMap&&v.alphaTest>0||v.map&&v.alphaTest>0||v.alphaToCoverage===!0){let k=P.uuid,V=v.uuid,F=c[k];F===void 0&&(F={},c[k]=F);let z=F[V];z===void 0&&(z=P.clone(),F[V]=z,v.addEventListener("dispose",C)),P=z}if(P.visible=v.visible,P.wireframe=v.wireframe,N===Oo?P.side=v.shadowSide!==null?v.shadowSide:v.side:P.side=v.shadowSide!==null?v.shadowSide:u[v.side],P.alphaMap=v.alphaMap,P.alphaTest=v.alphaToCoverage===!0?.5:v.alphaTest,P.map=v.map,P.clipShadows=v.clipShadows,P.clippingPlanes=v.clippingPlanes,P.clipIntersection=v.clipIntersection,P.displacementMap=v.displacementMap,P.displacementScale=v.displacementScale,P.displacementBias=v.displacementBias,P.wireframeLinewidth=v.wireframeLinewidth,P.linewidth=v.linewidth,E.isPointLight===!0&&P.isMeshDistanceMaterial===!0){let k=i.properties.get(P);k.light=E}return P}function _(T,v,E,N,P,I){if(T.visible===!1)return;if(T.layers.test(P)&&(T.isMesh||T.isLine||T.isPoints)&&(T.castShadow||T.receiveShadow&&I===Oo)&&(!T.frustumCulled||T.intersectsFrustum(n))){T.modelViewMatrix.multiplyMatrices(E.matrixWorldInverse,T.matrixWorld);let F=e.update(T),z=T.material;if(Array.isArray(z)){let Y=F.groups;for(let G=0,ce=Y.length;G<ce;G++){let J=Y[G],Q=z[J.materialIndex];if(Q&&Q.visible){let te=M(T,Q,N,I);T.onBeforeShadow(i,T,v,E,F,te,J),i.renderBufferDirect(E,null,F,te,T,J),T.onAfterShadow(i,T,v,E,F,te,J)}}}else if(z.visible){let Y=M(T,z,N,I);T.onBeforeShadow(i,T,v,E,F,Y,null),i.renderBufferDirect(E,null,F,Y,T,null),T.onAfterShadow(i,T,v,E,F,Y,null)}}let V=T.children;for(let F=0,z=V.length;F<z;F++)_(V[F],v,E,N,P,I)}function C(T){T.target.removeEventListener("dispose",C);for(let E in c){let N=c[E],P=T.target.uuid;P in N&&(N[P].dispose(),delete N[P])}}}function RT(i,e){function t(){let B=!1,re=new Gt,ie=null,Ce=new Gt(0,0,0,0);return{setMask:function(be){ie!==be&&!B&&(i.colorMask(be,be,be,be),ie=be)},setLocked:function(be){B=be},setClear:function(be,Re,Ke,ut,de){de===!0&&(be*=ut,Re*=ut,Ke*=ut),re.set(be,Re,Ke,ut),Ce.equals(re)===!1&&(i.clearColor(be,Re,Ke,ut),Ce.copy(re))},reset:function(){B=!1,ie=null,Ce.set(-1,0,0,0)}}}function n(){let B=!1,re=!1,ie=null,Ce=null,be=null;return{setReversed:function(Re){if(re!==Re){let Ke=e.get("EXT_clip_control");Re?Ke.clipControlEXT(Ke.LOWER_LEFT_EXT,Ke.ZERO_TO_ONE_EXT):Ke.clipControlEXT(Ke.LOWER_LEFT_EXT,Ke.NEGATIVE_ONE_TO_ONE_EXT),re=Re;let ut=be;be=null,this.setClear(ut)}},getReversed:function(){return re},setTest:function(Re){Re?Ee(i.DEPTH_TEST):Ve(i.DEPTH_TEST)},setMask:function(Re){ie!==Re&&!B&&(i.depthMask(Re),ie=Re)},setFunc:function(Re){if(re&&(Re=v0[Re]),Ce!==Re){switch(Re){case Lc:i.depthFunc(i.NEVER);break;case Dc:i.depthFunc(i.ALWAYS);break;case Nc:i.depthFunc(i.LESS);break;case Eo:i.depthFunc(i.LEQUAL);break;case Fc:i.depthFunc(i.EQUAL);break;case Uc:i.depthFunc(i.GEQUAL);break;case Oc:i.depthFunc(i.GREATER);break;case Bc:i.depthFunc(i.NOTEQUAL);break;default:i.depthFunc(i.LEQUAL)}Ce=Re}},setLocked:function(Re){B=Re},setClear:function(Re){be!==Re&&(be=Re,re&&(Re=1-Re),i.clearDepth(Re))},reset:function(){B=!1,ie=null,Ce=null,be=null,re=!1}}}function s(){let B=!1,re=null,ie=null,Ce=null,be=null,Re=null,Ke=null,ut=null,de=null;return{setTest:function(qe){B||(qe?Ee(i.STENCIL_TEST):Ve(i.STENCIL_TEST))},setMask:function(qe){re!==qe&&!B&&(i.stencilMask(qe),re=qe)},setFunc:function(qe,dt,Ne){(ie!==qe||Ce!==dt||be!==Ne)&&(i.stencilFunc(qe,dt,Ne),ie=qe,Ce=dt,be=Ne)},setOp:function(qe,dt,Ne){(Re!==qe||Ke!==dt||ut!==Ne)&&(i.stencilOp(qe,dt,Ne),Re=qe,Ke=dt,ut=Ne)},setLocked:function(qe){B=qe},setClear:function(qe){de!==qe&&(i.clearStencil(qe),de=qe)},reset:function(){B=!1,re=null,ie=null,Ce=null,be=null,Re=null,Ke=null,ut=null,de=null}}}let r=new t,o=new n,a=new s,l={},c=new WeakMap,h={},u={},d={},f=new WeakMap,p=[],y=null,g=!1,m=null,x=null,M=null,_=null,C=null,T=null,v=null,E=new et(0,0,0),N=0,P=!1,I=null,k=null,V=null,F=null,z=null,Y=i.getParameter(i.MAX_COMBINED_TEXTURE_IMAGE_UNITS),G=!1,ce=0,J=i.getParameter(i.VERSION);J.indexOf("WebGL")!==-1?(ce=parseFloat(/^WebGL (\d)/.exec(J)[1]),G=ce>=1):J.indexOf("OpenGL ES")!==-1&&(ce=parseFloat(/^OpenGL ES (\d)/.exec(J)[1]),G=ce>=2);let Q=null,te={},pe=i.getParameter(i.SCISSOR_BOX),he=i.getParameter(i.VIEWPORT),ee=new Gt().fromArray(pe),ye=new Gt().fromArray(he);function ve(B,re,ie,Ce){let be=new Uint8Array(4),Re=i.createTexture();i.bindTexture(B,Re),i.texParameteri(B,i.TEXTURE_MIN_FILTER,i.NEAREST),i.texParameteri(B,i.TEXTURE_MAG_FILTER,i.NEAREST);for(let Ke=0;Ke<ie;Ke++)B===i.TEXTURE_3D||B===i.TEXTURE_2D_ARRAY?i.texImage3D(re,0,i.RGBA,1,1,Ce,0,i.RGBA,i.UNSIGNED_BYTE,be):i.texImage2D(re+Ke,0,i.RGBA,1,1,0,i.RGBA,i.UNSIGNED_BYTE,be);return Re}let Le={};Le[i.TEXTURE_2D]=ve(i.TEXTURE_2D,i.TEXTURE_2D,1),Le[i.TEXTURE_CUBE_MAP]=ve(i.TEXTURE_CUBE_MAP,i.TEXTURE_CUBE_MAP_POSITIVE_X,6),Le[i.TEXTURE_2D_ARRAY]=ve(i.TEXTURE_2D_ARRAY,i.TEXTURE_2D_ARRAY,1,1),Le[i.TEXTURE_3D]=ve(i.TEXTURE_3D,i.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),Ee(i.DEPTH_TEST),o.setFunc(Eo),Be(!1),De(Tf),Ee(i.CULL_FACE),_e(Dr);function Ee(B){h[B]!==!0&&(i.enable(B),h[B]=!0)}function Ve(B){h[B]!==!1&&(i.disable(B),h[B]=!1)}function at(B,re){return d[B]!==re?(i.bindFramebuffer(B,re),d[B]=re,B===i.DRAW_FRAMEBUFFER&&(d[i.FRAMEBUFFER]=re),B===i.FRAMEBUFFER&&(d[i.DRAW_FRAMEBUFFER]=re),!0):!1}function Je(B,re){let ie=p,Ce=!1;if(B){ie=f.get(re),ie===void 0&&(ie=[],f.set(re,ie));let be=B.textures;if(ie.length!==be.length||ie[0]!==i.COLOR_ATTACHMENT0){for(let Re=0,Ke=be.length;Re<Ke;Re++)ie[Re]=i.COLOR_ATTACHMENT0+Re;ie.length=be.length,Ce=!0}}else ie[0]!==i.BACK&&(ie[0]=i.BACK,Ce=!0);Ce&&i.drawBuffers(ie)}function lt(B){return y!==B?(i.useProgram(B),y=B,!0):!1}let rt={[Nr]:i.FUNC_ADD,[Vg]:i.FUNC_SUBTRACT,[Gg]:i.FUNC_REVERSE_SUBTRACT};rt[Wg]=i.MIN,rt[Xg]=i.MAX;let oe={[qg]:i.ZERO,[Yg]:i.ONE,[$g]:i.SRC_COLOR,[If]:i.SRC_ALPHA,[e0]:i.SRC_ALPHA_SATURATE,[jg]:i.DST_COLOR,[Jg]:i.DST_ALPHA,[Zg]:i.ONE_MINUS_SRC_COLOR,[Lf]:i.ONE_MINUS_SRC_ALPHA,[Qg]:i.ONE_MINUS_DST_COLOR,[Kg]:i.ONE_MINUS_DST_ALPHA,[t0]:i.CONSTANT_COLOR,[n0]:i.ONE_MINUS_CONSTANT_COLOR,[i0]:i.CONSTANT_ALPHA,[s0]:i.ONE_MINUS_CONSTANT_ALPHA};function _e(B,re,ie,Ce,be,Re,Ke,ut,de,qe){if(B===Dr){g===!0&&(Ve(i.BLEND),g=!1);return}if(g===!1&&(Ee(i.BLEND),g=!0),B!==zg){if(B!==m||qe!==P){if((x!==Nr||C!==Nr)&&(i.blendEquation(i.FUNC_ADD),x=Nr,C=Nr),qe)switch(B){case Bo:i.blendFuncSeparate(i.ONE,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Rf:i.blendFunc(i.ONE,i.ONE);break;case Cf:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case Pf:i.blendFuncSeparate(i.DST_COLOR,i.ONE_MINUS_SRC_ALPHA,i.ZERO,i.ONE);break;default:ht("WebGLState: Invalid blending: ",B);break}else switch(B){case Bo:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Rf:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE,i.ONE,i.ONE);break;case Cf:ht("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case Pf:ht("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:ht("WebGLState: Invalid blending: ",B);break}M=null,_=null,T=null,v=null,E.set(0,0,0),N=0,m=B,P=qe}return}be=be||re,Re=Re||ie,Ke=Ke||Ce,(re!==x||be!==C)&&(i.blendEquationSeparate(rt[re],rt[be]),x=re,C=be),(ie!==M||Ce!==_||Re!==T||Ke!==v)&&(i.blendFuncSeparate(oe[ie],oe[Ce],oe[Re],oe[Ke]),M=ie,_=Ce,T=Re,v=Ke),(ut.equals(E)===!1||de!==N)&&(i.blendColor(ut.r,ut.g,ut.b,de),E.copy(ut),N=de),m=B,P=!1}function xe(B,re){B.side===Sn?Ve(i.CULL_FACE):Ee(i.CULL_FACE);let ie=B.side===li;re&&(ie=!ie),Be(ie),B.blending===Bo&&B.transparent===!1?_e(Dr):_e(B.blending,B.blendEquation,B.blendSrc,B.blendDst,B.blendEquationAlpha,B.blendSrcAlpha,B.blendDstAlpha,B.blendColor,B.blendAlpha,B.premultipliedAlpha),o.setFunc(B.depthFunc),o.setTest(B.depthTest),o.setMask(B.depthWrite),r.setMask(B.colorWrite);let Ce=B.stencilWrite;a.setTest(Ce),Ce&&(a.setMask(B.stencilWriteMask),a.setFunc(B.stencilFunc,B.stencilRef,B.stencilFuncMask),a.setOp(B.stencilFail,B.stencilZFail,B.stencilZPass)),ke(B.polygonOffset,B.polygonOffsetFactor,B.polygonOffsetUnits),B.alphaToCoverage===!0?Ee(i.SAMPLE_ALPHA_TO_COVERAGE):Ve(i.SAMPLE_ALPHA_TO_COVERAGE)}function Be(B){I!==B&&(B?i.frontFace(i.CW):i.frontFace(i.CCW),I=B)}function De(B){B!==Bg?(Ee(i.CULL_FACE),B!==k&&(B===Tf?i.cullFace(i.BACK):B===kg?i.cullFace(i.FRONT):i.cullFace(i.FRONT_AND_BACK))):Ve(i.CULL_FACE),k=B}function st(B){B!==V&&(G&&i.lineWidth(B),V=B)}function ke(B,re,ie){B?(Ee(i.POLYGON_OFFSET_FILL),(F!==re||z!==ie)&&(F=re,z=ie,o.getReversed()&&(re=-re,ie=-ie),i.polygonOffset(re,ie))):Ve(i.POLYGON_OFFSET_FILL)}function vt(B){B?Ee(i.SCISSOR_TEST):Ve(i.SCISSOR_TEST)}function gt(B){B===void 0&&(B=i.TEXTURE0+Y-1),Q!==B&&(i.activeTexture(B),Q=B)}function bt(B,re,ie){ie===void 0&&(Q===null?ie=i.TEXTURE0+Y-1:ie=Q);let Ce=te[ie];Ce===void 0&&(Ce={type:void 0,texture:void 0},te[ie]=Ce),(Ce.type!==B||Ce.texture!==re)&&(Q!==ie&&(i.activeTexture(ie),Q=ie),i.bindTexture(B,re||Le[B]),Ce.type=B,Ce.texture=re)}function O(){let B=te[Q];B!==void 0&&B.type!==void 0&&(i.bindTexture(B.type,null),B.type=void 0,B.texture=void 0)}function Me(){try{i.compressedTexImage2D(...arguments)}catch(B){ht("WebGLState:",B)}}function Xe(){try{i.compressedTexImage3D(...arguments)}catch(B){ht("WebGLState:",B)}}function ft(){try{i.texSubImage2D(...arguments)}catch(B){ht("WebGLState:",B)}}function we(){try{i.texSubImage3D(...arguments)}catch(B){ht("WebGLState:",B)}}function zt(){try{i.compressedTexSubImage2D(...arguments)}catch(B){ht("WebGLState:",B)}}function $e(){try{i.compressedTexSubImage3D(...arguments)}catch(B){ht("WebGLState:",B)}}function tt(){try{i.texStorage2D(...arguments)}catch(B){ht("WebGLState:",B)}}function L(){try{i.texStorage3D(...arguments)}catch(B){ht("WebGLState:",B)}}function w(){try{i.texImage2D(...arguments)}catch(B){ht("WebGLState:",B)}}function q(){try{i.texImage3D(...arguments)}catch(B){ht("WebGLState:",B)}}function fe(B){return u[B]!==void 0?u[B]:i.getParameter(B)}function ae(B,re){u[B]!==re&&(i.pixelStorei(B,re),u[B]=re)}function Se(B){ee.equals(B)===!1&&(i.scissor(B.x,B.y,B.z,B.w),ee.copy(B))}function Te(B){ye.equals(B)===!1&&(i.viewport(B.x,B.y,B.z,B.w),ye.copy(B))}function ne(B,re){let ie=c.get(re);ie===void 0&&(ie=new WeakMap,c.set(re,ie));let Ce=ie.get(B);Ce===void 0&&(Ce=i.getUniformBlockIndex(re,B.name),i.uniformBlockBinding(re,Ce,Ce),ie.set(B,Ce))}function se(B,re,ie){let be=c.get(re).get(B);l[be]!==ie&&(i.bindBufferBase(i.UNIFORM_BUFFER,be,ie),l[be]=ie)}function ge(){i.disable(i.BLEND),i.disable(i.CULL_FACE),i.disable(i.DEPTH_TEST),i.disable(i.POLYGON_OFFSET_FILL),i.disable(i.SCISSOR_TEST),i.disable(i.STENCIL_TEST),i.disable(i.SAMPLE_ALPHA_TO_COVERAGE),i.blendEquation(i.FUNC_ADD),i.blendFunc(i.ONE,i.ZERO),i.blendFuncSeparate(i.ONE,i.ZERO,i.ONE,i.ZERO),i.blendColor(0,0,0,0),i.colorMask(!0,!0,!0,!0),i.clearColor(0,0,0,0),i.depthMask(!0),i.depthFunc(i.LESS),o.setReversed(!1),i.clearDepth(1),i.stencilMask(4294967295),i.stencilFunc(i.ALWAYS,0,4294967295),i.stencilOp(i.KEEP,i.KEEP,i.KEEP),i.clearStencil(0),i.cullFace(i.BACK),i.frontFace(i.CCW),i.polygonOffset(0,0),i.activeTexture(i.TEXTURE0),i.bindFramebuffer(i.FRAMEBUFFER,null),i.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),i.bindFramebuffer(i.READ_FRAMEBUFFER,null),i.useProgram(null),i.lineWidth(1),i.scissor(0,0,i.canvas.width,i.canvas.height),i.viewport(0,0,i.canvas.width,i.canvas.height),i.pixelStorei(i.PACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,!1),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,i.BROWSER_DEFAULT_WEBGL),i.pixelStorei(i.PACK_ROW_LENGTH,0),i.pixelStorei(i.PACK_SKIP_PIXELS,0),i.pixelStorei(i.PACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_ROW_LENGTH,0),i.pixelStorei(i.UNPACK_IMAGE_HEIGHT,0),i.pixelStorei(i.UNPACK_SKIP_PIXELS,0),i.pixelStorei(i.UNPACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_SKIP_IMAGES,0),h={},u={},Q=null,te={},d={},l={},f=new WeakMap,p=[],y=null,g=!1,m=null,x=null,M=null,_=null,C=null,T=null,v=null,E=new et(0,0,0),N=0,P=!1,I=null,k=null,V=null,F=null,z=null,ee.set(0,0,i.canvas.width,i.canvas.height),ye.set(0,0,i.canvas.width,i.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:Ee,disable:Ve,bindFramebuffer:at,drawBuffers:Je,useProgram:lt,setBlending:_e,setMaterial:xe,setFlipSided:Be,setCullFace:De,setLineWidth:st,setPolygonOffset:ke,setScissorTest:vt,activeTexture:gt,bindTexture:bt,unbindTexture:O,compressedTexImage2D:Me,compressedTexImage3D:Xe,texImage2D:w,texImage3D:q,pixelStorei:ae,getParameter:fe,updateUBOMapping:ne,uniformBlockBinding:se,texStorage2D:tt,texStorage3D:L,texSubImage2D:ft,texSubImage3D:we,compressedTexSubImage2D:zt,compressedTexSubImage3D:$e,scissor:Se,viewport:Te,reset:ge}}function CT(i,e,t,n,s,r,o){let a=e.has("WEBGL_multisampled_render_to_texture")?e.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new ue,h=new WeakMap,u=new Set,d,f=new WeakMap,p=new Set,y=new FinalizationRegistry(L=>p.delete(L)),g=!1;try{g=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function m(L,w){return g?new OffscreenCanvas(L,w):Ca("canvas")}function x(L,w,q){let fe=1,ae=tt(L);if((ae.width>q||ae.height>q)&&(fe=q/Math.max(ae.width,ae.height)),fe<1)if(typeof HTMLImageElement<"u"&&L instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&L instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&L instanceof ImageBitmap||typeof VideoFrame<"u"&&L instanceof VideoFrame){let Se=Math.floor(fe*ae.width),Te=Math.floor(fe*ae.height);d===void 0&&(d=m(Se,Te));let ne=w?m(Se,Te):d;return ne.width=Se,ne.height=Te,ne.getContext("2d").drawImage(L,0,0,Se,Te),it("WebGLRenderer: Texture has been resized from ("+ae.width+"x"+ae.height+") to ("+Se+"x"+Te+")."),ne}else return"data"in L&&it("WebGLRenderer: Image in DataTexture is too big ("+ae.width+"x"+ae.height+")."),L;return L}function M(L){return L.generateMipmaps}function _(L){i.generateMipmap(L)}function C(L){return L.isWebGLCubeRenderTarget?i.TEXTURE_CUBE_MAP:L.isWebGL3DRenderTarget?i.TEXTURE_3D:L.isWebGLArrayRenderTarget||L.isCompressedArrayTexture?i.TEXTURE_2D_ARRAY:i.TEXTURE_2D}function T(L,w,q,fe,ae,Se=!1){if(L!==null){if(i[L]!==void 0)return i[L];it("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+L+"'")}let Te;fe&&(Te=e.get("EXT_texture_norm16"),Te||it("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let ne=w;if(w===i.RED&&(q===i.FLOAT&&(ne=i.R32F),q===i.HALF_FLOAT&&(ne=i.R16F),q===i.UNSIGNED_BYTE&&(ne=i.R8),q===i.UNSIGNED_SHORT&&Te&&(ne=Te.R16_EXT),q===i.SHORT&&Te&&(ne=Te.R16_SNORM_EXT)),w===i.RED_INTEGER&&(q===i.UNSIGNED_BYTE&&(ne=i.R8UI),q===i.UNSIGNED_SHORT&&(ne=i.R16UI),q===i.UNSIGNED_INT&&(ne=i.R32UI),q===i.BYTE&&(ne=i.R8I),q===i.SHORT&&(ne=i.R16I),q===i.INT&&(ne=i.R32I)),w===i.RG&&(q===i.FLOAT&&(ne=i.RG32F),q===i.HALF_FLOAT&&(ne=i.RG16F),q===i.UNSIGNED_BYTE&&(ne=i.RG8),q===i.UNSIGNED_SHORT&&Te&&(ne=Te.RG16_EXT),q===i.SHORT&&Te&&(ne=Te.RG16_SNORM_EXT)),w===i.RG_INTEGER&&(q===i.UNSIGNED_BYTE&&(ne=i.RG8UI),q===i.UNSIGNED_SHORT&&(ne=i.RG16UI),q===i.UNSIGNED_INT&&(ne=i.RG32UI),q===i.BYTE&&(ne=i.RG8I),q===i.SHORT&&(ne=i.RG16I),q===i.INT&&(ne=i.RG32I)),w===i.RGB_INTEGER&&(q===i.UNSIGNED_BYTE&&(ne=i.RGB8UI),q===i.UNSIGNED_SHORT&&(ne=i.RGB16UI),q===i.UNSIGNED_INT&&(ne=i.RGB32UI),q===i.BYTE&&(ne=i.RGB8I),q===i.SHORT&&(ne=i.RGB16I),q===i.INT&&(ne=i.RGB32I)),w===i.RGBA_INTEGER&&(q===i.UNSIGNED_BYTE&&(ne=i.RGBA8UI),q===i.UNSIGNED_SHORT&&(ne=i.RGBA16UI),q===i.UNSIGNED_INT&&(ne=i.RGBA32UI),q===i.BYTE&&(ne=i.RGBA8I),q===i.SHORT&&(ne=i.RGBA16I),q===i.INT&&(ne=i.RGBA32I)),w===i.RGB&&(q===i.UNSIGNED_SHORT&&Te&&(ne=Te.RGB16_EXT),q===i.SHORT&&Te&&(ne=Te.RGB16_SNORM_EXT),q===i.UNSIGNED_INT_5_9_9_9_REV&&(ne=i.RGB9_E5),q===i.UNSIGNED_INT_10F_11F_11F_REV&&(ne=i.R11F_G11F_B10F)),w===i.RGBA){let se=Se?Ra:Ct.getTransfer(ae);q===i.FLOAT&&(ne=i.RGBA32F),q===i.HALF_FLOAT&&(ne=i.RGBA16F),q===i.UNSIGNED_BYTE&&(ne=se===Vt?i.SRGB8_ALPHA8:i.RGBA8),q===i.UNSIGNED_SHORT&&Te&&(ne=Te.RGBA16_EXT),q===i.SHORT&&Te&&(ne=Te.RGBA16_SNORM_EXT),q===i.UNSIGNED_SHORT_4_4_4_4&&(ne=i.RGBA4),q===i.UNSIGNED_SHORT_5_5_5_1&&(ne=i.RGB5_A1)}return(ne===i.R16F||ne===i.R32F||ne===i.RG16F||ne===i.RG32F||ne===i.RGBA16F||ne===i.RGBA32F)&&e.get("EXT_color_buffer_float"),ne}function v(L,w){let q;return L?w===null||w===zi||w===Ur?q=i.DEPTH24_STENCIL8:w===pi?q=i.DEPTH32F_STENCIL8:w===Ho&&(q=i.DEPTH24_STENCIL8,it("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):w===null||w===zi||w===Ur?q=i.DEPTH_COMPONENT24:w===pi?q=i.DEPTH_COMPONENT32F:w===Ho&&(q=i.DEPTH_COMPONENT16),q}function E(L,w){return M(L)===!0||L.isFramebufferTexture&&L.minFilter!==kn&&L.minFilter!==oi?Math.log2(Math.max(w.width,w.height))+1:L.mipmaps.length>0?L.mipmaps.length:L.isCompressedTexture&&Array.isArray(L.image)?w.mipmaps.length:1}function N(L){let w=new WeakRef(L);n.get(L).__ref=w,p.add(w),y.register(L,w,w)}function P(L){let w=n.get(L).__ref;w!==void 0&&(p.delete(w),y.unregister(w))}function I(L){V(L.target)}function k(L){F(L.target)}function V(L){L.removeEventListener("dispose",I),P(L),Y(L),L.isVideoTexture&&h.delete(L),L.isHTMLTexture&&u.delete(L)}function F(L){L.removeEventListener("dispose",k),P(L),ce(L)}function z(){for(let L of p){let w=L.deref();w!==void 0&&(w.isRenderTarget===!0?F(w):V(w))}p.clear(),u.clear()}function Y(L){let w=n.get(L);if(w.__webglInit===void 0)return;let q=L.source,fe=f.get(q);if(fe){let ae=fe[w.__cacheKey];ae.usedTimes--,ae.usedTimes===0&&G(L),Object.keys(fe).length===0&&f.delete(q)}n.remove(L)}function G(L){let w=n.get(L);i.deleteTexture(w.__webglTexture);let q=L.source,fe=f.get(q);delete fe[w.__cacheKey],o.memory.textures--}function ce(L){let w=n.get(L);w.__depthDisposeCallback&&w.__depthDisposeCallback();let q=L.depthTexture;if(q&&q.renderTarget===L&&V(q),L.isWebGLCubeRenderTarget)for(let ae=0;ae<6;ae++){if(Array.isArray(w.__webglFramebuffer[ae]))for(let Se=0;Se<w.__webglFramebuffer[ae].length;Se++)i.deleteFramebuffer(w.__webglFramebuffer[ae][Se]);else i.deleteFramebuffer(w.__webglFramebuffer[ae]);w.__webglDepthbuffer&&i.deleteRenderbuffer(w.__webglDepthbuffer[ae])}else{if(Array.isArray(w.__webglFramebuffer))for(let ae=0;ae<w.__webglFramebuffer.length;ae++)i.deleteFramebuffer(w.__webglFramebuffer[ae]);else i.deleteFramebuffer(w.__webglFramebuffer);if(w.__webglDepthbuffer&&i.deleteRenderbuffer(w.__webglDepthbuffer),w.__webglMultisampledFramebuffer&&i.deleteFramebuffer(w.__webglMultisampledFramebuffer),w.__webglColorRenderbuffer)for(let ae=0;ae<w.__webglColorRenderbuffer.length;ae++)w.__webglColorRenderbuffer[ae]&&i.deleteRenderbuffer(w.__webglColorRenderbuffer[ae]);w.__webglDepthRenderbuffer&&i.deleteRenderbuffer(w.__webglDepthRenderbuffer)}let fe=L.textures;for(let ae=0,Se=fe.length;ae<Se;ae++){let Te=n.get(fe[ae]);Te.__webglTexture&&(i.deleteTexture(Te.__webglTexture),o.memory.textures--),n.remove(fe[ae])}n.remove(L)}let J=0;function Q(){J=0}function te(){return J}function pe(L){J=L}function he(){let L=J;return L>=s.maxTextures&&it("WebGLTextures: Trying to use "+(L+1)+" texture units while this GPU supports only "+s.maxTextures),J+=1,L}function ee(L){let w=[];return w.push(L.wrapS),w.push(L.wrapT),w.push(L.wrapR||0),w.push(L.magFilter),w.push(L.minFilter),w.push(L.anisotropy),w.push(L.internalFormat),w.push(L.format),w.push(L.type),w.push(L.generateMipmaps),w.push(L.mipmapsAutoUpdate),w.push(L.premultiplyAlpha),w.push(L.flipY),w.push(L.unpackAlignment),w.push(L.colorSpace),w.join()}function ye(L,w){let q=n.get(L);if(L.isVideoTexture&&zt(L),L.isRenderTargetTexture===!1&&L.isExternalTexture!==!0&&L.version>0&&q.__version!==L.version){let fe=L.image;if(fe===null)it("WebGLRenderer: Texture marked for update but no image data found.");else if(fe.complete===!1)it("WebGLRenderer: Texture marked for update but image is incomplete");else{xe(q,L,w);return}}else L.isExternalTexture&&(q.__webglTexture=L.sourceTexture?L.sourceTexture:null);t.bindTexture(i.TEXTURE_2D,q.__webglTexture,i.TEXTURE0+w)}function ve(L,w){let q=n.get(L);if(L.isRenderTargetTexture===!1&&L.version>0&&q.__version!==L.version){xe(q,L,w);return}else L.isExternalTexture&&(q.__webglTexture=L.sourceTexture?L.sourceTexture:null);t.bindTexture(i.TEXTURE_2D_ARRAY,q.__webglTexture,i.TEXTURE0+w)}function Le(L,w){let q=n.get(L);if(L.isRenderTargetTexture===!1&&L.version>0&&q.__version!==L.version){xe(q,L,w);return}t.bindTexture(i.TEXTURE_3D,q.__webglTexture,i.TEXTURE0+w)}function Ee(L,w){let q=n.get(L);if(L.version>0&&q.__version!==L.version){Be(q,L,w);return}t.bindTexture(i.TEXTURE_CUBE_MAP,q.__webglTexture,i.TEXTURE0+w)}let Ve={[kc]:i.REPEAT,[ds]:i.CLAMP_TO_EDGE,[Hc]:i.MIRRORED_REPEAT},at={[kn]:i.NEAREST,[a0]:i.NEAREST_MIPMAP_NEAREST,[fl]:i.NEAREST_MIPMAP_LINEAR,[oi]:i.LINEAR,[gh]:i.LINEAR_MIPMAP_NEAREST,[Vs]:i.LINEAR_MIPMAP_LINEAR},Je={[u0]:i.NEVER,[Zf]:i.ALWAYS,[d0]:i.LESS,[Yf]:i.LEQUAL,[f0]:i.EQUAL,[$f]:i.GEQUAL,[p0]:i.GREATER,[m0]:i.NOTEQUAL};function lt(L,w){if(w.type===pi&&e.has("OES_texture_float_linear")===!1&&(w.magFilter===oi||w.magFilter===gh||w.magFilter===fl||w.magFilter===Vs||w.minFilter===oi||w.minFilter===gh||w.minFilter===fl||w.minFilter===Vs)&&it("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),i.texParameteri(L,i.TEXTURE_WRAP_S,Ve[w.wrapS]),i.texParameteri(L,i.TEXTURE_WRAP_T,Ve[w.wrapT]),(L===i.TEXTURE_3D||L===i.TEXTURE_2D_ARRAY)&&i.texParameteri(L,i.TEXTURE_WRAP_R,Ve[w.wrapR]),i.texParameteri(L,i.TEXTURE_MAG_FILTER,at[w.magFilter]),i.texParameteri(L,i.TEXTURE_MIN_FILTER,at[w.minFilter]),w.compareFunction&&(i.texParameteri(L,i.TEXTURE_COMPARE_MODE,i.COMPARE_REF_TO_TEXTURE),i.texParameteri(L,i.TEXTURE_COMPARE_FUNC,Je[w.compareFunction])),e.has("EXT_texture_filter_anisotropic")===!0){if(w.magFilter===kn||w.minFilter!==fl&&w.minFilter!==Vs||w.type===pi&&e.has("OES_texture_float_linear")===!1)return;if(w.anisotropy>1||n.get(w).__currentAnisotropy){let q=e.get("EXT_texture_filter_anisotropic");i.texParameterf(L,q.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(w.anisotropy,s.getMaxAnisotropy())),n.get(w).__currentAnisotropy=w.anisotropy}}}function rt(L,w){let q=!1;L.__webglInit===void 0&&(L.__webglInit=!0,w.addEventListener("dispose",I),N(w));let fe=w.source,ae=f.get(fe);ae===void 0&&(ae={},f.set(fe,ae));let Se=ee(w);if(Se!==L.__cacheKey){ae[Se]===void 0&&(ae[Se]={texture:i.createTexture(),usedTimes:0},o.memory.textures++,q=!0),ae[Se].usedTimes++;let Te=ae[L.__cacheKey];Te!==void 0&&(ae[L.__cacheKey].usedTimes--,Te.usedTimes===0&&G(w)),L.__cacheKey=Se,L.__webglTexture=ae[Se].texture}return q}function oe(L,w,q){return Math.floor(Math.floor(L/q)/w)}function _e(L,w,q,fe){let Se=L.updateRanges;if(Se.length===0)t.texSubImage2D(i.TEXTURE_2D,0,0,0,w.width,w.height,q,fe,w.data);else{Se.sort((B,re)=>B.start-re.start);let Te=0;for(let B=1;B<Se.length;B++){let re=Se[Te],ie=Se[B],Ce=re.start+re.count,be=oe(ie.start,w.width,4),Re=oe(re.start,w.width,4);ie.start<=Ce+1&&be===Re&&oe(ie.start+ie.count-1,w.width,4)===be?re.count=Math.max(re.count,ie.start+ie.count-re.start):(++Te,Se[Te]=ie)}Se.length=Te+1;let ne=t.getParameter(i.UNPACK_ROW_LENGTH),se=t.getParameter(i.UNPACK_SKIP_PIXELS),ge=t.getParameter(i.UNPACK_SKIP_ROWS);t.pixelStorei(i.UNPACK_ROW_LENGTH,w.width);for(let B=0,re=Se.length;B<re;B++){let ie=Se[B],Ce=Math.floor(ie.start/4),be=Math.ceil(ie.count/4),Re=Ce%w.width,Ke=Math.floor(Ce/w.width),ut=be,de=1;t.pixelStorei(i.UNPACK_SKIP_PIXELS,Re),t.pixelStorei(i.UNPACK_SKIP_ROWS,Ke),t.texSubImage2D(i.TEXTURE_2D,0,Re,Ke,ut,de,q,fe,w.data)}L.clearUpdateRanges(),t.pixelStorei(i.UNPACK_ROW_LENGTH,ne),t.pixelStorei(i.UNPACK_SKIP_PIXELS,se),t.pixelStorei(i.UNPACK_SKIP_ROWS,ge)}}function xe(L,w,q){let fe=i.TEXTURE_2D;(w.isDataArrayTexture||w.isCompressedArrayTexture)&&(fe=i.TEXTURE_2D_ARRAY),w.isData3DTexture&&(fe=i.TEXTURE_3D);let ae=rt(L,w),Se=w.source;t.bindTexture(fe,L.__webglTexture,i.TEXTURE0+q);let Te=n.get(Se);if(Se.version!==Te.__version||ae===!0){if(t.activeTexture(i.TEXTURE0+q),(typeof ImageBitmap<"u"&&w.image instanceof ImageBitmap)===!1){let de=Ct.getPrimaries(Ct.workingColorSpace),qe=w.colorSpace===Ws?null:Ct.getPrimaries(w.colorSpace),dt=w.colorSpace===Ws||de===qe?i.NONE:i.BROWSER_DEFAULT_WEBGL;t.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,w.flipY),t.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,w.premultiplyAlpha),t.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,dt)}t.pixelStorei(i.UNPACK_ALIGNMENT,w.unpackAlignment);let se=x(w.image,!1,s.maxTextureSize);se=$e(w,se);let ge=r.convert(w.format,w.colorSpace),B=r.convert(w.type),re=T(w.internalFormat,ge,B,w.normalized,w.colorSpace,w.isVideoTexture);lt(fe,w);let ie,Ce=w.mipmaps,be=w.isVideoTexture!==!0,Re=Te.__version===void 0||ae===!0,Ke=Se.dataReady,ut=E(w,se);if(w.isDepthTexture)re=v(w.format===Gs,w.type),Re&&(be?t.texStorage2D(i.TEXTURE_2D,1,re,se.width,se.height):t.texImage2D(i.TEXTURE_2D,0,re,se.width,se.height,0,ge,B,null));else if(w.isDataTexture)if(Ce.length>0){be&&Re&&t.texStorage2D(i.TEXTURE_2D,ut,re,Ce[0].width,Ce[0].height);for(let de=0,qe=Ce.length;de<qe;de++)ie=Ce[de],be?Ke&&t.texSubImage2D(i.TEXTURE_2D,de,0,0,ie.width,ie.height,ge,B,ie.data):t.texImage2D(i.TEXTURE_2D,de,re,ie.width,ie.height,0,ge,B,ie.data);w.generateMipmaps=!1}else be?(Re&&t.texStorage2D(i.TEXTURE_2D,ut,re,se.width,se.height),Ke&&_e(w,se,ge,B)):t.texImage2D(i.TEXTURE_2D,0,re,se.width,se.height,0,ge,B,se.data);else if(w.isCompressedTexture)if(w.isCompressedArrayTexture){be&&Re&&t.texStorage3D(i.TEXTURE_2D_ARRAY,ut,re,Ce[0].width,Ce[0].height,se.depth);for(let de=0,qe=Ce.length;de<qe;de++)if(ie=Ce[de],w.format!==Ti)if(ge!==null)if(be){if(Ke)if(w.layerUpdates.size>0){let dt=op(ie.width,ie.height,w.format,w.type);for(let Ne of w.layerUpdates){let _t=ie.data.subarray(Ne*dt/ie.data.BYTES_PER_ELEMENT,(Ne+1)*dt/ie.data.BYTES_PER_ELEMENT);t.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,de,0,0,Ne,ie.width,ie.height,1,ge,_t)}}else t.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,de,0,0,0,ie.width,ie.height,se.depth,ge,ie.data)}else t.compressedTexImage3D(i.TEXTURE_2D_ARRAY,de,re,ie.width,ie.height,se.depth,0,ie.data,0,0);else it("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else be?Ke&&t.texSubImage3D(i.TEXTURE_2D_ARRAY,de,0,0,0,ie.width,ie.height,se.depth,ge,B,ie.data):t.texImage3D(i.TEXTURE_2D_ARRAY,de,re,ie.width,ie.height,se.depth,0,ge,B,ie.data);w.layerUpdates.size>0&&w.clearLayerUpdates()}else{be&&Re&&t.texStorage2D(i.TEXTURE_2D,ut,re,Ce[0].width,Ce[0].height);for(let de=0,qe=Ce.length;de<qe;de++)ie=Ce[de],w.format!==Ti?ge!==null?be?Ke&&t.compressedTexSubImage2D(i.TEXTURE_2D,de,0,0,ie.width,ie.height,ge,ie.data):t.compressedTexImage2D(i.TEXTURE_2D,de,re,ie.width,ie.height,0,ie.data):it("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):be?Ke&&t.texSubImage2D(i.TEXTURE_2D,de,0,0,ie.width,ie.height,ge,B,ie.data):t.texImage2D(i.TEXTURE_2D,de,re,ie.width,ie.height,0,ge,B,ie.data)}else if(w.isDataArrayTexture)if(be){if(Re&&t.texStorage3D(i.TEXTURE_2D_ARRAY,ut,re,se.width,se.height,se.depth),Ke)if(w.layerUpdates.size>0){let de=op(se.width,se.height,w.format,w.type);for(let qe of w.layerUpdates){let dt=se.data.subarray(qe*de/se.data.BYTES_PER_ELEMENT,(qe+1)*de/se.data.BYTES_PER_ELEMENT);t.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,qe,se.width,se.height,1,ge,B,dt)}w.clearLayerUpdates()}else t.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,0,se.width,se.height,se.depth,ge,B,se.data)}else t.texImage3D(i.TEXTURE_2D_ARRAY,0,re,se.width,se.height,se.depth,0,ge,B,se.data);else if(w.isData3DTexture)be?(Re&&t.texStorage3D(i.TEXTURE_3D,ut,re,se.width,se.height,se.depth),Ke&&t.texSubImage3D(i.TEXTURE_3D,0,0,0,0,se.width,se.height,se.depth,ge,B,se.data)):t.texImage3D(i.TEXTURE_3D,0,re,se.width,se.height,se.depth,0,ge,B,se.data);else if(w.isFramebufferTexture){if(Re)if(be)t.texStorage2D(i.TEXTURE_2D,ut,re,se.width,se.height);else{let de=se.width,qe=se.height;for(let dt=0;dt<ut;dt++)t.texImage2D(i.TEXTURE_2D,dt,re,de,qe,0,ge,B,null),de>>=1,qe>>=1}}else if(w.isHTMLTexture){if("texElementImage2D"in i){let de=i.canvas;if(de.hasAttribute("layoutsubtree")||de.setAttribute("layoutsubtree","true"),se.parentNode!==de){de.appendChild(se),u.add(w),de.onpaint=qe=>{let dt=qe.changedElements;for(let Ne of u)dt.includes(Ne.image)&&(Ne.needsUpdate=!0)},de.requestPaint();return}if(i.texElementImage2D.length===3)i.texElementImage2D(i.TEXTURE_2D,i.RGBA8,se);else{let dt=i.RGBA,Ne=i.RGBA,_t=i.UNSIGNED_BYTE;i.texElementImage2D(i.TEXTURE_2D,0,dt,Ne,_t,se)}i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MIN_FILTER,i.LINEAR),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_S,i.CLAMP_TO_EDGE),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_T,i.CLAMP_TO_EDGE)}}else if(Ce.length>0){if(be&&Re){let de=tt(Ce[0]);t.texStorage2D(i.TEXTURE_2D,ut,re,de.width,de.height)}for(let de=0,qe=Ce.length;de<qe;de++)ie=Ce[de],be?Ke&&t.texSubImage2D(i.TEXTURE_2D,de,0,0,ge,B,ie):t.texImage2D(i.TEXTURE_2D,de,re,ge,B,ie);w.generateMipmaps=!1}else if(be){if(Re){let de=tt(se);t.texStorage2D(i.TEXTURE_2D,ut,re,de.width,de.height)}Ke&&t.texSubImage2D(i.TEXTURE_2D,0,0,0,ge,B,se)}else t.texImage2D(i.TEXTURE_2D,0,re,ge,B,se);M(w)&&w.mipmapsAutoUpdate===!0&&_(fe),Te.__version=Se.version,w.onUpdate&&w.onUpdate(w)}L.__version=w.version}function Be(L,w,q){if(w.image.length!==6)return;let fe=rt(L,w),ae=w.source;t.bindTexture(i.TEXTURE_CUBE_MAP,L.__webglTexture,i.TEXTURE0+q);let Se=n.get(ae);if(ae.version!==Se.__version||fe===!0){t.activeTexture(i.TEXTURE0+q);let Te=Ct.getPrimaries(Ct.workingColorSpace),ne=w.colorSpace===Ws?null:Ct.getPrimaries(w.colorSpace),se=w.colorSpace===Ws||Te===ne?i.NONE:i.BROWSER_DEFAULT_WEBGL;t.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,w.flipY),t.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,w.premultiplyAlpha),t.pixelStorei(i.UNPACK_ALIGNMENT,w.unpackAlignment),t.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,se);let ge=w.isCompressedTexture||w.image[0].isCompressedTexture,B=w.image[0]&&w.image[0].isDataTexture,re=[];for(let Ne=0;Ne<6;Ne++)!ge&&!B?re[Ne]=x(w.image[Ne],!0,s.maxCubemapSize):re[Ne]=B?w.image[Ne].image:w.image[Ne],re[Ne]=$e(w,re[Ne]);let ie=re[0],Ce=r.convert(w.format,w.colorSpace),be=r.convert(w.type),Re=T(w.internalFormat,Ce,be,w.normalized,w.colorSpace),Ke=w.isVideoTexture!==!0,ut=Se.__version===void 0||fe===!0,de=ae.dataReady,qe=E(w,ie);lt(i.TEXTURE_CUBE_MAP,w);let dt;if(w.isDepthTexture){if(Re=v(w.format===Gs,w.type),ut)if(Ke)t.texStorage2D(i.TEXTURE_CUBE_MAP,1,Re,ie.width,ie.height);else for(let Ne=0;Ne<6;Ne++)t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,0,Re,ie.width,ie.height,0,Ce,be,null)}else if(ge){Ke&&ut&&t.texStorage2D(i.TEXTURE_CUBE_MAP,qe,Re,ie.width,ie.height);for(let Ne=0;Ne<6;Ne++){dt=re[Ne].mipmaps;for(let _t=0;_t<dt.length;_t++){let jt=dt[_t];w.format!==Ti?Ce!==null?Ke?de&&t.compressedTexSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,_t,0,0,jt.width,jt.height,Ce,jt.data):t.compressedTexImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,_t,Re,jt.width,jt.height,0,jt.data):it("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):Ke?de&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,_t,0,0,jt.width,jt.height,Ce,be,jt.data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,_t,Re,jt.width,jt.height,0,Ce,be,jt.data)}}}else{if(dt=w.mipmaps,Ke&&ut){dt.length>0&&qe++;let Ne=tt(re[0]);t.texStorage2D(i.TEXTURE_CUBE_MAP,qe,Re,Ne.width,Ne.height)}for(let Ne=0;Ne<6;Ne++)if(B){Ke?de&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,0,0,0,re[Ne].width,re[Ne].height,Ce,be,re[Ne].data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,0,Re,re[Ne].width,re[Ne].height,0,Ce,be,re[Ne].data);for(let _t=0;_t<dt.length;_t++){let jn=dt[_t].image[Ne].image;Ke?de&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,_t+1,0,0,jn.width,jn.height,Ce,be,jn.data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,_t+1,Re,jn.width,jn.height,0,Ce,be,jn.data)}}else{Ke?de&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,0,0,0,Ce,be,re[Ne]):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,0,Re,Ce,be,re[Ne]);for(let _t=0;_t<dt.length;_t++){let jt=dt[_t];Ke?de&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,_t+1,0,0,Ce,be,jt.image[Ne]):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,_t+1,Re,Ce,be,jt.image[Ne])}}}M(w)&&w.mipmapsAutoUpdate===!0&&_(i.TEXTURE_CUBE_MAP),Se.__version=ae.version,w.onUpdate&&w.onUpdate(w)}L.__version=w.version}function De(L,w,q,fe,ae,Se){let Te=r.convert(q.format,q.colorSpace),ne=r.convert(q.type),se=T(q.internalFormat,Te,ne,q.normalized,q.colorSpace),ge=n.get(w),B=n.get(q);if(B.__renderTarget=w,!ge.__hasExternalTextures){let re=Math.max(1,w.width>>Se),ie=Math.max(1,w.height>>Se);ae===i.TEXTURE_3D||ae===i.TEXTURE_2D_ARRAY?t.texImage3D(ae,Se,se,re,ie,w.depth,0,Te,ne,null):t.texImage2D(ae,Se,se,re,ie,0,Te,ne,null)}t.bindFramebuffer(i.FRAMEBUFFER,L),we(w)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,fe,ae,B.__webglTexture,0,ft(w)):(ae===i.TEXTURE_2D||ae>=i.TEXTURE_CUBE_MAP_POSITIVE_X&&ae<=i.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&i.framebufferTexture2D(i.FRAMEBUFFER,fe,ae,B.__webglTexture,Se),t.bindFramebuffer(i.FRAMEBUFFER,null)}function st(L,w,q){if(i.bindRenderbuffer(i.RENDERBUFFER,L),w.depthBuffer){let fe=w.depthTexture,ae=fe&&fe.isDepthTexture?fe.type:null,Se=v(w.stencilBuffer,ae),Te=w.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;we(w)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,ft(w),Se,w.width,w.height):q?i.renderbufferStorageMultisample(i.RENDERBUFFER,ft(w),Se,w.width,w.height):i.renderbufferStorage(i.RENDERBUFFER,Se,w.width,w.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,Te,i.RENDERBUFFER,L)}else{let fe=w.textures;for(let ae=0;ae<fe.length;ae++){let Se=fe[ae],Te=r.convert(Se.format,Se.colorSpace),ne=r.convert(Se.type),se=T(Se.internalFormat,Te,ne,Se.normalized,Se.colorSpace);we(w)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,ft(w),se,w.width,w.height):q?i.renderbufferStorageMultisample(i.RENDERBUFFER,ft(w),se,w.width,w.height):i.renderbufferStorage(i.RENDERBUFFER,se,w.width,w.height)}}i.bindRenderbuffer(i.RENDERBUFFER,null)}function ke(L,w,q){let fe=w.isWebGLCubeRenderTarget===!0;if(t.bindFramebuffer(i.FRAMEBUFFER,L),!(w.depthTexture&&w.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let ae=n.get(w.depthTexture);ae.__renderTarget=w;let Se=fe?w.depthTexture.image[0]:w.depthTexture.image;(!ae.__webglTexture||Se.width!==w.width||Se.height!==w.height)&&(Se.width=w.width,Se.height=w.height,w.depthTexture.needsUpdate=!0),fe?Ee(w.depthTexture,0):ye(w.depthTexture,0);let Te=ae.__webglTexture,ne=ft(w),se=fe?i.TEXTURE_CUBE_MAP_POSITIVE_X+q:i.TEXTURE_2D,ge=w.depthTexture.format===Gs?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;if(w.depthTexture.format===Fs)we(w)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ge,se,Te,0,ne):i.framebufferTexture2D(i.FRAMEBUFFER,ge,se,Te,0);else if(w.depthTexture.format===Gs)we(w)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ge,se,Te,0,ne):i.framebufferTexture2D(i.FRAMEBUFFER,ge,se,Te,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function vt(L){let w=n.get(L),q=L.isWebGLCubeRenderTarget===!0;if(w.__boundDepthTexture!==L.depthTexture){let fe=L.depthTexture;if(w.__depthDisposeCallback&&w.__depthDisposeCallback(),fe){let ae=()=>{delete w.__boundDepthTexture,delete w.__depthDisposeCallback,fe.removeEventListener("dispose",ae)};fe.addEventListener("dispose",ae),w.__depthDisposeCallback=ae}w.__boundDepthTexture=fe}if(L.depthTexture&&!w.__autoAllocateDepthBuffer)if(q)for(let fe=0;fe<6;fe++)ke(w.__webglFramebuffer[fe],L,fe);else L.texture.mipmaps.length>0?ke(w.__webglFramebuffer[0],L,0):ke(w.__webglFramebuffer,L,0);else if(q){w.__webglDepthbuffer=[];for(let fe=0;fe<6;fe++)if(t.bindFramebuffer(i.FRAMEBUFFER,w.__webglFramebuffer[fe]),w.__webglDepthbuffer[fe]===void 0)w.__webglDepthbuffer[fe]=i.createRenderbuffer(),st(w.__webglDepthbuffer[fe],L,!1);else{let ae=L.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,Se=w.__webglDepthbuffer[fe];i.bindRenderbuffer(i.RENDERBUFFER,Se),i.framebufferRenderbuffer(i.FRAMEBUFFER,ae,i.RENDERBUFFER,Se)}}else if(L.texture.mipmaps.length>0?t.bindFramebuffer(i.FRAMEBUFFER,w.__webglFramebuffer[0]):t.bindFramebuffer(i.FRAMEBUFFER,w.__webglFramebuffer),w.__webglDepthbuffer===void 0)w.__webglDepthbuffer=i.createRenderbuffer(),st(w.__webglDepthbuffer,L,!1);else{let ae=L.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,Se=w.__webglDepthbuffer;i.bindRenderbuffer(i.RENDERBUFFER,Se),i.framebufferRenderbuffer(i.FRAMEBUFFER,ae,i.RENDERBUFFER,Se)}t.bindFramebuffer(i.FRAMEBUFFER,null)}function gt(L,w,q){let fe=n.get(L);w!==void 0&&De(fe.__webglFramebuffer,L,L.texture,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,0),q!==void 0&&vt(L)}function bt(L){let w=L.texture,q=n.get(L),fe=n.get(w);L.addEventListener("dispose",k),N(L);let ae=L.textures,Se=L.isWebGLCubeRenderTarget===!0,Te=ae.length>1;if(Te||(fe.__webglTexture===void 0&&(fe.__webglTexture=i.createTexture()),fe.__version=w.version,o.memory.textures++),Se){q.__webglFramebuffer=[];for(let ne=0;ne<6;ne++)if(w.mipmaps.length>0){q.__webglFramebuffer[ne]=[];for(let se=0;se<w.mipmaps.length;se++)q.__webglFramebuffer[ne][se]=i.createFramebuffer()}else q.__webglFramebuffer[ne]=i.createFramebuffer()}else{if(w.mipmaps.length>0){q.__webglFramebuffer=[];for(let ne=0;ne<w.mipmaps.length;ne++)q.__webglFramebuffer[ne]=i.createFramebuffer()}else q.__webglFramebuffer=i.createFramebuffer();if(Te)for(let ne=0,se=ae.length;ne<se;ne++){let ge=n.get(ae[ne]);ge.__webglTexture===void 0&&(ge.__webglTexture=i.createTexture(),o.memory.textures++)}if(L.samples>0&&we(L)===!1){q.__webglMultisampledFramebuffer=i.createFramebuffer(),q.__webglColorRenderbuffer=[],t.bindFramebuffer(i.FRAMEBUFFER,q.__webglMultisampledFramebuffer);for(let ne=0;ne<ae.length;ne++){let se=ae[ne];q.__webglColorRenderbuffer[ne]=i.createRenderbuffer(),i.bindRenderbuffer(i.RENDERBUFFER,q.__webglColorRenderbuffer[ne]);let ge=r.convert(se.format,se.colorSpace),B=r.convert(se.type),re=T(se.internalFormat,ge,B,se.normalized,se.colorSpace,L.isXRRenderTarget===!0),ie=ft(L);i.renderbufferStorageMultisample(i.RENDERBUFFER,ie,re,L.width,L.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ne,i.RENDERBUFFER,q.__webglColorRenderbuffer[ne])}i.bindRenderbuffer(i.RENDERBUFFER,null),L.depthBuffer&&(q.__webglDepthRenderbuffer=i.createRenderbuffer(),st(q.__webglDepthRenderbuffer,L,!0)),t.bindFramebuffer(i.FRAMEBUFFER,null)}}if(Se){t.bindTexture(i.TEXTURE_CUBE_MAP,fe.__webglTexture),lt(i.TEXTURE_CUBE_MAP,w);for(let ne=0;ne<6;ne++)if(w.mipmaps.length>0)for(let se=0;se<w.mipmaps.length;se++)De(q.__webglFramebuffer[ne][se],L,w,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+ne,se);else De(q.__webglFramebuffer[ne],L,w,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+ne,0);M(w)?_(i.TEXTURE_CUBE_MAP):w.mipmaps.length>0&&i.texParameteri(i.TEXTURE_CUBE_MAP,i.TEXTURE_MAX_LEVEL,w.mipmaps.length-1),t.unbindTexture()}else if(Te){for(let ne=0,se=ae.length;ne<se;ne++){let ge=ae[ne],B=n.get(ge),re=i.TEXTURE_2D;(L.isWebGL3DRenderTarget||L.isWebGLArrayRenderTarget)&&(re=L.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),t.bindTexture(re,B.__webglTexture),lt(re,ge),De(q.__webglFramebuffer,L,ge,i.COLOR_ATTACHMENT0+ne,re,0),M(ge)&&_(re)}t.unbindTexture()}else{let ne=i.TEXTURE_2D;if((L.isWebGL3DRenderTarget||L.isWebGLArrayRenderTarget)&&(ne=L.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),t.bindTexture(ne,fe.__webglTexture),lt(ne,w),w.mipmaps.length>0)for(let se=0;se<w.mipmaps.length;se++)De(q.__webglFramebuffer[se],L,w,i.COLOR_ATTACHMENT0,ne,se);else De(q.__webglFramebuffer,L,w,i.COLOR_ATTACHMENT0,ne,0);M(w)?_(ne):w.mipmaps.length>0&&i.texParameteri(ne,i.TEXTURE_MAX_LEVEL,w.mipmaps.length-1),t.unbindTexture()}L.depthBuffer&&vt(L)}function O(L){let w=L.textures;for(let q=0,fe=w.length;q<fe;q++){let ae=w[q];if(M(ae)&&ae.mipmapsAutoUpdate===!0){let Se=C(L),Te=n.get(ae).__webglTexture;t.bindTexture(Se,Te),_(Se),t.unbindTexture()}}}let Me=[];function Xe(L){if(L.samples>0){if(we(L)===!1){let w=L.textures,q=L.width,fe=L.height,ae=i.COLOR_BUFFER_BIT,Se=L.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,Te=n.get(L),ne=w.length>1;if(ne)for(let ge=0;ge<w.length;ge++)t.bindFramebuffer(i.FRAMEBUFFER,Te.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ge,i.RENDERBUFFER,null),t.bindFramebuffer(i.FRAMEBUFFER,Te.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+ge,i.TEXTURE_2D,null,0);t.bindFramebuffer(i.READ_FRAMEBUFFER,Te.__webglMultisampledFramebuffer),L.texture.mipmaps.length>0?t.bindFramebuffer(i.DRAW_FRAMEBUFFER,Te.__webglFramebuffer[0]):t.bindFramebuffer(i.DRAW_FRAMEBUFFER,Te.__webglFramebuffer);for(let ge=0;ge<w.length;ge++){if(L.resolveDepthBuffer&&(L.depthBuffer&&(ae|=i.DEPTH_BUFFER_BIT),L.stencilBuffer&&L.resolveStencilBuffer&&(ae|=i.STENCIL_BUFFER_BIT)),ne){i.framebufferRenderbuffer(i.READ_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.RENDERBUFFER,Te.__webglColorRenderbuffer[ge]);let B=n.get(w[ge]).__webglTexture;i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,B,0)}i.blitFramebuffer(0,0,q,fe,0,0,q,fe,ae,i.NEAREST),l===!0&&(Me.length=0,Me.push(i.COLOR_ATTACHMENT0+ge),L.depthBuffer&&L.storeMultisampledDepthBuffer===!1&&Me.push(Se),i.invalidateFramebuffer(i.READ_FRAMEBUFFER,Me))}if(t.bindFramebuffer(i.READ_FRAMEBUFFER,null),t.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),ne)for(let ge=0;ge<w.length;ge++){t.bindFramebuffer(i.FRAMEBUFFER,Te.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ge,i.RENDERBUFFER,Te.__webglColorRenderbuffer[ge]);let B=n.get(w[ge]).__webglTexture;t.bindFramebuffer(i.FRAMEBUFFER,Te.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+ge,i.TEXTURE_2D,B,0)}t.bindFramebuffer(i.DRAW_FRAMEBUFFER,Te.__webglMultisampledFramebuffer)}else if(L.depthBuffer&&L.storeMultisampledDepthBuffer===!1&&l){let w=L.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,[w])}}}function ft(L){return Math.min(s.maxSamples,L.samples)}function we(L){let w=n.get(L);return L.samples>0&&e.has("WEBGL_multisampled_render_to_texture")===!0&&w.__useRenderToTexture!==!1}function zt(L){let w=o.render.frame;h.get(L)!==w&&(h.set(L,w),L.update())}function $e(L,w){let q=L.colorSpace,fe=L.format,ae=L.type;return L.isCompressedTexture===!0||L.isVideoTexture===!0||q!==Aa&&q!==Ws&&(Ct.getTransfer(q)===Vt?(fe!==Ti||ae!==yi)&&it("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):ht("WebGLTextures: Unsupported texture color space:",q)),w}function tt(L){return typeof HTMLImageElement<"u"&&L instanceof HTMLImageElement?(c.width=L.naturalWidth||L.width,c.height=L.naturalHeight||L.height):typeof VideoFrame<"u"&&L instanceof VideoFrame?(c.width=L.displayWidth,c.height=L.displayHeight):(c.width=L.width,c.height=L.height),c}this.allocateTextureUnit=he,this.resetTextureUnits=Q,this.getTextureUnits=te,this.setTextureUnits=pe,this.setTexture2D=ye,this.setTexture2DArray=ve,this.setTexture3D=Le,this.setTextureCube=Ee,this.rebindTextures=gt,this.setupRenderTarget=bt,this.updateRenderTargetMipmap=O,this.updateMultisampleRenderTarget=Xe,this.setupDepthRenderbuffer=vt,this.setupFrameBufferTexture=De,this.useMultisampledRTT=we,this.dispose=z}function PT(i,e){function t(n,s=Ws){let r,o=Ct.getTransfer(s);if(n===yi)return i.UNSIGNED_BYTE;if(n===xh)return i.UNSIGNED_SHORT_4_4_4_4;if(n===vh)return i.UNSIGNED_SHORT_5_5_5_1;if(n===Gf)return i.UNSIGNED_INT_5_9_9_9_REV;if(n===Wf)return i.UNSIGNED_INT_10F_11F_11F_REV;if(n===zf)return i.BYTE;if(n===Vf)return i.SHORT;if(n===Ho)return i.UNSIGNED_SHORT;if(n===yh)return i.INT;if(n===zi)return i.UNSIGNED_INT;if(n===pi)return i.FLOAT;if(n===ji)return i.HALF_FLOAT;if(n===Xf)return i.ALPHA;if(n===qf)return i.RGB;if(n===Ti)return i.RGBA;if(n===Fs)return i.DEPTH_COMPONENT;if(n===Gs)return i.DEPTH_STENCIL;if(n===_h)return i.RED;if(n===pl)return i.RED_INTEGER;if(n===yr)return i.RG;if(n===bh)return i.RG_INTEGER;if(n===Mh)return i.RGBA_INTEGER;if(n===ml||n===gl||n===yl||n===xl)if(o===Vt)if(r=e.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(n===ml)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===gl)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===yl)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===xl)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=e.get("WEBGL_compressed_texture_s3tc"),r!==null){if(n===ml)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===gl)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===yl)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===xl)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===Sh||n===Eh||n===wh||n===Th)if(r=e.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(n===Sh)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===Eh)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===wh)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===Th)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===Ah||n===Rh||n===Ch||n===Ph||n===Ih||n===vl||n===Lh)if(r=e.get("WEBGL_compressed_texture_etc"),r!==null){if(n===Ah||n===Rh)return o===Vt?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(n===Ch)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(n===Ph)return r.COMPRESSED_R11_EAC;if(n===Ih)return r.COMPRESSED_SIGNED_R11_EAC;if(n===vl)return r.COMPRESSED_RG11_EAC;if(n===Lh)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(n===Dh||n===Nh||n===Fh||n===Uh||n===Oh||n===Bh||n===kh||n===Hh||n===zh||n===Vh||n===Gh||n===Wh||n===Xh||n===qh)if(r=e.get("WEBGL_compressed_texture_astc"),r!==null){if(n===Dh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===Nh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===Fh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===Uh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===Oh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===Bh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===kh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===Hh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===zh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===Vh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===Gh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===Wh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===Xh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===qh)return o===Vt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===Yh||n===$h||n===Zh)if(r=e.get("EXT_texture_compression_bptc"),r!==null){if(n===Yh)return o===Vt?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===$h)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===Zh)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===Jh||n===Kh||n===_l||n===jh)if(r=e.get("EXT_texture_compression_rgtc"),r!==null){if(n===Jh)return r.COMPRESSED_RED_RGTC1_EXT;if(n===Kh)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===_l)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===jh)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===Ur?i.UNSIGNED_INT_24_8:i[n]!==void 0?i[n]:null}return{convert:t}}var IT=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,LT=`
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

}`,mp=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(e,t){if(this.texture===null){let n=new Ha(e.texture);(e.depthNear!==t.depthNear||e.depthFar!==t.depthFar)&&(this.depthNear=e.depthNear,this.depthFar=e.depthFar),this.texture=n}}getMesh(e){if(this.texture!==null&&this.mesh===null){let t=e.cameras[0].viewport,n=new ki({vertexShader:IT,fragmentShader:LT,uniforms:{depthColor:{value:this.texture},depthWidth:{value:t.z},depthHeight:{value:t.w}}});this.mesh=new St(new ks(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},gp=class extends Ji{constructor(e,t){super();let n=this,s=null,r=1,o=null,a="local-floor",l=1,c=null,h=null,u=null,d=null,f=null,p=null,y=typeof XRWebGLBinding<"u",g=new mp,m={},x=t.getContextAttributes(),M=null,_=null,C=[],T=[],v=new ue,E=null,N=null,P=new ri;P.viewport=new Gt;let I=new ri;I.viewport=new Gt;let k=[P,I],V=new fh,F=null,z=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(ee){let ye=C[ee];return ye===void 0&&(ye=new Po,C[ee]=ye),ye.getTargetRaySpace()},this.getControllerGrip=function(ee){let ye=C[ee];return ye===void 0&&(ye=new Po,C[ee]=ye),ye.getGripSpace()},this.getHand=function(ee){let ye=C[ee];return ye===void 0&&(ye=new Po,C[ee]=ye),ye.getHandSpace()};function Y(ee){let ye=T.indexOf(ee.inputSource);if(ye===-1)return;let ve=C[ye];ve!==void 0&&(ve.update(ee.inputSource,ee.frame,c||o),ve.dispatchEvent({type:ee.type,data:ee.inputSource}))}function G(){s.removeEventListener("select",Y),s.removeEventListener("selectstart",Y),s.removeEventListener("selectend",Y),s.removeEventListener("squeeze",Y),s.removeEventListener("squeezestart",Y),s.removeEventListener("squeezeend",Y),s.removeEventListener("end",G),s.removeEventListener("inputsourceschange",ce);for(let ee=0;ee<C.length;ee++){let ye=T[ee];ye!==null&&(T[ee]=null,C[ee].disconnect(ye))}F=null,z=null,g.reset();for(let ee in m)delete m[ee];if(e.setRenderTarget(M),f=null,d=null,u=null,s=null,_=null,he.stop(),n.isPresenting=!1,e.setPixelRatio(E),e.setSize(v.width,v.height,!1),N!==null){let ee=N.camera;ee.fov=N.fov,ee.zoom=N.zoom,ee.updateProjectionMatrix(),N=null}n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(ee){r=ee,n.isPresenting===!0&&it("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(ee){a=ee,n.isPresenting===!0&&it("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(ee){c=ee},this.getBaseLayer=function(){return d!==null?d:f},this.getBinding=function(){return u===null&&y&&(u=new XRWebGLBinding(s,t)),u},this.getFrame=function(){return p},this.getSession=function(){return s},this.setSession=async function(ee){if(s=ee,s!==null){if(M=e.getRenderTarget(),s.addEventListener("select",Y),s.addEventListener("selectstart",Y),s.addEventListener("selectend",Y),s.addEventListener("squeeze",Y),s.addEventListener("squeezestart",Y),s.addEventListener("squeezeend",Y),s.addEventListener("end",G),s.addEventListener("inputsourceschange",ce),x.xrCompatible!==!0&&await t.makeXRCompatible(),E=e.getPixelRatio(),e.getSize(v),y&&"createProjectionLayer"in XRWebGLBinding.prototype){let ve=null,Le=null,Ee=null;x.depth&&(Ee=x.stencil?t.DEPTH24_STENCIL8:t.DEPTH_COMPONENT24,ve=x.stencil?Gs:Fs,Le=x.stencil?Ur:zi);let Ve={colorFormat:t.RGBA8,depthFormat:Ee,scaleFactor:r};u=this.getBinding(),d=u.createProjectionLayer(Ve),s.updateRenderState({layers:[d]}),e.setPixelRatio(1),e.setSize(d.textureWidth,d.textureHeight,!1),_=new Ai(d.textureWidth,d.textureHeight,{format:Ti,type:yi,depthTexture:new Bs(d.textureWidth,d.textureHeight,Le,void 0,void 0,void 0,void 0,void 0,void 0,ve),stencilBuffer:x.stencil,colorSpace:e.outputColorSpace,samples:x.antialias?4:0,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}else{let ve={antialias:x.antialias,alpha:!0,depth:x.depth,stencil:x.stencil,framebufferScaleFactor:r};f=new XRWebGLLayer(s,t,ve),s.updateRenderState({baseLayer:f}),e.setPixelRatio(1),e.setSize(f.framebufferWidth,f.framebufferHeight,!1),_=new Ai(f.framebufferWidth,f.framebufferHeight,{format:Ti,type:yi,colorSpace:e.outputColorSpace,stencilBuffer:x.stencil,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}_.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await s.requestReferenceSpace(a),he.setContext(s),he.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return g.getDepthTexture()};function ce(ee){for(let ye=0;ye<ee.removed.length;ye++){let ve=ee.removed[ye],Le=T.indexOf(ve);Le>=0&&(T[Le]=null,C[Le].disconnect(ve))}for(let ye=0;ye<ee.added.length;ye++){let ve=ee.added[ye],Le=T.indexOf(ve);if(Le===-1){for(let Ve=0;Ve<C.length;Ve++)if(Ve>=T.length){T.push(ve),Le=Ve;break}else if(T[Ve]===null){T[Ve]=ve,Le=Ve;break}if(Le===-1)break}let Ee=C[Le];Ee&&Ee.connect(ve)}}function J(ee,ye){ye===null?ee.matrixWorld.copy(ee.matrix):ee.matrixWorld.multiplyMatrices(ye.matrixWorld,ee.matrix),ee.matrixWorldInverse.copy(ee.matrixWorld).invert()}this.updateCamera=function(ee){if(s===null)return;let ye=ee.near,ve=ee.far;g.texture!==null&&(g.depthNear>0&&(ye=g.depthNear),g.depthFar>0&&(ve=g.depthFar)),V.near=I.near=P.near=ye,V.far=I.far=P.far=ve,(F!==V.near||z!==V.far)&&(s.updateRenderState({depthNear:V.near,depthFar:V.far}),F=V.near,z=V.far),V.layers.mask=ee.layers.mask|6,P.layers.mask=V.layers.mask&-5,I.layers.mask=V.layers.mask&-3;let Le=ee.parent,Ee=V.cameras;J(V,Le);for(let Ve=0;Ve<Ee.length;Ve++)J(Ee[Ve],Le);V.projectionMatrix.copy(P.projectionMatrix),V.projectionMatrixInverse.copy(P.projectionMatrixInverse),N===null&&ee.isPerspectiveCamera&&(N={camera:ee,fov:ee.fov,zoom:ee.zoom}),Q(ee,V,Le)};function Q(ee,ye,ve){ve===null?ee.matrix.copy(ye.matrixWorld):(ee.matrix.copy(ve.matrixWorld),ee.matrix.invert(),ee.matrix.multiply(ye.matrixWorld)),ee.matrix.decompose(ee.position,ee.quaternion,ee.scale),ee.updateMatrixWorld(!0),ee.projectionMatrix.copy(ye.projectionMatrix),ee.projectionMatrixInverse.copy(ye.projectionMatrixInverse),ee.isPerspectiveCamera&&(ee.fov=Ao*2*Math.atan(1/ee.projectionMatrix.elements[5]),ee.zoom=1)}this.getCamera=function(){return V},this.getFoveation=function(){if(!(d===null&&f===null))return l},this.setFoveation=function(ee){l=ee,d!==null&&(d.fixedFoveation=ee),f!==null&&f.fixedFoveation!==void 0&&(f.fixedFoveation=ee)},this.hasDepthSensing=function(){return g.texture!==null},this.getDepthSensingMesh=function(){return g.getMesh(V)},this.getCameraTexture=function(ee){return m[ee]};let te=null;function pe(ee,ye){if(h=ye.getViewerPose(c||o),p=ye,h!==null){let ve=h.views;f!==null&&(e.setRenderTargetFramebuffer(_,f.framebuffer),e.setRenderTarget(_));let Le=!1;ve.length!==V.cameras.length&&(V.cameras.length=0,Le=!0);for(let Je=0;Je<ve.length;Je++){let lt=ve[Je],rt=null;if(f!==null)rt=f.getViewport(lt);else{let _e=u.getViewSubImage(d,lt);rt=_e.viewport,Je===0&&(e.setRenderTargetTextures(_,_e.colorTexture,_e.depthStencilTexture),e.setRenderTarget(_))}let oe=k[Je];oe===void 0&&(oe=new ri,oe.layers.enable(Je),oe.viewport=new Gt,k[Je]=oe),oe.matrix.fromArray(lt.transform.matrix),oe.matrix.decompose(oe.position,oe.quaternion,oe.scale),oe.projectionMatrix.fromArray(lt.projectionMatrix),oe.projectionMatrixInverse.copy(oe.projectionMatrix).invert(),oe.viewport.set(rt.x,rt.y,rt.width,rt.height),Je===0&&(V.matrix.copy(oe.matrix),V.matrix.decompose(V.position,V.quaternion,V.scale)),Le===!0&&V.cameras.push(oe)}let Ee=s.enabledFeatures;if(Ee&&Ee.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&y){u=n.getBinding();let Je=u.getDepthInformation(ve[0]);Je&&Je.isValid&&Je.texture&&g.init(Je,s.renderState)}if(Ee&&Ee.includes("camera-access")&&y){e.state.unbindTexture(),u=n.getBinding();for(let Je=0;Je<ve.length;Je++){let lt=ve[Je].camera;if(lt){let rt=m[lt];rt||(rt=new Ha,m[lt]=rt);let oe=u.getCameraImage(lt);rt.sourceTexture=oe}}}}for(let ve=0;ve<C.length;ve++){let Le=T[ve],Ee=C[ve];Le!==null&&Ee!==void 0&&Ee.update(Le,ye,c||o)}te&&te(ee,ye),ye.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:ye}),p=null}let he=new $0;he.setAnimationLoop(pe),this.setAnimationLoop=function(ee){te=ee},this.dispose=function(){}}},DT=new Qe,sy=new yt;sy.set(-1,0,0,0,1,0,0,0,1);function NT(i,e){function t(g,m){g.matrixAutoUpdate===!0&&g.updateMatrix(),m.value.copy(g.matrix)}function n(g,m){m.color.getRGB(g.fogColor.value,ip(i)),m.isFog?(g.fogNear.value=m.near,g.fogFar.value=m.far):m.isFogExp2&&(g.fogDensity.value=m.density)}function s(g,m,x,M,_){m.isNodeMaterial?m.uniformsNeedUpdate=!1:m.isMeshBasicMaterial?r(g,m):m.isMeshLambertMaterial?(r(g,m),m.envMap&&(g.envMapIntensity.value=m.envMapIntensity)):m.isMeshToonMaterial?(r(g,m),u(g,m)):m.isMeshPhongMaterial?(r(g,m),h(g,m),m.envMap&&(g.envMapIntensity.value=m.envMapIntensity)):m.isMeshStandardMaterial?(r(g,m),d(g,m),m.isMeshPhysicalMaterial&&f(g,m,_)):m.isMeshMatcapMaterial?(r(g,m),p(g,m)):m.isMeshDepthMaterial?r(g,m):m.isMeshDistanceMaterial?(r(g,m),y(g,m)):m.isMeshNormalMaterial?r(g,m):m.isLineBasicMaterial?(o(g,m),m.isLineDashedMaterial&&a(g,m)):m.isPointsMaterial?l(g,m,x,M):m.isSpriteMaterial?c(g,m):m.isShadowMaterial?(g.color.value.copy(m.color),g.opacity.value=m.opacity):m.isShaderMaterial&&(m.uniformsNeedUpdate=!1)}function r(g,m){g.opacity.value=m.opacity,m.color&&g.diffuse.value.copy(m.color),m.emissive&&g.emissive.value.copy(m.emissive).multiplyScalar(m.emissiveIntensity),m.map&&(g.map.value=m.map,t(m.map,g.mapTransform)),m.alphaMap&&(g.alphaMap.value=m.alphaMap,t(m.alphaMap,g.alphaMapTransform)),m.bumpMap&&(g.bumpMap.value=m.bumpMap,t(m.bumpMap,g.bumpMapTransform),g.bumpScale.value=m.bumpScale,m.side===li&&(g.bumpScale.value*=-1)),m.normalMap&&(g.normalMap.value=m.normalMap,t(m.normalMap,g.normalMapTransform),g.normalScale.value.copy(m.normalScale),m.side===li&&g.normalScale.value.negate()),m.displacementMap&&(g.displacementMap.value=m.displacementMap,t(m.displacementMap,g.displacementMapTransform),g.displacementScale.value=m.displacementScale,g.displacementBias.value=m.displacementBias),m.emissiveMap&&(g.emissiveMap.value=m.emissiveMap,t(m.emissiveMap,g.emissiveMapTransform)),m.specularMap&&(g.specularMap.value=m.specularMap,t(m.specularMap,g.specularMapTransform)),m.alphaTest>0&&(g.alphaTest.value=m.alphaTest);let x=e.get(m),M=x.envMap,_=x.envMapRotation;M&&(g.envMap.value=M,g.envMapRotation.value.setFromMatrix4(DT.makeRotationFromEuler(_)).transpose(),M.isCubeTexture&&M.isRenderTargetTexture===!1&&g.envMapRotation.value.premultiply(sy),g.reflectivity.value=m.reflectivity,g.ior.value=m.ior,g.refractionRatio.value=m.refractionRatio),m.lightMap&&(g.lightMap.value=m.lightMap,g.lightMapIntensity.value=m.lightMapIntensity,t(m.lightMap,g.lightMapTransform)),m.aoMap&&(g.aoMap.value=m.aoMap,g.aoMapIntensity.value=m.aoMapIntensity,t(m.aoMap,g.aoMapTransform))}function o(g,m){g.diffuse.value.copy(m.color),g.opacity.value=m.opacity,m.map&&(g.map.value=m.map,t(m.map,g.mapTransform))}function a(g,m){g.dashSize.value=m.dashSize,g.totalSize.value=m.dashSize+m.gapSize,g.scale.value=m.scale}function l(g,m,x,M){g.diffuse.value.copy(m.color),g.opacity.value=m.opacity,g.size.value=m.size*x,g.scale.value=M*.5,m.map&&(g.map.value=m.map,t(m.map,g.uvTransform)),m.alphaMap&&(g.alphaMap.value=m.alphaMap,t(m.alphaMap,g.alphaMapTransform)),m.alphaTest>0&&(g.alphaTest.value=m.alphaTest)}function c(g,m){g.diffuse.value.copy(m.color),g.opacity.value=m.opacity,g.rotation.value=m.rotation,m.map&&(g.map.value=m.map,t(m.map,g.mapTransform)),m.alphaMap&&(g.alphaMap.value=m.alphaMap,t(m.alphaMap,g.alphaMapTransform)),m.alphaTest>0&&(g.alphaTest.value=m.alphaTest)}function h(g,m){g.specular.value.copy(m.specular),g.shininess.value=Math.max(m.shininess,1e-4)}function u(g,m){m.gradientMap&&(g.gradientMap.value=m.gradientMap)}function d(g,m){g.metalness.value=m.metalness,m.metalnessMap&&(g.metalnessMap.value=m.metalnessMap,t(m.metalnessMap,g.metalnessMapTransform)),g.roughness.value=m.roughness,m.roughnessMap&&(g.roughnessMap.value=m.roughnessMap,t(m.roughnessMap,g.roughnessMapTransform)),m.envMap&&(g.envMapIntensity.value=m.envMapIntensity)}function f(g,m,x){g.ior.value=m.ior,m.diffuseRoughness>0&&(g.diffuseRoughness.value=m.diffuseRoughness,m.diffuseRoughnessMap&&(g.diffuseRoughnessMap.value=m.diffuseRoughnessMap,t(m.diffuseRoughnessMap,g.diffuseRoughnessMapTransform))),m.sheen>0&&(g.sheenColor.value.copy(m.sheenColor).multiplyScalar(m.sheen),g.sheenRoughness.value=m.sheenRoughness,m.sheenColorMap&&(g.sheenColorMap.value=m.sheenColorMap,t(m.sheenColorMap,g.sheenColorMapTransform)),m.sheenRoughnessMap&&(g.sheenRoughnessMap.value=m.sheenRoughnessMap,t(m.sheenRoughnessMap,g.sheenRoughnessMapTransform))),m.clearcoat>0&&(g.clearcoat.value=m.clearcoat,g.clearcoatRoughness.value=m.clearcoatRoughness,m.clearcoatMap&&(g.clearcoatMap.value=m.clearcoatMap,t(m.clearcoatMap,g.clearcoatMapTransform)),m.clearcoatRoughnessMap&&(g.clearcoatRoughnessMap.value=m.clearcoatRoughnessMap,t(m.clearcoatRoughnessMap,g.clearcoatRoughnessMapTransform)),m.clearcoatNormalMap&&(g.clearcoatNormalMap.value=m.clearcoatNormalMap,t(m.clearcoatNormalMap,g.clearcoatNormalMapTransform),g.clearcoatNormalScale.value.copy(m.clearcoatNormalScale),m.side===li&&g.clearcoatNormalScale.value.negate())),m.dispersion>0&&(g.dispersion.value=m.dispersion),m.retroreflectivity>0&&(g.retroreflectivity.value=m.retroreflectivity),m.iridescence>0&&(g.iridescence.value=m.iridescence,g.iridescenceIOR.value=m.iridescenceIOR,g.iridescenceThicknessMinimum.value=m.iridescenceThicknessMinimum,g.iridescenceThicknessMaximum.value=m.iridescenceThicknessMaximum,m.iridescenceMap&&(g.iridescenceMap.value=m.iridescenceMap,t(m.iridescenceMap,g.iridescenceMapTransform)),m.iridescenceThicknessMap&&(g.iridescenceThicknessMap.value=m.iridescenceThicknessMap,t(m.iridescenceThicknessMap,g.iridescenceThicknessMapTransform))),m.transmission>0&&(g.transmission.value=m.transmission,g.transmissionSamplerMap.value=x.texture,g.transmissionSamplerSize.value.set(x.width,x.height),m.transmissionMap&&(g.transmissionMap.value=m.transmissionMap,t(m.transmissionMap,g.transmissionMapTransform)),g.thickness.value=m.thickness,m.thicknessMap&&(g.thicknessMap.value=m.thicknessMap,t(m.thicknessMap,g.thicknessMapTransform)),g.attenuationDistance.value=m.attenuationDistance,g.attenuationColor.value.copy(m.attenuationColor)),m.anisotropy>0&&(g.anisotropyVector.value.set(m.anisotropy*Math.cos(m.anisotropyRotation),m.anisotropy*Math.sin(m.anisotropyRotation)),m.anisotropyMap&&(g.anisotropyMap.value=m.anisotropyMap,t(m.anisotropyMap,g.anisotropyMapTransform))),g.specularIntensity.value=m.specularIntensity,g.specularColor.value.copy(m.specularColor),m.specularColorMap&&(g.specularColorMap.value=m.specularColorMap,t(m.specularColorMap,g.specularColorMapTransform)),m.specularIntensityMap&&(g.specularIntensityMap.value=m.specularIntensityMap,t(m.specularIntensityMap,g.specularIntensityMapTransform))}function p(g,m){m.matcap&&(g.matcap.value=m.matcap)}function y(g,m){let x=e.get(m).light;g.referencePosition.value.setFromMatrixPosition(x.matrixWorld),g.nearDistance.value=x.shadow.camera.near,g.farDistance.value=x.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:s}}function FT(i,e,t,n){let s={},r={};function o(x,M){let _=M.program;n.uniformBlockBinding(x,_,s[x.id])}function a(x,M){let _=s[x.id];_===void 0&&(p(x),_=l(x),s[x.id]=_,x.addEventListener("dispose",g));let C=M.program;n.updateUBOMapping(x,C);let T=e.render.frame;r[x.id]!==T&&(c(x),r[x.id]=T)}function l(x){let M=i.createBuffer(),_=x.__size,C=x.usage;return i.bindBuffer(i.UNIFORM_BUFFER,M),i.bufferData(i.UNIFORM_BUFFER,_,C),i.bindBuffer(i.UNIFORM_BUFFER,null),M}function c(x){let M=s[x.id],_=x.uniforms,C=x.__cache;i.bindBuffer(i.UNIFORM_BUFFER,M);for(let T=0,v=_.length;T<v;T++){let E=_[T];if(Array.isArray(E))for(let N=0,P=E.length;N<P;N++)h(E[N],T,N,C);else h(E,T,0,C)}i.bindBuffer(i.UNIFORM_BUFFER,null)}function h(x,M,_,C){if(d(x,M,_,C)===!0){let T=x.__offset,v=x.value;if(Array.isArray(v)){let E=0;for(let N=0;N<v.length;N++){let P=v[N],I=y(P,!0);u(P,x.__data,E),E+=I.storage/Float32Array.BYTES_PER_ELEMENT}}else u(v,x.__data,0);i.bufferSubData(i.UNIFORM_BUFFER,T,x.__data)}}function u(x,M,_){typeof x=="number"||typeof x=="boolean"?M[_]=x:x.isMatrix3?(M[_]=x.elements[0],M[_+1]=x.elements[1],M[_+2]=x.elements[2],M[_+3]=0,M[_+4]=x.elements[3],M[_+5]=x.elements[4],M[_+6]=x.elements[5],M[_+7]=0,M[_+8]=x.elements[6],M[_+9]=x.elements[7],M[_+10]=x.elements[8],M[_+11]=0):ArrayBuffer.isView(x)?M.set(x.subarray(0,M.length-_),_):x.toArray(M,_)}function d(x,M,_,C){let T=x.value,v=M+"_"+_;if(Array.isArray(T)){C[v]===void 0&&(C[v]=[]);let E=C[v],N=!1;for(let P=0;P<T.length;P++)f(T[P],E,P)===!0&&(N=!0);return N}return f(T,C,v)}function f(x,M,_){if(M[_]===void 0)return typeof x=="number"||typeof x=="boolean"?M[_]=x:ArrayBuffer.isView(x)?M[_]=x.slice():M[_]=x.clone(),!0;{let C=M[_];if(typeof x=="number"||typeof x=="boolean"){if(C!==x)return M[_]=x,!0}else{if(ArrayBuffer.isView(x))return!0;if(C.equals(x)===!1)return C.copy(x),!0}}return!1}function p(x){let M=x.uniforms,_=0,C=16;for(let v=0,E=M.length;v<E;v++){let N=Array.isArray(M[v])?M[v]:[M[v]];for(let P=0,I=N.length;P<I;P++){let k=N[P],V=Array.isArray(k.value)?k.value:[k.value],F=Array.isArray(M[v])||Array.isArray(k.value),z=_;for(let G=0,ce=V.length;G<ce;G++){let J=V[G],Q=y(J,F),te=_%C,pe=te%Q.boundary,he=te+pe;_+=pe,he!==0&&C-he<Q.storage&&(_+=C-he),G===0&&(z=_),_+=Q.storage}let Y=k.type==="int"?Int32Array:k.type==="uint"?Uint32Array:Float32Array;k.__data=new Y((_-z)/Float32Array.BYTES_PER_ELEMENT),k.__offset=z}}let T=_%C;return T>0&&(_+=C-T),x.__size=_,x.__cache={},this}function y(x,M){let _={boundary:0,storage:0};return typeof x=="number"||typeof x=="boolean"?(_.boundary=4,_.storage=4):x.isVector2?(_.boundary=8,_.storage=8):x.isVector3||x.isColor?(_.boundary=16,_.storage=12):x.isVector4?(_.boundary=16,_.storage=16):x.isMatrix3?(_.boundary=16,_.storage=48):x.isMatrix4?(_.boundary=16,_.storage=64):x.isTexture?it("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(x)?(_.boundary=16,_.storage=x.byteLength):it("WebGLRenderer: Unsupported uniform value type.",x),M===!0&&(_.boundary=16,_.storage=Math.ceil(_.storage/16)*16),_}function g(x){let M=x.target;M.removeEventListener("dispose",g),i.deleteBuffer(s[M.id]),delete s[M.id],delete r[M.id]}function m(){for(let x in s)i.deleteBuffer(s[x]);s={},r={}}return{bind:o,update:a,dispose:m}}var UT=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),ms=null;function OT(){return ms===null&&(ms=new or(UT,16,16,yr,ji),ms.name="DFG_LUT",ms.minFilter=oi,ms.magFilter=oi,ms.wrapS=ds,ms.wrapT=ds,ms.generateMipmaps=!1,ms.needsUpdate=!0),ms}var iu=class{constructor(e={}){let{canvas:t=g0(),context:n=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:d=!1,outputBufferType:f=yi}=e;this.isWebGLRenderer=!0;let p;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");p=n.getContextAttributes().alpha}else p=o;let y=f,g=new Set([Mh,bh,pl]),m=new Set([yi,zi,Ho,Ur,xh,vh]),x=new Uint32Array(4),M=new Int32Array(4),_={textures:[],min:[],max:[],resolution:[]},C=null,T=null,v=[],E=[],N=null;this.domElement=t,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=Hi,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let P=this,I=!1,k=null,V=null,F=null,z=null;this._outputColorSpace=wi;let Y=0,G=0,ce=null,J=-1,Q=null,te=new Gt,pe=new Gt,he=null,ee=new et(0),ye=0,ve=t.width,Le=t.height,Ee=1,Ve=null,at=null,Je=new Gt(0,0,ve,Le),lt=new Gt(0,0,ve,Le),rt=!1,oe=new Us,_e=new Ua,xe=!1,Be=!1,De=new Qe,st=new S,ke=new Gt,vt={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},gt=!1;function bt(){return ce===null?Ee:1}let O=n;function Me(R,H){return t.getContext(R,H)}let Xe,ft,we,zt,$e,tt,L,w,q,fe,ae,Se,Te,ne,se,ge,B,re,ie,Ce,be,Re,Ke;try{let R={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in t&&t.setAttribute("data-engine",`three.js r${"187"}`),t.addEventListener("webglcontextlost",qe,!1),t.addEventListener("webglcontextrestored",dt,!1),t.addEventListener("webglcontextcreationerror",Ne,!1),O===null){let H="webgl2";if(O=Me(H,R),O===null)throw Me(H)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}ut()}catch(R){throw t.removeEventListener("webglcontextlost",qe,!1),t.removeEventListener("webglcontextrestored",dt,!1),t.removeEventListener("webglcontextcreationerror",Ne,!1),ht("WebGLRenderer: "+R.message),R}function ut(){Xe=new $E(O),Xe.init(),be=new PT(O,Xe),ft=new OE(O,Xe,e,be),we=new RT(O,Xe),ft.reversedDepthBuffer&&d&&we.buffers.depth.setReversed(!0),V=O.createFramebuffer(),F=O.createFramebuffer(),z=O.createFramebuffer(),zt=new KE(O),$e=new pT,tt=new CT(O,Xe,we,$e,ft,be,zt),L=new YE(P),w=new Qb(O),Re=new FE(O,w),q=new ZE(O,w,zt,Re),fe=new QE(O,q,w,Re,zt),re=new jE(O,ft,tt),se=new BE($e),ae=new fT(P,L,Xe,ft,Re,se),Se=new NT(P,$e),Te=new gT,ne=new MT(Xe),B=new NE(P,L,we,fe,p,l),ge=new AT(P,fe,ft),Ke=new FT(O,zt,ft,we),ie=new UE(O,Xe,zt),Ce=new JE(O,Xe,zt),zt.programs=ae.programs,P.capabilities=ft,P.extensions=Xe,P.properties=$e,P.renderLists=Te,P.shadowMap=ge,P.state=we,P.info=zt}y!==yi&&(N=new tw(y,t.width,t.height,a,s,r));let de=new gp(P,O);this.xr=de,this.getContext=function(){return O},this.getContextAttributes=function(){return O.getContextAttributes()},this.forceContextLoss=function(){let R=Xe.get("WEBGL_lose_context");R&&R.loseContext()},this.forceContextRestore=function(){let R=Xe.get("WEBGL_lose_context");R&&R.restoreContext()},this.getPixelRatio=function(){return Ee},this.setPixelRatio=function(R){R!==void 0&&(Ee=R,this.setSize(ve,Le,!1))},this.getSize=function(R){return R.set(ve,Le)},this.setSize=function(R,H,j=!0){if(de.isPresenting){it("WebGLRenderer: Can't change size while VR device is presenting.");return}ve=R,Le=H,t.width=Math.floor(R*Ee),t.height=Math.floor(H*Ee),j===!0&&(t.style.width=R+"px",t.style.height=H+"px"),N!==null&&N.setSize(t.width,t.height),this.setViewport(0,0,R,H)},this.getDrawingBufferSize=function(R){return R.set(ve*Ee,Le*Ee).floor()},this.setDrawingBufferSize=function(R,H,j){ve=R,Le=H,Ee=j,t.width=Math.floor(R*j),t.height=Math.floor(H*j),this.setViewport(0,0,R,H)},this.setEffects=function(R){if(y===yi){ht("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(R){for(let H=0;H<R.length;H++)if(R[H].isOutputPass===!0){it("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}N.setEffects(R||[])},this.getCurrentViewport=function(R){return R.copy(te)},this.getViewport=function(R){return R.copy(Je)},this.setViewport=function(R,H,j,$){R.isVector4?Je.set(R.x,R.y,R.z,R.w):Je.set(R,H,j,$),we.viewport(te.copy(Je).multiplyScalar(bt()).round())},this.getScissor=function(R){return R.copy(lt)},this.setScissor=function(R,H,j,$){R.isVector4?lt.set(R.x,R.y,R.z,R.w):lt.set(R,H,j,$),we.scissor(pe.copy(lt).multiplyScalar(bt()).round())},this.getScissorTest=function(){return rt},this.setScissorTest=function(R){we.setScissorTest(rt=R)},this.setOpaqueSort=function(R){Ve=R},this.setTransparentSort=function(R){at=R},this.getClearColor=function(R){return R.copy(B.getClearColor())},this.setClearColor=function(){B.setClearColor(...arguments)},this.getClearAlpha=function(){return B.getClearAlpha()},this.setClearAlpha=function(){B.setClearAlpha(...arguments)},this.clear=function(R=!0,H=!0,j=!0){let $=0;if(R){let Z=!1;if(ce!==null){let Pe=ce.texture.format;Z=g.has(Pe)}if(Z){let Pe=ce.texture.type,Ue=m.has(Pe),Ie=B.getClearColor(),Oe=B.getClearAlpha(),Ze=Ie.r,pt=Ie.g,Tt=Ie.b;Ue?(x[0]=Ze,x[1]=pt,x[2]=Tt,x[3]=Oe,O.clearBufferuiv(O.COLOR,0,x)):(M[0]=Ze,M[1]=pt,M[2]=Tt,M[3]=Oe,O.clearBufferiv(O.COLOR,0,M))}else $|=O.COLOR_BUFFER_BIT}H&&($|=O.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),j&&($|=O.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),$!==0&&O.clear($)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(R){R.setRenderer(this),k=R},this.dispose=function(){t.removeEventListener("webglcontextlost",qe,!1),t.removeEventListener("webglcontextrestored",dt,!1),t.removeEventListener("webglcontextcreationerror",Ne,!1),B.dispose(),Te.dispose(),ne.dispose(),tt.dispose(),$e.dispose(),L.dispose(),fe.dispose(),q.dispose(),Re.dispose(),Ke.dispose(),ae.dispose(),de.dispose(),de.removeEventListener("sessionstart",Yl),de.removeEventListener("sessionend",is),Ms.stop()};function qe(R){R.preventDefault(),Pa("WebGLRenderer: Context Lost."),I=!0}function dt(){Pa("WebGLRenderer: Context Restored."),I=!1;let R=zt.autoReset,H=ge.enabled,j=ge.autoUpdate,$=ge.needsUpdate,Z=ge.type;ut(),zt.autoReset=R,ge.enabled=H,ge.autoUpdate=j,ge.needsUpdate=$,ge.type=Z}function Ne(R){ht("WebGLRenderer: A WebGL context could not be created. Reason: ",R.statusMessage)}function _t(R){let H=R.target;H.removeEventListener("dispose",_t),jt(H)}function jt(R){jn(R),$e.remove(R)}function jn(R){let H=$e.get(R).programs;H!==void 0&&(H.forEach(function(j){ae.releaseProgram(j)}),R.isShaderMaterial&&ae.releaseShaderCache(R))}this.renderBufferDirect=function(R,H,j,$,Z,Pe){H===null&&(H=vt);let Ue=Z.isMesh&&Z.matrixWorld.determinantAffine()<0,Ie=aa(R,H,j,$,Z);we.setMaterial($,Ue);let Oe=j.index,Ze=1;if($.wireframe===!0){if(Oe=q.getWireframeAttribute(j),Oe===void 0)return;Ze=2}let pt=j.drawRange,Tt=j.attributes.position,Ye=pt.start*Ze,At=(pt.start+pt.count)*Ze;Pe!==null&&(Ye=Math.max(Ye,Pe.start*Ze),At=Math.min(At,(Pe.start+Pe.count)*Ze)),Oe!==null?(Ye=Math.max(Ye,0),At=Math.min(At,Oe.count)):Tt!=null&&(Ye=Math.max(Ye,0),At=Math.min(At,Tt.count));let an=At-Ye;if(an<0||an===1/0)return;Re.setup(Z,$,Ie,j,Oe);let Xt,qt=ie;if(Oe!==null&&(Xt=w.get(Oe),qt=Ce,qt.setIndex(Xt)),Z.isMesh)$.wireframe===!0?(we.setLineWidth($.wireframeLinewidth*bt()),qt.setMode(O.LINES)):qt.setMode(O.TRIANGLES);else if(Z.isLine){let An=$.linewidth;An===void 0&&(An=1),we.setLineWidth(An*bt()),Z.isLineSegments?qt.setMode(O.LINES):Z.isLineLoop?qt.setMode(O.LINE_LOOP):qt.setMode(O.LINE_STRIP)}else Z.isPoints?qt.setMode(O.POINTS):Z.isSprite&&qt.setMode(O.TRIANGLES);if(Z.isBatchedMesh)if(Xe.get("WEBGL_multi_draw"))qt.renderMultiDraw(Z._multiDrawStarts,Z._multiDrawCounts,Z._multiDrawCount);else{let An=Z._multiDrawStarts,Ge=Z._multiDrawCounts,xn=Z._multiDrawCount,Pt=Oe?w.get(Oe).bytesPerElement:1,Es=$e.get($).currentProgram.getUniforms();for(let vn=0;vn<xn;vn++)Es.setValue(O,"_gl_DrawID",vn),qt.render(An[vn]/Pt,Ge[vn])}else if(Z.isInstancedMesh)qt.renderInstances(Ye,an,Z.count);else if(j.isInstancedBufferGeometry){let An=j._maxInstanceCount!==void 0?j._maxInstanceCount:1/0,Ge=Math.min(j.instanceCount,An);qt.renderInstances(Ye,an,Ge)}else qt.render(Ye,an)};function sa(R,H,j,$){k!==null&&R.isNodeMaterial&&k.setObject($,R),xe===!0&&se.setState(R,j,!1),R.transparent===!0&&R.side===Sn&&R.forceSinglePass===!1?(R.side=li,R.needsUpdate=!0,ss(R,H,$),R.side=gr,R.needsUpdate=!0,ss(R,H,$),R.side=Sn):ss(R,H,$)}this.compile=function(R,H,j=null){j===null&&(j=R),k!==null&&k.renderStart(R,H,j),T=ne.get(j),T.init(H),E.push(T),j.traverseVisible(function(Z){Z.isLight&&Z.layers.test(H.layers)&&(T.pushLight(Z),Z.castShadow&&T.pushShadow(Z))}),R!==j&&R.traverseVisible(function(Z){Z.isLight&&Z.layers.test(H.layers)&&(T.pushLight(Z),Z.castShadow&&T.pushShadow(Z))}),T.setupLights(),k!==null&&k.updateLights(T.state.lightsArray),Be=this.localClippingEnabled,xe=se.init(this.clippingPlanes,Be),xe===!0&&se.setGlobalState(this.clippingPlanes,H),k!==null&&ge.render(T.state.shadowsArray,j,H);let $=new Set;return R.traverse(function(Z){if(!(Z.isMesh||Z.isPoints||Z.isLine||Z.isSprite))return;let Pe=Z.material;if(Pe)if(Array.isArray(Pe))for(let Ue=0;Ue<Pe.length;Ue++){let Ie=Pe[Ue];sa(Ie,j,H,Z),$.add(Ie)}else sa(Pe,j,H,Z),$.add(Pe)}),T=E.pop(),k!==null&&k.renderEnd(),$},this.compileAsync=function(R,H,j=null){let $=this.compile(R,H,j);return new Promise(Z=>{function Pe(){if($.forEach(function(Ue){let Oe=$e.get(Ue).currentProgram;(Oe===void 0||Oe.isReady())&&$.delete(Ue)}),$.size===0){Z(R);return}setTimeout(Pe,10)}Xe.get("KHR_parallel_shader_compile")!==null?Pe():setTimeout(Pe,10)})};let $r=null;function Rd(R){$r&&$r(R)}function Yl(){Ms.stop()}function is(){Ms.start()}let Ms=new $0;Ms.setAnimationLoop(Rd),typeof self<"u"&&Ms.setContext(self),this.setAnimationLoop=function(R){$r=R,de.setAnimationLoop(R),R===null?Ms.stop():Ms.start()},de.addEventListener("sessionstart",Yl),de.addEventListener("sessionend",is),this.render=function(R,H){if(H!==void 0&&H.isCamera!==!0){ht("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(I===!0)return;k!==null&&k.renderStart(R,H);let j=de.enabled===!0&&de.isPresenting===!0,$=N!==null&&(ce===null||j)&&N.begin(P,ce);if(R.matrixWorldAutoUpdate===!0&&R.updateMatrixWorld(),H.parent===null&&H.matrixWorldAutoUpdate===!0&&H.updateMatrixWorld(),de.enabled===!0&&de.isPresenting===!0&&(N===null||N.isCompositing()===!1)&&(de.cameraAutoUpdate===!0&&de.updateCamera(H),H=de.getCamera()),R.isScene===!0&&R.onBeforeRender(P,R,H,ce),T=ne.get(R,E.length),T.init(H),T.state.textureUnits=tt.getTextureUnits(),E.push(T),De.multiplyMatrices(H.projectionMatrix,H.matrixWorldInverse),H.isArrayCamera?_e.setFromArrayCamera(H):oe.setFromProjectionMatrix(De,Oi,H.reversedDepth),Be=this.localClippingEnabled,xe=se.init(this.clippingPlanes,Be),C=Te.get(R,v.length),C.init(),v.push(C),this.info.render.frame++,de.enabled===!0&&de.isPresenting===!0){let Ue=P.xr.getDepthSensingMesh();Ue!==null&&Ss(Ue,H,-1/0,P.sortObjects)}Ss(R,H,0,P.sortObjects),C.finish(),k!==null&&k.updateLights(T.state.lightsArray),P.sortObjects===!0&&C.sort(Ve,at),gt=de.enabled===!1||de.isPresenting===!1||de.hasDepthSensing()===!1,gt&&B.addToRenderList(C,R),this.info.autoReset===!0&&this.info.reset(),xe===!0&&se.beginShadows();let Z=T.state.shadowsArray;if(ge.render(Z,R,H),xe===!0&&se.endShadows(),($&&N.hasRenderPass())===!1){let Ue=C.opaque,Ie=C.transmissive;if(T.setupLights(),H.isArrayCamera){let Oe=H.cameras;if(Ie.length>0)for(let Ze=0,pt=Oe.length;Ze<pt;Ze++){let Tt=Oe[Ze];Wi(Ue,Ie,R,Tt)}gt&&B.render(R);for(let Ze=0,pt=Oe.length;Ze<pt;Ze++){let Tt=Oe[Ze];ra(C,R,Tt,Tt.viewport)}}else Ie.length>0&&Wi(Ue,Ie,R,H),gt&&B.render(R),ra(C,R,H)}ce!==null&&G===0&&(tt.updateMultisampleRenderTarget(ce),tt.updateRenderTargetMipmap(ce)),$&&N.end(P),R.isScene===!0&&R.onAfterRender(P,R,H),Re.resetDefaultState(),J=-1,Q=null,E.pop(),E.length>0?(T=E[E.length-1],tt.setTextureUnits(T.state.textureUnits),xe===!0&&se.setGlobalState(P.clippingPlanes,T.state.camera)):T=null,v.pop(),v.length>0?C=v[v.length-1]:C=null,k!==null&&k.renderEnd()};function Ss(R,H,j,$){if(R.visible===!1)return;if(R.layers.test(H.layers)){if(R.isGroup)j=R.renderOrder;else if(R.isLOD)R.autoUpdate===!0&&R.update(H);else if(R.isLight)T.pushLight(R),R.castShadow&&T.pushShadow(R);else if(R.isSprite){let Ue=H.isArrayCamera?_e:oe;if(!R.frustumCulled||R.intersectsFrustum(Ue)){$&&ke.setFromMatrixPosition(R.matrixWorld).applyMatrix4(De);let Ie=fe.update(R),Oe=R.material;Oe.visible&&C.push(R,Ie,Oe,j,ke.z,null,H)}}else if(R.isMesh||R.isLine||R.isPoints){let Ue=H.isArrayCamera?_e:oe;if(!R.frustumCulled||R.intersectsFrustum(Ue)){let Ie=fe.update(R),Oe=R.material;if($&&(R.boundingSphere!==void 0?(R.boundingSphere===null&&R.computeBoundingSphere(),ke.copy(R.boundingSphere.center)):(Ie.boundingSphere===null&&Ie.computeBoundingSphere(),ke.copy(Ie.boundingSphere.center)),ke.applyMatrix4(R.matrixWorld).applyMatrix4(De)),Array.isArray(Oe)){let Ze=Ie.groups;for(let pt=0,Tt=Ze.length;pt<Tt;pt++){let Ye=Ze[pt],At=Oe[Ye.materialIndex];At&&At.visible&&C.push(R,Ie,At,j,ke.z,Ye,H)}}else Oe.visible&&C.push(R,Ie,Oe,j,ke.z,null,H)}}}let Pe=R.children;for(let Ue=0,Ie=Pe.length;Ue<Ie;Ue++)Ss(Pe[Ue],H,j,$)}function ra(R,H,j,$){let{opaque:Z,transmissive:Pe,transparent:Ue}=R;T.setupLightsView(j),xe===!0&&se.setGlobalState(P.clippingPlanes,j),$&&we.viewport(te.copy($)),Z.length>0&&hn(Z,H,j),Pe.length>0&&hn(Pe,H,j),Ue.length>0&&hn(Ue,H,j),we.buffers.depth.setTest(!0),we.buffers.depth.setMask(!0),we.buffers.color.setMask(!0),we.setPolygonOffset(!1)}function Wi(R,H,j,$){if((j.isScene===!0?j.overrideMaterial:null)!==null)return;if(T.state.transmissionRenderTarget[$.id]===void 0){let Ye=Xe.has("EXT_color_buffer_half_float")||Xe.has("EXT_color_buffer_float");T.state.transmissionRenderTarget[$.id]=new Ai(1,1,{generateMipmaps:!0,type:Ye?ji:yi,minFilter:Vs,samples:Math.max(4,ft.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:Ct.workingColorSpace})}let Pe=T.state.transmissionRenderTarget[$.id],Ue=$.viewport||te;Pe.setSize(Ue.z*P.transmissionResolutionScale,Ue.w*P.transmissionResolutionScale);let Ie=P.getRenderTarget(),Oe=P.getActiveCubeFace(),Ze=P.getActiveMipmapLevel();P.setRenderTarget(Pe),P.getClearColor(ee),ye=P.getClearAlpha(),ye<1&&P.setClearColor(16777215,.5),P.clear(),gt&&B.render(j);let pt=P.toneMapping;P.toneMapping=Hi;let Tt=$.viewport;if($.viewport!==void 0&&($.viewport=void 0),T.setupLightsView($),xe===!0&&se.setGlobalState(P.clippingPlanes,$),hn(R,j,$),tt.updateMultisampleRenderTarget(Pe),tt.updateRenderTargetMipmap(Pe),Xe.has("WEBGL_multisampled_render_to_texture")===!1){let Ye=!1;for(let At=0,an=H.length;At<an;At++){let Xt=H[At],{object:qt,geometry:An,material:Ge,group:xn}=Xt;if(Ge.side===Sn&&qt.layers.test($.layers)){let Pt=Ge.side;Ge.side=li,Ge.needsUpdate=!0,gn(qt,j,$,An,Ge,xn),Ge.side=Pt,Ge.needsUpdate=!0,Ye=!0}}Ye===!0&&(tt.updateMultisampleRenderTarget(Pe),tt.updateRenderTargetMipmap(Pe))}P.setRenderTarget(Ie,Oe,Ze),P.setClearColor(ee,ye),Tt!==void 0&&($.viewport=Tt),P.toneMapping=pt}function hn(R,H,j){let $=H.isScene===!0?H.overrideMaterial:null;for(let Z=0,Pe=R.length;Z<Pe;Z++){let Ue=R[Z],{object:Ie,geometry:Oe,group:Ze}=Ue,pt=Ue.material;pt.allowOverride===!0&&$!==null&&(pt=$),Ie.layers.test(j.layers)&&gn(Ie,H,j,Oe,pt,Ze)}}function gn(R,H,j,$,Z,Pe){k!==null&&Z.isNodeMaterial&&k.setObject(R,Z),R.onBeforeRender(P,H,j,$,Z,Pe),R.modelViewMatrix.multiplyMatrices(j.matrixWorldInverse,R.matrixWorld),R.normalMatrix.getNormalMatrix(R.modelViewMatrix),Z.onBeforeRender(P,H,j,$,R,Pe),Z.transparent===!0&&Z.side===Sn&&Z.forceSinglePass===!1?(Z.side=li,Z.needsUpdate=!0,P.renderBufferDirect(j,H,$,Z,R,Pe),Z.side=gr,Z.needsUpdate=!0,P.renderBufferDirect(j,H,$,Z,R,Pe),Z.side=Sn):P.renderBufferDirect(j,H,$,Z,R,Pe),R.onAfterRender(P,H,j,$,Z,Pe)}function yn(R){let H=0;for(let j of R)j.texture!==null&&H++;return H}function ss(R,H,j){H.isScene!==!0&&(H=vt);let $=$e.get(R),Z=T.state.lights,Pe=T.state.shadowsArray,Ue=Z.state.version,Ie=ae.getParameters(R,Z.state,Pe,H,j,T.state.lightProbeGridArray),Oe=ae.getProgramCacheKey(Ie),Ze=$.programs;$.environment=R.isMeshStandardMaterial||R.isMeshLambertMaterial||R.isMeshPhongMaterial?H.environment:null,$.fog=H.fog;let pt=R.isMeshStandardMaterial||R.isMeshLambertMaterial&&!R.envMap||R.isMeshPhongMaterial&&!R.envMap;$.envMap=L.get(R.envMap||$.environment,pt),$.envMapRotation=$.environment!==null&&R.envMap===null?H.environmentRotation:R.envMapRotation,Ze===void 0&&(R.addEventListener("dispose",_t),Ze=new Map,$.programs=Ze,$.programVariants=new Map);let Tt=Ze.get(Oe);if(Tt!==void 0){if($.currentProgram===Tt&&$.lightsStateVersion===Ue)return oa(R,Ie),Tt}else Ie.uniforms=ae.getUniforms(R),k!==null&&R.isNodeMaterial&&k.build(R,j,Ie),R.onBeforeCompile(Ie,P),Tt=ae.acquireProgram(Ie,Oe),Ze.set(Oe,Tt),$.uniforms=Ie.uniforms;let Ye=$.uniforms;return(!R.isShaderMaterial&&!R.isRawShaderMaterial||R.clipping===!0)&&(Ye.clippingPlanes=se.uniform),oa(R,Ie),$.needsLights=Js(R),$.lightsStateVersion=Ue,$.needsLights&&(Ye.ambientLightColor.value=Z.state.ambient,Ye.lightProbe.value=Z.state.probe,Ye.sunLights.value=Z.state.sun,Ye.sunLightShadows.value=Z.state.sunShadow,Ye.directionalLights.value=Z.state.directional,Ye.directionalLightShadows.value=Z.state.directionalShadow,Ye.spotLights.value=Z.state.spot,Ye.spotLightShadows.value=Z.state.spotShadow,Ye.rectAreaLights.value=Z.state.rectArea,Ye.ltc_1.value=Z.state.rectAreaLTC1,Ye.ltc_2.value=Z.state.rectAreaLTC2,Ye.pointLights.value=Z.state.point,Ye.pointLightShadows.value=Z.state.pointShadow,Ye.hemisphereLights.value=Z.state.hemi,Ye.sunShadowMatrix.value=Z.state.sunShadowMatrix,Ye.sunShadowCascade.value=Z.state.sunShadowCascade,Ye.directionalShadowMatrix.value=Z.state.directionalShadowMatrix,Ye.spotLightMatrix.value=Z.state.spotLightMatrix,Ye.spotLightMap.value=Z.state.spotLightMap,Ye.pointShadowMatrix.value=Z.state.pointShadowMatrix),$.numLightProbeGrids=yn(T.state.lightProbeGridArray),$.currentProgram=Tt,$.uniformsList=null,Tt}function vi(R,H,j,$,Z){let Pe=$e.get(R),Ue=Pe.currentProgram.id+","+$+","+Z,Ie=Pe.programVariants.get(Ue);return Ie===void 0?(Ie=ss(R,H,j),Pe.programVariants.set(Ue,Ie)):(Pe.currentProgram=Ie,Pe.uniformsList=null,Pe.outputColorSpace=$,Pe.toneMapping=Z),Ie}function Zs(R){if(R.uniformsList===null){let H=R.currentProgram.getUniforms();R.uniformsList=zo.seqWithValue(H.seq,R.uniforms)}return R.uniformsList}function oa(R,H){let j=$e.get(R);j.outputColorSpace=H.outputColorSpace,j.batching=H.batching,j.batchingColor=H.batchingColor,j.instancing=H.instancing,j.instancingColor=H.instancingColor,j.instancingMorph=H.instancingMorph,j.skinning=H.skinning,j.morphTargets=H.morphTargets,j.morphNormals=H.morphNormals,j.morphColors=H.morphColors,j.morphTargetsCount=H.morphTargetsCount,j.numClippingPlanes=H.numClippingPlanes,j.numIntersection=H.numClipIntersection,j.vertexAlphas=H.vertexAlphas,j.vertexTangents=H.vertexTangents,j.toneMapping=H.toneMapping}function aa(R,H,j,$,Z){H.isScene!==!0&&(H=vt),tt.resetTextureUnits();let Pe=H.fog,Ue=$.isMeshStandardMaterial||$.isMeshLambertMaterial||$.isMeshPhongMaterial?H.environment:null,Ie=ce===null?P.outputColorSpace:ce.isXRRenderTarget===!0?ce.texture.colorSpace:Ct.workingColorSpace,Oe=$.isMeshStandardMaterial||$.isMeshLambertMaterial&&!$.envMap||$.isMeshPhongMaterial&&!$.envMap,Ze=L.get($.envMap||Ue,Oe),pt=$.vertexColors===!0&&!!j.attributes.color&&j.attributes.color.itemSize===4,Tt=!!j.attributes.tangent&&(!!$.normalMap||$.anisotropy>0),Ye=!!j.morphAttributes.position,At=!!j.morphAttributes.normal,an=!!j.morphAttributes.color,Xt=Hi;$.toneMapped&&(ce===null||ce.isXRRenderTarget===!0)&&(Xt=P.toneMapping);let qt=j.morphAttributes.position||j.morphAttributes.normal||j.morphAttributes.color,An=qt!==void 0?qt.length:0,Ge=$e.get($),xn=T.state.lights;if(xe===!0&&(Be===!0||R!==Q)){let Yt=R===Q&&$.id===J;se.setState($,R,Yt)}let Pt=!1,Es=!1;$.version===Ge.__version?Ge.needsLights&&Ge.lightsStateVersion!==xn.state.version||Z.isBatchedMesh&&Ge.batching===!1||!Z.isBatchedMesh&&Ge.batching===!0||Z.isBatchedMesh&&Ge.batchingColor===!0&&Z._colorsTexture===null||Z.isBatchedMesh&&Ge.batchingColor===!1&&Z._colorsTexture!==null||Z.isInstancedMesh&&Ge.instancing===!1||!Z.isInstancedMesh&&Ge.instancing===!0||Z.isSkinnedMesh&&Ge.skinning===!1||!Z.isSkinnedMesh&&Ge.skinning===!0||Z.isInstancedMesh&&Ge.instancingColor===!0&&Z.instanceColor===null||Z.isInstancedMesh&&Ge.instancingColor===!1&&Z.instanceColor!==null||Z.isInstancedMesh&&Ge.instancingMorph===!0&&Z.morphTexture===null||Z.isInstancedMesh&&Ge.instancingMorph===!1&&Z.morphTexture!==null||Ge.envMap!==Ze||$.fog===!0&&Ge.fog!==Pe||Ge.numClippingPlanes!==void 0&&(Ge.numClippingPlanes!==se.numPlanes||Ge.numIntersection!==se.numIntersection)||Ge.vertexAlphas!==pt||Ge.vertexTangents!==Tt||Ge.morphTargets!==Ye||Ge.morphNormals!==At||Ge.morphColors!==an||Ge.morphTargetsCount!==An||Ge.numLightProbeGrids!==yn(T.state.lightProbeGridArray)?Pt=!0:(Ge.outputColorSpace!==Ie||Ge.toneMapping!==Xt)&&(Es=!0):(Pt=!0,Ge.__version=$.version);let vn=Ge.currentProgram;(Pt===!0||Es===!0)&&(vn=Es===!0?vi($,H,Z,Ie,Xt):ss($,H,Z),k&&$.isNodeMaterial&&k.onUpdateProgram($,vn,Ge));let Kr=!1,rs=!1,ws=!1,Mt=vn.getUniforms(),un=Ge.uniforms;if(we.useProgram(vn.program)&&(Kr=!0,rs=!0,ws=!0),$.id!==J&&(J=$.id,rs=!0),Kr||Q!==R){we.buffers.depth.getReversed()&&R.reversedDepth!==!0&&(R._reversedDepth=!0,R.updateProjectionMatrix()),Mt.setValue(O,"projectionMatrix",R.projectionMatrix),Mt.setValue(O,"viewMatrix",R.matrixWorldInverse);let _n=Mt.map.cameraPosition;_n!==void 0&&_n.setValue(O,st.setFromMatrixPosition(R.matrixWorld)),ft.logarithmicDepthBuffer&&Mt.setValue(O,"logDepthBufFC",2/(Math.log(R.far+1)/Math.LN2)),($.isMeshPhongMaterial||$.isMeshToonMaterial||$.isMeshLambertMaterial||$.isMeshBasicMaterial||$.isMeshStandardMaterial||$.isShaderMaterial)&&Mt.setValue(O,"isOrthographic",R.isOrthographicCamera===!0),Q!==R&&(Q=R,rs=!0,ws=!0)}if(Ge.needsLights&&(xn.state.sunShadowMap.length>0&&Mt.setValue(O,"sunShadowMap",xn.state.sunShadowMap,tt),xn.state.directionalShadowMap.length>0&&Mt.setValue(O,"directionalShadowMap",xn.state.directionalShadowMap,tt),xn.state.spotShadowMap.length>0&&Mt.setValue(O,"spotShadowMap",xn.state.spotShadowMap,tt),xn.state.pointShadowMap.length>0&&Mt.setValue(O,"pointShadowMap",xn.state.pointShadowMap,tt)),Z.isSkinnedMesh){Mt.setOptional(O,Z,"bindMatrix"),Mt.setOptional(O,Z,"bindMatrixInverse");let Yt=Z.skeleton;Yt&&(Yt.boneTexture===null&&Yt.computeBoneTexture(),Mt.setValue(O,"boneTexture",Yt.boneTexture,tt))}Z.isBatchedMesh&&(Mt.setOptional(O,Z,"batchingTexture"),Mt.setValue(O,"batchingTexture",Z._matricesTexture,tt),Mt.setOptional(O,Z,"batchingIdTexture"),Mt.setValue(O,"batchingIdTexture",Z._indirectTexture,tt),Mt.setOptional(O,Z,"batchingColorTexture"),Z._colorsTexture!==null&&Mt.setValue(O,"batchingColorTexture",Z._colorsTexture,tt));let Qn=j.morphAttributes;if((Qn.position!==void 0||Qn.normal!==void 0||Qn.color!==void 0)&&re.update(Z,j,vn),(rs||Ge.receiveShadow!==Z.receiveShadow)&&(Ge.receiveShadow=Z.receiveShadow,Mt.setValue(O,"receiveShadow",Z.receiveShadow)),($.isMeshStandardMaterial||$.isMeshLambertMaterial||$.isMeshPhongMaterial)&&$.envMap===null&&H.environment!==null&&(un.envMapIntensity.value=H.environmentIntensity),un.dfgLUT!==void 0&&(un.dfgLUT.value=OT()),rs){if(Mt.setValue(O,"toneMappingExposure",P.toneMappingExposure),Ge.needsLights&&Zr(un,ws),Pe&&$.fog===!0&&Se.refreshFogUniforms(un,Pe),Se.refreshMaterialUniforms(un,$,Ee,Le,T.state.transmissionRenderTarget[R.id]),Ge.needsLights&&Ge.numLightProbeGrids>0){let Yt=_,_n=0;for(let qn of T.state.lightProbeGridArray)qn.texture!==null&&(Yt.textures[_n]=qn.texture,Yt.min[_n]=qn.boundingBox.min,Yt.max[_n]=qn.boundingBox.max,Yt.resolution[_n]=qn.resolution,_n++);for(let qn in Yt)Yt[qn].length=_n;un.probesSH.value=Yt.textures,un.probesMin.value=Yt.min,un.probesMax.value=Yt.max,un.probesResolution.value=Yt.resolution}zo.upload(O,Zs(Ge),un,tt)}if($.isShaderMaterial&&$.uniformsNeedUpdate===!0&&(zo.upload(O,Zs(Ge),un,tt),$.uniformsNeedUpdate=!1),$.isSpriteMaterial&&Mt.setValue(O,"center",Z.center),Mt.setValue(O,"modelViewMatrix",Z.modelViewMatrix),Mt.setValue(O,"normalMatrix",Z.normalMatrix),Mt.setValue(O,"modelMatrix",Z.matrixWorld),$.uniformsGroups!==void 0){let Yt=$.uniformsGroups;for(let _n=0,qn=Yt.length;_n<qn;_n++){let $l=Yt[_n];Ke.update($l,vn),Ke.bind($l,vn)}}return vn}function Zr(R,H){R.ambientLightColor.needsUpdate=H,R.lightProbe.needsUpdate=H,R.sunLights.needsUpdate=H,R.sunLightShadows.needsUpdate=H,R.directionalLights.needsUpdate=H,R.directionalLightShadows.needsUpdate=H,R.pointLights.needsUpdate=H,R.pointLightShadows.needsUpdate=H,R.spotLights.needsUpdate=H,R.spotLightShadows.needsUpdate=H,R.rectAreaLights.needsUpdate=H,R.hemisphereLights.needsUpdate=H}function Js(R){return R.isMeshLambertMaterial||R.isMeshToonMaterial||R.isMeshPhongMaterial||R.isMeshStandardMaterial||R.isShadowMaterial||R.isShaderMaterial&&R.lights===!0}this.getActiveCubeFace=function(){return Y},this.getActiveMipmapLevel=function(){return G},this.getRenderTarget=function(){return ce},this.setRenderTargetTextures=function(R,H,j){let $=$e.get(R);$.__autoAllocateDepthBuffer=R.resolveDepthBuffer===!1,$.__autoAllocateDepthBuffer===!1&&($.__useRenderToTexture=!1),$e.get(R.texture).__webglTexture=H,$e.get(R.depthTexture).__webglTexture=$.__autoAllocateDepthBuffer?void 0:j,$.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(R,H){let j=$e.get(R);j.__webglFramebuffer=H,j.__useDefaultFramebuffer=H===void 0},this.setRenderTarget=function(R,H=0,j=0){ce=R,Y=H,G=j;let $=null,Z=!1,Pe=!1;if(R){let Ie=$e.get(R);if(Ie.__useDefaultFramebuffer!==void 0){we.bindFramebuffer(O.FRAMEBUFFER,Ie.__webglFramebuffer),te.copy(R.viewport),pe.copy(R.scissor),he=R.scissorTest,we.viewport(te),we.scissor(pe),we.setScissorTest(he),J=-1;return}else if(Ie.__webglFramebuffer===void 0)tt.setupRenderTarget(R);else if(Ie.__hasExternalTextures)tt.rebindTextures(R,$e.get(R.texture).__webglTexture,$e.get(R.depthTexture).__webglTexture);else if(R.depthBuffer){let pt=R.depthTexture;if(Ie.__boundDepthTexture!==pt){if(pt!==null&&$e.has(pt)&&(R.width!==pt.image.width||R.height!==pt.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");tt.setupDepthRenderbuffer(R)}}let Oe=R.texture;(Oe.isData3DTexture||Oe.isDataArrayTexture||Oe.isCompressedArrayTexture)&&(Pe=!0);let Ze=$e.get(R).__webglFramebuffer;R.isWebGLCubeRenderTarget?(Array.isArray(Ze[H])?$=Ze[H][j]:$=Ze[H],Z=!0):R.samples>0&&tt.useMultisampledRTT(R)===!1?$=$e.get(R).__webglMultisampledFramebuffer:Array.isArray(Ze)?$=Ze[j]:$=Ze,te.copy(R.viewport),pe.copy(R.scissor),he=R.scissorTest}else te.copy(Je).multiplyScalar(Ee).floor(),pe.copy(lt).multiplyScalar(Ee).floor(),he=rt;if(j!==0&&($=V),we.bindFramebuffer(O.FRAMEBUFFER,$)&&we.drawBuffers(R,$),we.viewport(te),we.scissor(pe),we.setScissorTest(he),Z){let Ie=$e.get(R.texture);O.framebufferTexture2D(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_CUBE_MAP_POSITIVE_X+H,Ie.__webglTexture,j)}else if(Pe){let Ie=H;for(let Oe=0;Oe<R.textures.length;Oe++){let Ze=$e.get(R.textures[Oe]);O.framebufferTextureLayer(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0+Oe,Ze.__webglTexture,j,Ie)}}else if(R!==null&&j!==0){let Ie=$e.get(R.texture);O.framebufferTexture2D(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,Ie.__webglTexture,j)}J=-1};function Jr(R){let H=$e.get(R);return(H.__readFormat!==R.format||H.__readType!==R.type)&&(H.__readFormat=R.format,H.__readType=R.type,H.__formatReadable=ft.textureFormatReadable(R.format),H.__typeReadable=ft.textureTypeReadable(R.type)),H}this.readRenderTargetPixels=function(R,H,j,$,Z,Pe,Ue,Ie=0){if(!(R&&R.isWebGLRenderTarget)){ht("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let Oe=$e.get(R).__webglFramebuffer;if(R.isWebGLCubeRenderTarget&&Ue!==void 0&&(Oe=Oe[Ue],Array.isArray(Oe)&&(Oe=Oe[0])),Oe){we.bindFramebuffer(O.FRAMEBUFFER,Oe);try{let Ze=R.textures[Ie],pt=Ze.format,Tt=Ze.type;R.textures.length>1&&O.readBuffer(O.COLOR_ATTACHMENT0+Ie);let Ye=Jr(Ze);if(Ye.__formatReadable===!1){ht("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(Ye.__typeReadable===!1){ht("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}H>=0&&H<=R.width-$&&j>=0&&j<=R.height-Z&&O.readPixels(H,j,$,Z,be.convert(pt),be.convert(Tt),Pe)}finally{let Ze=ce!==null?$e.get(ce).__webglFramebuffer:null;we.bindFramebuffer(O.FRAMEBUFFER,Ze)}}},this.readRenderTargetPixelsAsync=async function(R,H,j,$,Z,Pe,Ue,Ie=0){if(!(R&&R.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let Oe=$e.get(R).__webglFramebuffer;if(R.isWebGLCubeRenderTarget&&Ue!==void 0&&(Oe=Oe[Ue],Array.isArray(Oe)&&(Oe=Oe[0])),Oe)if(H>=0&&H<=R.width-$&&j>=0&&j<=R.height-Z){we.bindFramebuffer(O.FRAMEBUFFER,Oe);let Ze=R.textures[Ie],pt=Ze.format,Tt=Ze.type;R.textures.length>1&&O.readBuffer(O.COLOR_ATTACHMENT0+Ie);let Ye=Jr(Ze);if(Ye.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(Ye.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let At=O.createBuffer();O.bindBuffer(O.PIXEL_PACK_BUFFER,At),O.bufferData(O.PIXEL_PACK_BUFFER,Pe.byteLength,O.STREAM_READ),O.readPixels(H,j,$,Z,be.convert(pt),be.convert(Tt),0),O.bindBuffer(O.PIXEL_PACK_BUFFER,null);let an=ce!==null?$e.get(ce).__webglFramebuffer:null;we.bindFramebuffer(O.FRAMEBUFFER,an);let Xt=O.fenceSync(O.SYNC_GPU_COMMANDS_COMPLETE,0);return O.flush(),await x0(O,Xt,4),O.bindBuffer(O.PIXEL_PACK_BUFFER,At),O.getBufferSubData(O.PIXEL_PACK_BUFFER,0,Pe),O.bindBuffer(O.PIXEL_PACK_BUFFER,null),O.deleteBuffer(At),O.deleteSync(Xt),Pe}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(R,H=null,j=0){let $=Math.pow(2,-j),Z=Math.floor(R.image.width*$),Pe=Math.floor(R.image.height*$),Ue=H!==null?H.x:0,Ie=H!==null?H.y:0;tt.setTexture2D(R,0),O.copyTexSubImage2D(O.TEXTURE_2D,j,0,0,Ue,Ie,Z,Pe),we.unbindTexture()},this.copyTextureToTexture=function(R,H,j=null,$=null,Z=0,Pe=0){let Ue,Ie,Oe,Ze,pt,Tt,Ye,At,an,Xt=R.isCompressedTexture?R.mipmaps[Pe]:R.image;if(j!==null)Ue=j.max.x-j.min.x,Ie=j.max.y-j.min.y,Oe=j.isBox3?j.max.z-j.min.z:1,Ze=j.min.x,pt=j.min.y,Tt=j.isBox3?j.min.z:0;else{let Mt=Math.pow(2,-Z);Ue=Math.floor(Xt.width*Mt),Ie=Math.floor(Xt.height*Mt),R.isDataArrayTexture?Oe=Xt.depth:R.isData3DTexture?Oe=Math.floor(Xt.depth*Mt):Oe=1,Ze=0,pt=0,Tt=0}$!==null?(Ye=$.x,At=$.y,an=$.z):(Ye=0,At=0,an=0);let qt=be.convert(H.format),An=be.convert(H.type),Ge;H.isData3DTexture?(tt.setTexture3D(H,0),Ge=O.TEXTURE_3D):H.isDataArrayTexture||H.isCompressedArrayTexture?(tt.setTexture2DArray(H,0),Ge=O.TEXTURE_2D_ARRAY):(tt.setTexture2D(H,0),Ge=O.TEXTURE_2D),we.activeTexture(O.TEXTURE0),we.pixelStorei(O.UNPACK_FLIP_Y_WEBGL,H.flipY),we.pixelStorei(O.UNPACK_PREMULTIPLY_ALPHA_WEBGL,H.premultiplyAlpha),we.pixelStorei(O.UNPACK_ALIGNMENT,H.unpackAlignment);let xn=we.getParameter(O.UNPACK_ROW_LENGTH),Pt=we.getParameter(O.UNPACK_IMAGE_HEIGHT),Es=we.getParameter(O.UNPACK_SKIP_PIXELS),vn=we.getParameter(O.UNPACK_SKIP_ROWS),Kr=we.getParameter(O.UNPACK_SKIP_IMAGES);we.pixelStorei(O.UNPACK_ROW_LENGTH,Xt.width),we.pixelStorei(O.UNPACK_IMAGE_HEIGHT,Xt.height),we.pixelStorei(O.UNPACK_SKIP_PIXELS,Ze),we.pixelStorei(O.UNPACK_SKIP_ROWS,pt),we.pixelStorei(O.UNPACK_SKIP_IMAGES,Tt);let rs=R.isDataArrayTexture||R.isData3DTexture,ws=H.isDataArrayTexture||H.isData3DTexture;if(R.isDepthTexture){let Mt=$e.get(R),un=$e.get(H),Qn=$e.get(Mt.__renderTarget),Yt=$e.get(un.__renderTarget);we.bindFramebuffer(O.READ_FRAMEBUFFER,Qn.__webglFramebuffer),we.bindFramebuffer(O.DRAW_FRAMEBUFFER,Yt.__webglFramebuffer);for(let _n=0;_n<Oe;_n++)rs&&(O.framebufferTextureLayer(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,$e.get(R).__webglTexture,Z,Tt+_n),O.framebufferTextureLayer(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,$e.get(H).__webglTexture,Pe,an+_n)),O.blitFramebuffer(Ze,pt,Ze+Ue,pt+Ie,Ye,At,Ye+Ue,At+Ie,O.DEPTH_BUFFER_BIT,O.NEAREST);we.bindFramebuffer(O.READ_FRAMEBUFFER,null),we.bindFramebuffer(O.DRAW_FRAMEBUFFER,null)}else if(Z!==0||R.isRenderTargetTexture||$e.has(R)){let Mt=$e.get(R),un=$e.get(H);we.bindFramebuffer(O.READ_FRAMEBUFFER,F),we.bindFramebuffer(O.DRAW_FRAMEBUFFER,z);for(let Qn=0;Qn<Oe;Qn++)rs?O.framebufferTextureLayer(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,Mt.__webglTexture,Z,Tt+Qn):O.framebufferTexture2D(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,Mt.__webglTexture,Z),ws?O.framebufferTextureLayer(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,un.__webglTexture,Pe,an+Qn):O.framebufferTexture2D(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,un.__webglTexture,Pe),Z!==0?O.blitFramebuffer(Ze,pt,Ze+Ue,pt+Ie,Ye,At,Ye+Ue,At+Ie,O.COLOR_BUFFER_BIT,O.NEAREST):ws?O.copyTexSubImage3D(Ge,Pe,Ye,At,an+Qn,Ze,pt,Ue,Ie):O.copyTexSubImage2D(Ge,Pe,Ye,At,Ze,pt,Ue,Ie);we.bindFramebuffer(O.READ_FRAMEBUFFER,null),we.bindFramebuffer(O.DRAW_FRAMEBUFFER,null)}else ws?R.isDataTexture||R.isData3DTexture?O.texSubImage3D(Ge,Pe,Ye,At,an,Ue,Ie,Oe,qt,An,Xt.data):H.isCompressedArrayTexture?O.compressedTexSubImage3D(Ge,Pe,Ye,At,an,Ue,Ie,Oe,qt,Xt.data):O.texSubImage3D(Ge,Pe,Ye,At,an,Ue,Ie,Oe,qt,An,Xt):R.isDataTexture?O.texSubImage2D(O.TEXTURE_2D,Pe,Ye,At,Ue,Ie,qt,An,Xt.data):R.isCompressedTexture?O.compressedTexSubImage2D(O.TEXTURE_2D,Pe,Ye,At,Xt.width,Xt.height,qt,Xt.data):O.texSubImage2D(O.TEXTURE_2D,Pe,Ye,At,Ue,Ie,qt,An,Xt);we.pixelStorei(O.UNPACK_ROW_LENGTH,xn),we.pixelStorei(O.UNPACK_IMAGE_HEIGHT,Pt),we.pixelStorei(O.UNPACK_SKIP_PIXELS,Es),we.pixelStorei(O.UNPACK_SKIP_ROWS,vn),we.pixelStorei(O.UNPACK_SKIP_IMAGES,Kr),Pe===0&&H.generateMipmaps===!0&&H.mipmapsAutoUpdate===!0&&O.generateMipmap(Ge),we.unbindTexture()},this.initRenderTarget=function(R){$e.get(R).__webglFramebuffer===void 0&&tt.setupRenderTarget(R)},this.initTexture=function(R){R.isCubeTexture?tt.setTextureCube(R,0):R.isData3DTexture?tt.setTexture3D(R,0):R.isDataArrayTexture||R.isCompressedArrayTexture?tt.setTexture2DArray(R,0):tt.setTexture2D(R,0),we.unbindTexture()},this.resetState=function(){Y=0,G=0,ce=null,we.reset(),Re.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return Oi}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(e){this._outputColorSpace=e;let t=this.getContext();t.drawingBufferColorSpace=Ct._getDrawingBufferColorSpace(e),t.unpackColorSpace=Ct._getUnpackColorSpace()}};var ou=0,oy=1,Al=2,yp=3,Br=()=>({sign:[],signDark:[],foot:[],wire:[]}),au=class{constructor(e,t){this.pieces=e;let n=e.map(({geometry:c})=>ry(c)),s=e.map(({coarse:c})=>c?ry(c):null),r=[...n,...s.filter(c=>c!==null)],o=r.reduce((c,h)=>c+h.getAttribute("position").count,0),a=r.reduce((c,h)=>c+h.index.count,0);this.mesh=new Oa(e.length,o,a,t),this.mesh.frustumCulled=this.mesh.perObjectFrustumCulled=this.mesh.sortObjects=!1,this.mesh.castShadow=!t.transparent;let l=new et;n.forEach((c,h)=>{this.fine.push(this.mesh.addGeometry(c));let u=s[h];this.coarse.push(u?this.mesh.addGeometry(u):this.fine[h]);let d=this.mesh.addInstance(this.fine[h]),f=e[h].colour;f&&this.mesh.setColorAt(d,l.set(f))})}pieces;mesh;matrix=new Qe;fine=[];coarse=[];update(e){this.pieces.forEach(({holder:t,parent:n,body:s,thin:r},o)=>{let a=e[s]??ou,l=t.visible&&(n?.visible??!0)&&a<(r?Al:yp);this.mesh.setVisibleAt(o,l),l&&(this.mesh.setGeometryIdAt(o,a===ou?this.fine[o]:this.coarse[o]),t.updateMatrix(),n&&n.updateMatrix(),this.mesh.setMatrixAt(o,n?this.matrix.multiplyMatrices(n.matrix,t.matrix):t.matrix))})}said(e){return this.pieces[e]?.said??null}};function ry(i){let e=new wt,t=i.getAttribute("position");return e.setAttribute("position",t),e.setAttribute("normal",i.getAttribute("normal")),e.setIndex(i.index??new Bt(Uint32Array.from({length:t.count},(n,s)=>s),1)),e}Fe.line={worldUnits:{value:1},linewidth:{value:1},resolution:{value:new ue},dashOffset:{value:0},dashScale:{value:1},dashSize:{value:1},gapSize:{value:1}};hi.line={uniforms:Ml.merge([Fe.common,Fe.fog,Fe.line]),vertexShader:`
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
		`};var gs=class extends ki{constructor(e){super({type:"LineMaterial",uniforms:Ml.clone(hi.line.uniforms),vertexShader:hi.line.vertexShader,fragmentShader:hi.line.fragmentShader,clipping:!0}),this.isLineMaterial=!0,this.setValues(e)}get color(){return this.uniforms.diffuse.value}set color(e){this.uniforms.diffuse.value=e}get worldUnits(){return"WORLD_UNITS"in this.defines}set worldUnits(e){e===!0!==this.worldUnits&&(this.needsUpdate=!0),e===!0?this.defines.WORLD_UNITS="":delete this.defines.WORLD_UNITS}get linewidth(){return this.uniforms.linewidth.value}set linewidth(e){this.uniforms.linewidth&&(this.uniforms.linewidth.value=e)}get dashed(){return"USE_DASH"in this.defines}set dashed(e){e===!0!==this.dashed&&(this.needsUpdate=!0),e===!0?this.defines.USE_DASH="":delete this.defines.USE_DASH}get dashScale(){return this.uniforms.dashScale.value}set dashScale(e){this.uniforms.dashScale.value=e}get dashSize(){return this.uniforms.dashSize.value}set dashSize(e){this.uniforms.dashSize.value=e}get dashOffset(){return this.uniforms.dashOffset.value}set dashOffset(e){this.uniforms.dashOffset.value=e}get gapSize(){return this.uniforms.gapSize.value}set gapSize(e){this.uniforms.gapSize.value=e}get opacity(){return this.uniforms.opacity.value}set opacity(e){this.uniforms&&(this.uniforms.opacity.value=e)}get resolution(){return this.uniforms.resolution.value}set resolution(e){this.uniforms.resolution.value.copy(e)}get alphaToCoverage(){return"USE_ALPHA_TO_COVERAGE"in this.defines}set alphaToCoverage(e){this.defines&&(e===!0!==this.alphaToCoverage&&(this.needsUpdate=!0),e===!0?this.defines.USE_ALPHA_TO_COVERAGE="":delete this.defines.USE_ALPHA_TO_COVERAGE)}};var ay=new Ot,lu=new S,xr=class extends cl{constructor(){super(),this.isLineSegmentsGeometry=!0,this.type="LineSegmentsGeometry";let e=[-1,2,0,1,2,0,-1,1,0,1,1,0,-1,0,0,1,0,0,-1,-1,0,1,-1,0],t=[-1,2,1,2,-1,1,1,1,-1,-1,1,-1,-1,-2,1,-2],n=[0,2,1,2,3,1,2,4,3,4,5,3,4,6,5,6,7,5];this.setIndex(n),this.setAttribute("position",new ot(e,3)),this.setAttribute("uv",new ot(t,2))}applyMatrix4(e){let t=this.attributes.instanceStart,n=this.attributes.instanceEnd;return t!==void 0&&(t.applyMatrix4(e),n.applyMatrix4(e),t.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this}setPositions(e){let t;e instanceof Float32Array?t=e:Array.isArray(e)&&(t=new Float32Array(e));let n=new dr(t,6,1);return this.setAttribute("instanceStart",new Bi(n,3,0)),this.setAttribute("instanceEnd",new Bi(n,3,3)),this.instanceCount=this.attributes.instanceStart.count,this.computeBoundingBox(),this.computeBoundingSphere(),this}setColors(e){let t;e instanceof Float32Array?t=e:Array.isArray(e)&&(t=new Float32Array(e));let n=new dr(t,6,1);return this.setAttribute("instanceColorStart",new Bi(n,3,0)),this.setAttribute("instanceColorEnd",new Bi(n,3,3)),this}fromWireframeGeometry(e){return this.setPositions(e.attributes.position.array),this}fromEdgesGeometry(e){return this.setPositions(e.attributes.position.array),this}fromMesh(e){return this.fromWireframeGeometry(new tl(e.geometry)),this}fromLineSegments(e){let t=e.geometry;return this.setPositions(t.attributes.position.array),this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Ot);let e=this.attributes.instanceStart,t=this.attributes.instanceEnd;e!==void 0&&t!==void 0&&(this.boundingBox.setFromBufferAttribute(e),ay.setFromBufferAttribute(t),this.boundingBox.union(ay))}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Vn),this.boundingBox===null&&this.computeBoundingBox();let e=this.attributes.instanceStart,t=this.attributes.instanceEnd;if(e!==void 0&&t!==void 0){let n=this.boundingSphere.center;this.boundingBox.getCenter(n);let s=0;for(let r=0,o=e.count;r<o;r++)lu.fromBufferAttribute(e,r),s=Math.max(s,n.distanceToSquared(lu)),lu.fromBufferAttribute(t,r),s=Math.max(s,n.distanceToSquared(lu));this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&console.error("THREE.LineSegmentsGeometry.computeBoundingSphere(): Computed radius is NaN. The instanced position data is likely to have NaN values.",this)}}toJSON(){}};var xp=new Gt,ly=new S,cy=new S,Gn=new Gt,Wn=new Gt,ys=new Gt,vp=new S,_p=new Qe,Xn=new hl,hy=new S,cu=new Ot,hu=new Vn,xs=new Gt,vs,kr;function uy(i,e,t){return xs.set(0,0,-e,1).applyMatrix4(i.projectionMatrix),xs.multiplyScalar(1/xs.w),xs.x=kr/t.width,xs.y=kr/t.height,xs.applyMatrix4(i.projectionMatrixInverse),xs.multiplyScalar(1/xs.w),Math.abs(Math.max(xs.x,xs.y))}function BT(i,e){let t=i.matrixWorld,n=i.geometry,s=n.attributes.instanceStart,r=n.attributes.instanceEnd,o=Math.min(n.instanceCount,s.count);for(let a=0,l=o;a<l;a++){Xn.start.fromBufferAttribute(s,a),Xn.end.fromBufferAttribute(r,a),Xn.applyMatrix4(t);let c=new S,h=new S;vs.distanceSqToSegment(Xn.start,Xn.end,h,c),h.distanceTo(c)<kr*.5&&e.push({point:h,pointOnLine:c,distance:vs.origin.distanceTo(h),object:i,face:null,faceIndex:a,uv:null,uv1:null})}}function kT(i,e,t){let n=e.projectionMatrix,r=i.material.resolution,o=i.matrixWorld,a=i.geometry,l=a.attributes.instanceStart,c=a.attributes.instanceEnd,h=Math.min(a.instanceCount,l.count),u=-e.near;vs.at(1,ys),ys.w=1,ys.applyMatrix4(e.matrixWorldInverse),ys.applyMatrix4(n),ys.multiplyScalar(1/ys.w),ys.x*=r.x/2,ys.y*=r.y/2,ys.z=0,vp.copy(ys),_p.multiplyMatrices(e.matrixWorldInverse,o);for(let d=0,f=h;d<f;d++){if(Gn.fromBufferAttribute(l,d),Wn.fromBufferAttribute(c,d),Gn.w=1,Wn.w=1,Gn.applyMatrix4(_p),Wn.applyMatrix4(_p),Gn.z>u&&Wn.z>u)continue;if(Gn.z>u){let M=Gn.z-Wn.z,_=(Gn.z-u)/M;Gn.lerp(Wn,_)}else if(Wn.z>u){let M=Wn.z-Gn.z,_=(Wn.z-u)/M;Wn.lerp(Gn,_)}Gn.applyMatrix4(n),Wn.applyMatrix4(n),Gn.multiplyScalar(1/Gn.w),Wn.multiplyScalar(1/Wn.w),Gn.x*=r.x/2,Gn.y*=r.y/2,Wn.x*=r.x/2,Wn.y*=r.y/2,Xn.start.copy(Gn),Xn.start.z=0,Xn.end.copy(Wn),Xn.end.z=0;let y=Xn.closestPointToPointParameter(vp,!0);Xn.at(y,hy);let g=ci.lerp(Gn.z,Wn.z,y),m=g>=-1&&g<=1,x=vp.distanceTo(hy)<kr*.5;if(m&&x){Xn.start.fromBufferAttribute(l,d),Xn.end.fromBufferAttribute(c,d),Xn.start.applyMatrix4(o),Xn.end.applyMatrix4(o);let M=new S,_=new S;vs.distanceSqToSegment(Xn.start,Xn.end,_,M),t.push({point:_,pointOnLine:M,distance:vs.origin.distanceTo(_),object:i,face:null,faceIndex:d,uv:null,uv1:null})}}}var Go=class extends St{constructor(e=new xr,t=new gs({color:Math.random()*16777215})){super(e,t),this.isLineSegments2=!0,this.type="LineSegments2"}computeLineDistances(){let e=this.geometry,t=e.attributes.instanceStart,n=e.attributes.instanceEnd,s=new Float32Array(2*t.count);for(let o=0,a=0,l=t.count;o<l;o++,a+=2)ly.fromBufferAttribute(t,o),cy.fromBufferAttribute(n,o),s[a]=a===0?0:s[a-1],s[a+1]=s[a]+ly.distanceTo(cy);let r=new dr(s,2,1);return e.setAttribute("instanceDistanceStart",new Bi(r,1,0)),e.setAttribute("instanceDistanceEnd",new Bi(r,1,1)),this}raycast(e,t){let n=this.material.worldUnits,s=e.camera;if(s===null&&!n&&console.error('LineSegments2: "Raycaster.camera" needs to be set in order to raycast against LineSegments2 while worldUnits is set to false.'),n===!1&&(this.material.resolution.x===0||this.material.resolution.y===0))return;let r=e.params.Line2!==void 0&&e.params.Line2.threshold||0;vs=e.ray;let o=this.matrixWorld,a=this.geometry,l=this.material;kr=l.linewidth+r,a.boundingSphere===null&&a.computeBoundingSphere(),hu.copy(a.boundingSphere).applyMatrix4(o);let c;if(n)c=kr*.5;else{let u=Math.max(s.near,hu.distanceToPoint(vs.origin));c=uy(s,u,l.resolution)}if(hu.radius+=c,vs.intersectsSphere(hu)===!1)return;a.boundingBox===null&&a.computeBoundingBox(),cu.copy(a.boundingBox).applyMatrix4(o);let h;if(n)h=kr*.5;else{let u=Math.max(s.near,cu.distanceToPoint(vs.origin));h=uy(s,u,l.resolution)}cu.expandByScalar(h),vs.intersectsBox(cu)!==!1&&(n?BT(this,t):kT(this,s,t))}onBeforeRender(e){let t=this.material.uniforms;t&&t.resolution&&(e.getViewport(xp),this.material.uniforms.resolution.value.set(xp.z,xp.w))}};var HT=2,uu=class{constructor(e,t){this.actor=e;let n=[],s=new et;e.stage.bodies.forEach((o,a)=>{for(let l of o.links)this.ends.push({body:a,points:[o.centre_of_mass,l]}),s.set(o.colour),n.push(...s.toArray(),...s.toArray())}),this.material=new gs({linewidth:HT,vertexColors:!t,transparent:t,opacity:t?.4:1});let r=new xr;r.setPositions(new Float32Array(6*this.ends.length)),t||r.setColors(n),this.object=new Go(r,this.material),this.object.frustumCulled=!1,this.object.raycast=()=>{}}actor;object;ends=[];material;recolour(e){this.material.vertexColors||this.material.color.set(e)}update(){let e=new S,t=this.object.geometry.getAttribute("instanceStart"),n=t.data.array;this.ends.forEach(({body:s,points:r},o)=>{let a=this.actor.isBad[s];r.forEach((l,c)=>{this.actor.place(s,a?r[0]:l,e),e.toArray(n,6*o+3*c)})}),t.data.needsUpdate=!0}};var dy=[[.16,.2,.46],[.15,.41,.61],[.14,.6,.58],[.52,.77,.38],[.98,.86,.32]],zT=i=>i<=.04045?i/12.92:((i+.055)/1.055)**2.4,du=dy.map(i=>i.map(zT));function fu(i,e,t){let n=Math.min(Math.max(Number.isFinite(i)?i:0,0),1)*(du.length-1),s=Math.min(Math.floor(n),du.length-2),r=n-s;for(let o=0;o<3;o++)e[t+o]=du[s][o]*(1-r)+du[s+1][o]*r}function fy(){return`linear-gradient(90deg, ${dy.map(e=>`rgb(${e.map(t=>Math.round(255*t)).join(" ")})`).join(", ")})`}var pu=class{constructor(e,t){this.record=e;this.modes=t.rounded(e.modes),this.ranges=t.indices(e.stations),this.count=e.modes.numbers.shape[2]??0,this.tensor=new Float32Array(6*this.count),this.values=new Float32Array(e.stations.shape[0]??0)}record;values;peak=-1;modes;ranges;tensor;count;update(e,t){let{tensor:n,modes:s,count:r,values:o,ranges:a}=this,l=6*r;n.fill(0);for(let c=0;c*l<s.length;c++){let h=e[t+c];if(!(!Number.isFinite(h)||h===0))for(let u=0;u<l;u++)n[u]+=h*s[c*l+u]}this.peak=-1;for(let c=0;c<o.length;c++){let h=NaN;for(let u=a[2*c];u<a[2*c+1];u++){let d=this.vonMises(u);d<=h||(h=d)}o[c]=h,h>(o[this.peak]??0)&&(this.peak=c)}}vonMises(e){let{tensor:t,count:n}=this,[s,r,o]=[t[e],t[n+e],t[2*n+e]],[a,l,c]=[t[3*n+e],t[4*n+e],t[5*n+e]];return Math.sqrt(.5*((s-r)**2+(r-o)**2+(o-s)**2)+3*(a*a+l*l+c*c))}};var VT=40,GT=28,WT=4e4;function bp(i,e){return e==="x"?i.rotateZ(-Math.PI/2):e==="z"&&i.rotateX(Math.PI/2),i}function XT(i,e,t,n){let s=t/2,r=[[e,-s],[i,-s],[i,s],[e,s],[e,-s]],o=new Qa(r.map(([a,l])=>new ue(a,l)),n).toNonIndexed();return o.computeVertexNormals(),qT(o),o}function qT(i){let e=i.getAttribute("position"),t=i.getAttribute("normal");for(let n=0;n<e.count;n++){if(Math.abs(t.getY(n))>.5)continue;let s=Math.hypot(e.getX(n),e.getZ(n))||1,r=Math.sign(t.getX(n)*e.getX(n)+t.getZ(n)*e.getZ(n))||1;t.setXYZ(n,r*e.getX(n)/s,0,r*e.getZ(n)/s)}}function YT(i){let e=new Do(i.outline.map(([l,c])=>new ue(l,c))),t=i.size[0]??1,n=new ja(e,{depth:t,bevelEnabled:!1,steps:1});n.translate(0,0,-t/2);let[s,r,o]=[new S(1,0,0),new S(0,1,0),new S(0,0,1)],a=new Qe;return i.along==="x"?a.makeBasis(r,o,s):i.along==="y"&&a.makeBasis(o,s,r),n.applyMatrix4(a)}function Rl(i,e){let t=new wt;return t.setAttribute("position",new Bt(i,3)),t.setIndex(new Bt(e,1)),t}function $T(i){let e=i.toNonIndexed();return e.computeVertexNormals(),e}function Cl(i,e,t=VT){let[n=1,s=1,r=1]=i.size,o;switch(i.kind){case"box":o=new pn(n,s,r);break;case"cylinder":o=bp(new Kt(n,n,s,t),i.along);break;case"capsule":o=bp(new za(n,s,Math.ceil(.3*t),t),i.along);break;case"tube":o=bp(XT(n,s,r,t),i.along);break;case"sphere":o=new on(n,t,t/2);break;case"ellipsoid":o=new on(1,t,t/2).scale(n,s,r);break;case"extrusion":o=YT(i);break;case"mesh":if(!i.vertices||!i.triangles)throw new Error("a mesh without vertices");o=$T(Rl(e.floats(i.vertices),e.indices(i.triangles)))}return o.translate(...i.centre)}function mu(i,e){return i.kind==="sphere"||i.kind==="ellipsoid"||i.kind==="capsule"||(e.index?.count??e.getAttribute("position").count)/3>WT?null:new Va(e,GT)}var ZT=new S(0,1,0);function py(i,e,t,n){let s=i.distanceTo(e),r=new Kt(t,t,s||1e-9,n,1,!0),o=new nt().setFromUnitVectors(ZT,e.clone().sub(i).normalize()),a=i.clone().add(e).multiplyScalar(.5);return r.applyMatrix4(new Qe().compose(a,o,new S(1,1,1)))}function Mp(i,e,t){return new on(e,t,Math.round(.7*t)).translate(i.x,i.y,i.z)}var JT=.55,KT=.012,jT=1.001,gu=class{constructor(e,t,n,s){this.record=e;this.rest=t.floats(e.vertices),this.modes=t.floats(e.modes),this.field=e.field?t.floats(e.field):null,this.count=this.rest.length/3,this.values=new Float32Array(this.count),this.stressed=e.stress?new pu(e.stress,t):null,this.scale=this.ownScale,this.modeCount=e.modes.shape[0]??0;let r=Rl(this.rest.slice(),t.indices(e.triangles));r.setAttribute("color",new Bt(new Float32Array(3*this.count).fill(1),3)),r.computeVertexNormals();let o=new Hs({vertexColors:!0,shininess:20,specular:1710618,side:Sn,transparent:n,opacity:n?.25:1});this.mesh=new St(r,o),this.mesh.castShadow=!n,this.mesh.frustumCulled=!1,this.mesh.userData={kind:"body",name:e.name},this.peak=new St(new on(KT*s,16,12),new Rn({color:13632027,depthTest:!1,transparent:!0})),this.peak.renderOrder=2,this.peak.visible=!1,this.mesh.add(this.peak)}record;mesh;values;stressed;exaggeration=1;showsStress=!1;scale;seen=0;peak;near=new WeakMap;rest;modes;field;count;modeCount;get ownScale(){let{quantity:e,unit:t,low:n,high:s,stress:r}=this.record;return this.showsStress&&r?{quantity:"von Mises stress",unit:"Pa",low:0,high:r.high}:{quantity:e,unit:t,low:n,high:s>n?s:this.seen}}get peakValue(){return this.stressed&&this.stressed.peak>=0?this.stressed.values[this.stressed.peak]:0}carried(e,t,n,s){let r=this.near.get(e);r||this.near.set(e,r=this.nearest(e)),s.set(0,0,0);for(let o=0;o<this.modeCount;o++){let a=t[n+this.record.first+o]/r.length;for(let l of r){let c=3*(this.count*o+l);s.x+=a*this.modes[c],s.y+=a*this.modes[c+1],s.z+=a*this.modes[c+2]}}return s}nearest([e,t,n]){let s=Array.from({length:this.count},(o,a)=>Math.hypot(this.rest[3*a]-e,this.rest[3*a+1]-t,this.rest[3*a+2]-n)),r=s.reduce((o,a)=>Math.min(o,a));return s.flatMap((o,a)=>o<=jT*r+1e-12?[a]:[])}update(e,t){let{count:n,modes:s,rest:r,field:o}=this,a=this.mesh.geometry.getAttribute("position"),l=this.mesh.geometry.getAttribute("color"),c=a.array,h=new Float32Array(3*n),u=new Float32Array(n);for(let m=0;m<this.modeCount;m++){let x=e[t+this.record.first+m];if(!Number.isFinite(x)||x===0)continue;let M=3*n*m;for(let _=0;_<3*n;_++)h[_]+=x*s[M+_];if(o)for(let _=0;_<n;_++)u[_]+=x*o[n*m+_]}this.showsStress&&this.stressed?.update(e,t+this.record.first);let{low:d,high:f}=this.scale,p=f>d?f-d:1,y=l.array;for(let m=0;m<n;m++){let[x,M,_]=[h[3*m],h[3*m+1],h[3*m+2]];c[3*m]=r[3*m]+this.exaggeration*x,c[3*m+1]=r[3*m+1]+this.exaggeration*M,c[3*m+2]=r[3*m+2]+this.exaggeration*_;let C=this.showsStress?this.stressed.values[m]:o?u[m]:Math.hypot(x,M,_);this.values[m]=C,C>this.seen&&(this.seen=C),Number.isNaN(C)?y.fill(JT,3*m,3*m+3):fu((C-d)/p,y,3*m)}let g=this.showsStress?this.stressed.peak:-1;this.peak.visible=g>=0,g>=0&&this.peak.position.fromArray(c,3*g),a.needsUpdate=!0,l.needsUpdate=!0,this.mesh.geometry.computeVertexNormals()}};function Sp(i,e=!1){let t=i[0].index!==null,n=new Set(Object.keys(i[0].attributes)),s=new Set(Object.keys(i[0].morphAttributes)),r={},o={},a=i[0].morphTargetsRelative,l=new wt;l.morphTargetsRelative=a;let c=0;for(let h=0;h<i.length;++h){let u=i[h],d=0,f=0;if(t!==(u.index!==null))return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+". All geometries must have compatible attributes; make sure index attribute exists among all geometries, or in none of them."),null;for(let p in u.attributes){if(!n.has(p))return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+'. All geometries must have compatible attributes; make sure "'+p+'" attribute exists among all geometries, or in none of them.'),null;r[p]===void 0&&(r[p]=[]),r[p].push(u.attributes[p]),d++}if(d!==n.size)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+". Make sure all geometries have the same number of attributes."),null;if(a!==u.morphTargetsRelative)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+". .morphTargetsRelative must be consistent throughout all geometries."),null;for(let p in u.morphAttributes){if(!s.has(p))return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+".  .morphAttributes must be consistent throughout all geometries."),null;if(u.morphAttributes[p].length!==i[0].morphAttributes[p].length)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+'. All geometries must have the same number of morph targets for the "'+p+'" morph attribute.'),null;o[p]===void 0&&(o[p]=[]),o[p].push(u.morphAttributes[p]),f++}if(f!==s.size)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+". Make sure all geometries have the same number of morph attributes."),null;if(e){let p;if(t)p=u.index.count;else if(u.attributes.position!==void 0)p=u.attributes.position.count;else return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+". The geometry must have either an index or a position attribute"),null;l.addGroup(c,p,h),c+=p}}if(t){let h=0,u=[];for(let d=0;d<i.length;++d){let f=i[d].index;for(let p=0;p<f.count;++p)u.push(f.getX(p)+h);h+=i[d].attributes.position.count}l.setIndex(u)}for(let h in r){let u=my(r[h]);if(!u)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed while trying to merge the "+h+" attribute."),null;l.setAttribute(h,u)}for(let h in o){let u=o[h][0].length;if(u!==0){l.morphAttributes=l.morphAttributes||{},l.morphAttributes[h]=[];for(let d=0;d<u;++d){let f=[];for(let y=0;y<o[h].length;++y)f.push(o[h][y][d]);let p=my(f);if(!p)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed while trying to merge the "+h+" morphAttribute."),null;l.morphAttributes[h].push(p)}}}return l}function my(i){let e,t,n,s=-1,r=0;for(let c=0;c<i.length;++c){let h=i[c];if(e===void 0&&(e=h.array.constructor),e!==h.array.constructor)return console.error("THREE.BufferGeometryUtils: .mergeAttributes() failed. BufferAttribute.array must be of consistent array types across matching attributes."),null;if(t===void 0&&(t=h.itemSize),t!==h.itemSize)return console.error("THREE.BufferGeometryUtils: .mergeAttributes() failed. BufferAttribute.itemSize must be consistent across matching attributes."),null;if(n===void 0&&(n=h.normalized),n!==h.normalized)return console.error("THREE.BufferGeometryUtils: .mergeAttributes() failed. BufferAttribute.normalized must be consistent across matching attributes."),null;if(s===-1&&(s=h.gpuType),s!==h.gpuType)return console.error("THREE.BufferGeometryUtils: .mergeAttributes() failed. BufferAttribute.gpuType must be consistent across matching attributes."),null;r+=h.count*t}let o=new e(r),a=new Bt(o,t,n),l=0;for(let c=0;c<i.length;++c){let h=i[c];if(h.isInterleavedBufferAttribute){let u=l/t;for(let d=0,f=h.count;d<f;d++)for(let p=0;p<t;p++){let y=h.getComponent(d,p);a.setComponent(d+u,p,y)}}else o.set(h.array,l);l+=h.count*t}return s!==void 0&&(a.gpuType=s),a}var Qi=class{constructor(e,t,n){this.owners=n;this.mesh=new Pr(e,t,n.length),this.mesh.frustumCulled=!1,this.mesh.userData={instances:this},n.forEach((s,r)=>this.hide(r))}owners;mesh;matrix=new Qe;set(e,t,n,s){this.mesh.setMatrixAt(e,this.matrix.compose(t,n,s))}hide(e){this.mesh.setMatrixAt(e,this.matrix.makeScale(0,0,0))}done(){this.mesh.instanceMatrix.needsUpdate=!0,this.mesh.boundingSphere=null}said(e){return this.owners[e??-1]??null}};var vy=[13780799,2595413,3108822],Pl=.09,gy=.7,QT=.014,e1=.16,yy=.0012,t1=["revolute","cylindrical","translational","screw","planar","point-on-line","point-on-plane","revolute-spherical","revolute-cylindrical","revolute-translational","universal","cylindrical-on-beam","translational-on-beam"],yu=class{constructor(e){this.actor=e}actor;made=new Map;at=new S;turn=new nt;scale=new S;show(e,t){t&&!this.made.has(e)&&this.made.set(e,this.make(e));let n=this.made.get(e);n&&(n.instances.mesh.visible=t)}update(e){for(let[t,{spots:n,instances:s}]of this.made)s.mesh.visible&&(n.forEach(({body:r,point:o,turn:a,size:l},c)=>{if(this.actor.isBad[r]||(e[r]??0)>=Al){s.hide(c);return}t==="triads"?this.at.copy(this.actor.holder(r).position):this.actor.place(r,o,this.at),this.turn.copy(this.actor.holder(r).quaternion).multiply(a),s.set(c,this.at,this.turn,this.scale.setScalar(l))}),s.done())}make(e){let t=this.spots(e),{geometry:n,material:s}=this.looks(e),r=new Qi(n,s,t.map(({owner:o})=>o));return this.actor.root.add(r.mesh),{spots:t,instances:r}}looks(e){return e==="centres"?{geometry:new on(QT,16,12),material:this.actor.palette.signDark}:e==="axes"?{geometry:n1(),material:new Rn({color:vy[2],depthTest:!1,transparent:!0,opacity:.75})}:{geometry:i1(),material:new Rn({vertexColors:!0})}}spots(e){let{stage:t,nearness:n}=this.actor,s=new nt;switch(e){case"triads":case"centres":return t.bodies.map((r,o)=>({owner:{kind:"body",name:r.name},body:o,point:e==="triads"?[0,0,0]:r.centre_of_mass,turn:s,size:n.body(o)}));case"markers":return t.markers.map(({body:r,point:o,x_axis:a,axis:l})=>({owner:{kind:"body",name:t.bodies[r].name},body:r,point:o,turn:xy(l,a),size:gy*n.body(r)}));case"joints":case"axes":return t.joints.flatMap(r=>e==="axes"&&!t1.includes(r.kind)?[]:[0,1].filter(a=>e==="joints"&&!(a&&r.kind.endsWith("-on-beam"))||a===r.place||r.kind==="universal").map(a=>({owner:{kind:"joint",name:r.name},body:r.bodies[a],point:r.points[a],turn:xy(r.axes[a],r.x_axes?.[a]),size:(e==="joints"?gy:1)*n.joint(r)})))}}};function xy(i,e){let t=new S(...i).normalize();if(!e)return new nt().setFromUnitVectors(new S(0,0,1),t);let n=new S(...e);return n.addScaledVector(t,-n.dot(t)).normalize(),new nt().setFromRotationMatrix(new Qe().makeBasis(n,new S().crossVectors(t,n),t))}function n1(){return new Kt(yy,yy,2*e1,6).rotateX(Math.PI/2)}function i1(){let i=.028*Pl,e=vy.map((t,n)=>{let s=new Kt(i,i,.8*Pl,6).translate(0,.4*Pl,0),r=new gi(3*i,.2*Pl,10).translate(0,.9*Pl,0),o=Sp([s,r]);n===0&&o.rotateZ(-Math.PI/2),n===2&&o.rotateX(Math.PI/2);let a=Array.from({length:o.getAttribute("position").count},()=>new et(t).toArray()).flat();return o.setAttribute("color",new ot(a,3)),o});return Sp(e)}function Ep(){let i=getComputedStyle(document.documentElement),e=t=>i.getPropertyValue(`--${t}`).trim();return{dark:matchMedia("(prefers-color-scheme: dark)").matches,sky:e("sky"),ground:e("floor"),grid:e("mesh-line"),ink:e("ink"),paper:e("card"),soft:e("soft"),accent:e("accent"),reaction:e("reaction"),moment:e("moment"),applied:e("applied"),trace:[0,1,2,3,4,5,6,7].map(t=>e(`tone-${t}`))}}var wp=["sign","signDark","foot","wire"],xu=class{constructor(e,t){this.ghost=t;if(this.body=new Hs({shininess:28,specular:2236962,polygonOffset:!0,polygonOffsetFactor:1,polygonOffsetUnits:1,transparent:t,opacity:t?.24:1,depthWrite:!t,side:Sn}),this.edge=new Jn({transparent:!0,opacity:t?.35:.5}),this.sign=new ai,this.signDark=new ai,this.foot=new ai,this.wire=new ai,t)for(let n of[this.sign,this.signDark,this.foot,this.wire])Object.assign(n,{transparent:!0,opacity:.3,depthWrite:!1});this.recolour(e)}ghost;body;own=[];edge;sign;signDark;foot;wire;bodyOf(e){let t=this.body.clone();return this.ghost||t.color.set(e),this.own.push(t),t}recolour(e){if(this.edge.color.set(e.dark?"#0b0f14":"#1b2430"),this.sign.color.set(e.dark?"#dfe6ee":"#ffffff"),this.signDark.color.set(e.dark?"#aab6c4":"#39434f"),this.foot.color.set(e.dark?"#566272":"#9aa5b2"),this.wire.color.set(e.dark?"#c2ccd8":"#56616f"),this.ghost)for(let t of[this.body,...this.own])t.color.set(e.soft)}};var vu=class{constructor(e){this.stage=e;this.bodies=e.bodies.map(s1)}stage;bodies;body(e){return this.atMost(this.bodies[e]??0)}joint(e){return this.between(e.bodies)}between(e){let t=e.map(n=>this.bodies[n]??0).filter(n=>n>0);return this.atMost(t.length?Math.min(...t):0)}atMost(e){return e>1e-9*this.stage.size?Math.min(this.stage.size,6*e):this.stage.size}};function s1(i){let e=[...i.held,i.centre_of_mass],t=[0,1,2].map(n=>{let s=e.map(r=>r[n]);return s.reduce((r,o)=>Math.max(r,o))-s.reduce((r,o)=>Math.min(r,o))});return Math.max(Math.hypot(...t),...i.parts.map(r1))}function r1(i){let[e=0,t=0,n=0]=i.size;switch(i.kind){case"box":return Math.max(e,t,n);case"sphere":return 2*e;case"ellipsoid":return 2*Math.max(e,t,n);case"cylinder":case"capsule":return Math.max(2*e,t);case"tube":return Math.max(2*e,n);case"extrusion":return Math.max(e,...i.outline.map(([s,r])=>2*Math.hypot(s,r)));case"mesh":return 0}}var o1=.021,_y=new S(0,0,1);function Tp(i,e,t,n){if(i.rod)return[];let s=o1*t,r=new S(...i.points[i.place]),o=new S(...i.slot&&i.place===1?i.slot:i.axes[i.place]).normalize(),a=new Qe().compose(r,new nt().setFromUnitVectors(_y,o),new S(1,1,1)),l=a1(i.kind,s,n).map(({tone:u,geometry:d})=>({tone:u,geometry:d.applyMatrix4(a),standing:!1})),c=i.bodies[0]<0?0:i.bodies[1]<0?1:-1,h=c<0?[]:c1(i,c,e,s).map(u=>({tone:"foot",geometry:u,standing:!0}));return[...l,...h]}function a1(i,e,t){let n=a=>({tone:"sign",geometry:a}),s=a=>({tone:"signDark",geometry:a}),r=(a,l)=>new Kt(a,a,l,t).rotateX(Math.PI/2),o=a=>new on(a,t,Math.round(.7*t));switch(i){case"revolute":return[n(r(.95*e,1.9*e)),s(r(.42*e,2.7*e))];case"cylindrical":return[n(r(.95*e,1.9*e)),s(r(.42*e,4.4*e))];case"screw":{let a=[-.6,0,.6].map(l=>s(new Ci(.95*e,.14*e,8,24).translate(0,0,l*e)));return[n(r(.9*e,1.9*e)),s(r(.42*e,4.4*e)),...a]}case"translational":return[n(new pn(1.7*e,1.7*e,2.8*e))];case"spherical":return[n(o(1.1*e))];case"universal":return[s(r(.36*e,2.8*e)),s(r(.36*e,2.8*e).rotateX(Math.PI/2)),n(o(.62*e))];case"fixed":return[s(new pn(1.5*e,1.5*e,1.5*e))];case"planar":return[n(new pn(4.2*e,4.2*e,.3*e))];case"point-on-beam":case"keyed-on-beam":return[n(o(.9*e)),...i==="keyed-on-beam"?[s(new pn(2.6*e,.5*e,.5*e))]:[]];case"cylindrical-on-beam":return[n(r(1.1*e,2.8*e)),s(r(.5*e,3.4*e))];case"translational-on-beam":return[n(new pn(1.9*e,1.9*e,2.8*e))];case"point-on-line":return[s(r(.22*e,6*e)),n(o(.8*e))];case"point-on-plane":return[n(new pn(4.2*e,4.2*e,.16*e)),s(o(.7*e))];default:return[n(o(.9*e))]}}var l1=["translational","cylindrical","screw","point-on-line"];function c1(i,e,t,n){let s=new S(...i.points[e]),r=new S(...t.up),o=new S(1,1,1);if(l1.includes(i.kind)||i.slot){let u=new S(...i.slot??i.axes[e]).normalize(),d=Math.max(.62*h1(u,t),4*n),f=new S(...t.low).add(new S(...t.high)).multiplyScalar(.5).add(new S(...t.origin)),p=Math.max(Math.min(f.sub(s).dot(u),d-3*n),3*n-d),y=new Kt(.24*n,.24*n,2*d,12).rotateX(Math.PI/2),g=new nt().setFromUnitVectors(_y,u);return[y.applyMatrix4(new Qe().compose(s.addScaledVector(u,p),g,o))]}let a=new nt().setFromUnitVectors(new S(0,1,0),r),l=new gi(1.5*n,2.5*n,4,1).rotateY(Math.PI/4).translate(0,-2*n,0),c=new pn(3.4*n,.3*n,3.4*n).translate(0,-3.35*n,0),h=new Qe().compose(s,a,o);return[l.applyMatrix4(h),c.applyMatrix4(h)]}function h1(i,e){let t=new S(...e.high).sub(new S(...e.low));return .5*(Math.abs(i.x)*t.x+Math.abs(i.y)*t.y+Math.abs(i.z)*t.z)}var u1=.16,by=1.015,d1={x:0,y:1,z:2};function Sy(i){let[e=1,t=1,n=1]=i.size,s;if(i.kind==="cylinder")s=My(.3*e,e,t);else if(i.kind==="tube")s=My(t,e,n);else if(i.kind==="sphere")s=new Ci(e,.03*e,6,32,Math.PI);else return null;let r=d1[i.along]??2;return r===0?s.rotateY(Math.PI/2):r===1&&s.rotateX(-Math.PI/2),s.translate(...i.centre)}function My(i,e,t){let n=by*e-i;return new pn(n,u1*e,t+2*(by-1)*e).translate(i+.5*n,0,0)}function Ey(i){let e=new et(i),{h:t,s:n,l:s}=e.getHSL({h:0,s:0,l:0});return`#${e.setHSL(t,n,s>.25?.55*s:s+.3).getHexString()}`}var f1=.0042,wy=.0024,Ty=new S(0,1,0),p1=new S(0,0,1),Ay=new S(1,1,1);function Ry(i){let e={moving:[],pieces:Br()};for(let t of i.stage.couplings){let n={kind:"coupling",name:t.name},s=(r,o)=>e.pieces.wire.push({geometry:r,body:-1,holder:i.holder(o),said:n});for(let r of t.wheels)for(let o of m1(r,Cy(i,r)))s(o,r.body);for(let{body:r,point:o,along:a,half:l}of t.tracks){let c=new nt().setFromUnitVectors(Ty,new S(...a).normalize()),h=new Kt(.02*l,.02*l,2*l,8);s(h.applyMatrix4(new Qe().compose(new S(...o),c,Ay)),r)}t.belt!=="none"&&e.moving.push(...g1(i,t,n,e.pieces.wire)),e.moving.push(...y1(i,t,n,e.pieces.wire))}return e}var Cy=(i,e)=>Math.min(2.5*f1*e.radius+.3*wy*i.stage.size,.2*e.radius);function m1({centre:i,axis:e,radius:t},n){let s=new nt().setFromUnitVectors(p1,new S(...e).normalize()),r=new Qe().compose(new S(...i),s,Ay),o=new Kt(.6*n,.6*n,.22*t,8).translate(0,.89*t,0);return[new Ci(t,n,8,72),o].map(a=>a.applyMatrix4(r))}function Py(i,e,t,n,s){let r=new cn,o=new Kt(i,i,1,8).translate(0,.5,0);t.push({geometry:o,body:-1,holder:r,said:e});let a=new S,l=new S;return{object:r,update(){if(r.visible=!n(),!r.visible)return;s(a,l),r.position.copy(a);let c=l.sub(a).length();r.scale.set(1,Math.max(c,1e-12),1),c>0&&r.quaternion.setFromUnitVectors(Ty,l.divideScalar(c))}}}function g1(i,{wheels:e,belt:t},n,s){let[r,o]=e;if(!r||!o)return[];let a=t==="crossed"?-1:1,l=new S,c=new S,h=new S,u=new S;return[1,-1].map(d=>Py(Cy(i,r),n,s,()=>e.some(({body:f})=>i.isBad[f]),(f,p)=>{l.set(...r.axis).applyQuaternion(i.holder(r.body).quaternion).normalize(),i.place(r.body,r.centre,c),i.place(o.body,o.centre,h).sub(c);let y=h.dot(l);h.addScaledVector(l,-y);let g=h.length();h.divideScalar(g||1),u.crossVectors(l,h);let m=Math.min(Math.max((r.radius-a*o.radius)/(g||1),-1),1),x=d*Math.sqrt(1-m*m);f.copy(c).addScaledVector(h,r.radius*m).addScaledVector(u,r.radius*x),p.copy(c).addScaledVector(l,y).addScaledVector(h,g+a*o.radius*m),p.addScaledVector(u,a*o.radius*x)}))}function y1(i,e,t,n){return e.joined.slice(1).map((s,r)=>{let o=e.joined[r];return Py(wy*i.stage.size,t,n,()=>i.isBad[o.body]||i.isBad[s.body]||!1,(a,l)=>{i.place(o.body,o.point,a),i.place(s.body,s.point,l)})})}var x1=20,v1=new S(0,0,1);function Ap(i,e,t,n){let s=e.points[0],r=e.bodies[0];if(!s||r===void 0)return;let o=new nt().setFromUnitVectors(v1,new S(...e.axis??[0,0,1]).normalize()),a=new Qe().compose(new S(...s),o,new S(1,1,1)),l=i.nearness.between(e.bodies);for(let[c,h]of _1(e,l,i.stage.forces.length>x1))n[c].push({geometry:h.applyMatrix4(a),thin:!0,body:r,holder:i.holder(r),said:{kind:t,name:e.name}})}function _1(i,e,t){switch(i.look){case"coil":return[["wire",b1(e,t)]];case"bushing":return[["signDark",new Ci(.02*e,.009*e,12,28)]];case"turn":return M1(e);case"slide":return S1(e);case"ring":return[["wire",new Ci(.034*e,.0045*e,8,t?20:36)]];case"dot":return[["wire",new el(.015*e)]];default:return[]}}function b1(i,e){let t=Array.from({length:80},(n,s)=>{let r=s/79*5*Math.PI,o=i*(.012+.026*(s/79));return new S(o*Math.cos(r),o*Math.sin(r),0)});return new Lr(new lr(t),e?50:120,.0036*i,e?4:6)}function M1(i){let e=.036*i,t=1.5*Math.PI,n=new gi(.0125*i,.028*i,14).translate(0,.01*i,0);return n.rotateZ(t).translate(e*Math.cos(t),e*Math.sin(t),0),[["wire",new Ci(e,.0045*i,8,30,t)],["wire",n]]}function S1(i){let[e,t]=[.045*i,.036*i],n=new Kt(.0045*i,.0045*i,2*e,10).rotateX(Math.PI/2),s=[1,-1].map(r=>new gi(.0125*i,.028*i,14).rotateX(r*Math.PI/2).translate(0,0,r*e));return[n,...s].map(r=>["wire",r.translate(t,0,0)])}var Iy=12,E1=.12;function Ly(i,e,t){let[n=0,s=0,r=0]=e.sizes,[o,,a]=e.bodies,l={kind:"force",name:e.name},[c,h]=[0,1].map(P=>new S(...e.points[P])),u=c.clone().sub(h),d=u.length();u.normalize();let f=new S(...e.axis??[0,0,1]).cross(u).normalize(),p=u.clone().cross(f),y=Math.PI*n,g=2*(d+y),m=Math.max(Math.round(g*Iy/(2*y)),3),x=g/m,M=new Dt,_=Array.from({length:m},()=>{let P=new cn;return M.add(P),t.pieces.foot.push({geometry:new pn((1-E1)*x,s,r),body:-1,holder:P,parent:M,said:l}),P}),C=new S,T=new S,v=new Qe,E=(P,I)=>{let k=I<d+y,V=k?I:I-d-y,F=Math.max(V-d,0)/n,z=k?1:-1;C.copy(u).multiplyScalar(-z*Math.cos(F)).addScaledVector(p,z*Math.sin(F)),T.copy(p).multiplyScalar(-z*Math.cos(F)).addScaledVector(u,-z*Math.sin(F)),P.position.copy(k?c:h).addScaledVector(u,-z*Math.min(V,d)),P.position.addScaledVector(p,n+.5*r).addScaledVector(T,n),v.makeBasis(C,f,C.clone().cross(f)),P.quaternion.setFromRotationMatrix(v)},N=new nt;t.moving.push({object:M,update(){if(M.visible=!e.bodies.some(k=>i.isBad[k]),!M.visible)return;i.place(o,[0,0,0],M.position),M.quaternion.copy(i.holder(o).quaternion),N.copy(M.quaternion).invert().multiply(i.holder(a).quaternion);let I=(2*Math.atan2(N.x*f.x+N.y*f.y+N.z*f.z,N.w)*Iy/(2*Math.PI)%1+1)%1;_.forEach((k,V)=>E(k,(V+I)*x))}})}var Rp=24,_u=class{constructor(e,t,n,s){this.actor=e;this.force=t;this.winding=n;this.motion=s;this.most=t.points.length-1+Rp*n.radii.filter(r=>r).length,this.near=[...n.arcs]}actor;force;winding;motion;most;near;table=null;x=new S;y=new S;axis=new S;points(){let{motion:e,actor:t}=this;e&&e.count>1&&(this.table??=this.follow(e),this.table[e.at(t.time)].forEach((s,r)=>this.near[r]=s));let n=this.layOut(t.frame);return n.flatMap((s,r)=>this.around(s,n[r-1]??null))}follow(e){let t=new Float32Array(e.layout.width);return Array.from({length:e.count},(n,s)=>(e.sample(e.time[s],t),this.layOut(t),[...this.near]))}layOut(e){let{actor:t,force:n,winding:s,axis:r,x:o,y:a}=this;t.turnIn(e,n.bodies[s.carrier],s.axis,r).normalize(),o.set(Math.abs(r.x)<.6?1:0,Math.abs(r.x)<.6?0:1,0).cross(r).normalize(),a.crossVectors(r,o);let l=n.points.map((d,f)=>{let p=t.placeIn(e,n.bodies[f],d,new S);return{number:f,centre:p,x:p.dot(o),y:p.dot(a),radius:s.radii[f],ux:0,uy:0,arc:0}}),c=[l[0],l[l.length-1]],h=c.map(({number:d},f)=>t.turnIn(e,n.bodies[d],s.fixed[f],new S));if(this.find(l,h),l.forEach(({arc:d,number:f})=>{Number.isFinite(d)&&(this.near[f]=d)}),l.every(({arc:d})=>d>=0))return l;let u=l.filter(d=>c.includes(d)||d.arc>=0);return c.forEach((d,f)=>{d.arc>=0||(d.centre.addScaledVector(h[f],Math.abs(d.radius)),Object.assign(d,{x:d.centre.dot(o),y:d.centre.dot(a),radius:0}))}),this.find(u,h),u}find(e,t){for(let n=1;n<e.length;n++){let[s,r]=[e[n-1],e[n]],[o,a,l]=[r.x-s.x,r.y-s.y,r.radius-s.radius],c=o*o+a*a,h=Math.sqrt(Math.max(c-l*l,0));s.ux=(o*h+a*l)/c,s.uy=(a*h-o*l)/c}e.forEach((n,s)=>{let r=Math.sign(n.radius),o=e[s-1],a=s===e.length-1;if(n.arc=0,!r)return;if(o&&!a){n.arc=this.next(n,r*(o.ux*n.uy-o.uy*n.ux),o.ux*n.ux+o.uy*n.uy);return}let{ux:l,uy:c}=o??n,[h,u]=[r*c,-r*l],d=t[o?1:0],[f,p]=[d.dot(this.x),d.dot(this.y)];n.arc=this.next(n,(o?-r:r)*(f*u-p*h),f*h+p*u)})}next({number:e},t,n){let s=Math.atan2(t,n);return s+2*Math.PI*Math.round((this.near[e]-s)/(2*Math.PI))}around(e,t){let{centre:n,radius:s}=e;if(!s)return[n];let{ux:r,uy:o}=t??e,a=Math.min(e.arc,2*Math.PI)*Math.sign(s),l=Math.atan2(-s*r,s*o)-(t?0:a);return Array.from({length:Rp+1},(c,h)=>{let u=l+a*h/Rp;return n.clone().addScaledVector(this.x,Math.abs(s)*Math.cos(u)).addScaledVector(this.y,Math.abs(s)*Math.sin(u))})}};var w1=.0042,T1=.021,Ny=.0075,A1=.0135,Fy=.0016,R1=.012,Dy=9,C1=["spring","damper","spring-damper","cylinder"],P1=20,bu=new S(0,0,1);function Uy(i,e){let t={moving:[],pieces:Br()};for(let n of i.stage.joints)n.rod&&I1(i,n,t);for(let n of i.stage.forces)n.look==="plane"?t.moving.push(B1(i,n)):n.winding?N1(i,n,n.winding,e,t):n.look==="rope"?D1(i,n,t):n.look==="track"?Ly(i,n,t):C1.includes(n.look)?U1(i,n,t):Ap(i,n,"force",t.pieces);for(let n of i.stage.drivers)Ap(i,n,"driver",t.pieces);return t}function Cp(i,e,t,n,s){let r=new S,o=new S;return{object:n,update(){i.place(e[0],t[0],r),i.place(e[1],t[1],o);let a=e.some(c=>i.isBad[c]);if(n.visible=!a,a)return;n.position.copy(r);let l=o.sub(r).length();l>0&&n.quaternion.setFromUnitVectors(bu,o.divideScalar(l)),s(Math.max(l,1e-9*i.stage.size))}}}function vr(i,e,t,n,s){let r=new cn;return i.add(r),s.pieces[e].push({geometry:t,body:-1,holder:r,parent:i,said:n}),r}var Il=(i,e=18)=>new Kt(i,i,1,e).rotateX(Math.PI/2).translate(0,0,.5);function I1(i,e,t){let n=i.nearness.atMost(Oy(i,e.bodies,e.points)),s={kind:"joint",name:e.name},r=new Dt;Mu(i,e.bodies,e.points,s,t);let o=vr(r,"foot",Il(Ny*n),s,t),a=[0,1].map(()=>vr(r,"sign",new on(.016*n,20,14),s,t));t.moving.push(Cp(i,e.bodies,e.points,r,l=>{o.scale.z=l,a[1].position.z=l}))}function Mu(i,e,t,n,s){let r=t.map((o,a)=>i.place(e[a],o,new S));e.forEach((o,a)=>{if(o>=0)return;let l=e.findIndex((u,d)=>u>=0&&Math.abs(d-a)===1),c=l<0?new S(...i.stage.up).negate():r[a].clone().sub(r[l]),h=i.nearness.atMost(c.length());for(let u of L1(R1*h)){let d=new nt().setFromUnitVectors(bu,c.clone().normalize());u.applyMatrix4(new Qe().compose(new S(...t[a]),d,new S(1,1,1))),s.pieces.foot.push({geometry:u,body:-1,holder:i.ground,said:n})}})}function L1(i){let e=new gi(1.5*i,2.5*i,4,1).rotateX(-Math.PI/2).rotateZ(Math.PI/4).translate(0,0,1.25*i),t=new pn(3.4*i,3.4*i,.3*i).translate(0,0,2.65*i);return[e,t]}function D1(i,e,t){let n={kind:"force",name:e.name};Mu(i,e.bodies,e.points,n,t);for(let s=1;s<e.points.length;s++){let r=e.bodies.slice(s-1,s+1),o=e.points.slice(s-1,s+1),a=new Dt,l=vr(a,"signDark",Il(Fy*i.stage.size),n,t);t.moving.push(Cp(i,r,o,a,c=>l.scale.z=c))}}function N1(i,e,t,n,s){let r={kind:"force",name:e.name},o=new Dt,a=new _u(i,e,t,n),l=Array.from({length:a.most},()=>vr(o,"signDark",Il(Fy*i.stage.size,8),r,s)),c=new S;Mu(i,e.bodies,e.points,r,s),s.moving.push({object:o,update(){if(o.visible=!e.bodies.some(u=>i.isBad[u]),!o.visible)return;let h=a.points();l.forEach((u,d)=>{let[f,p]=[h[d],h[d+1]];if(u.visible=!!f&&!!p,!f||!p)return;let y=c.copy(p).sub(f).length();u.position.copy(f),u.scale.z=Math.max(y,1e-9*i.stage.size),y>0&&u.quaternion.setFromUnitVectors(bu,c.divideScalar(y))})}})}function F1(i,e,t,n){let s=[],r=Dy*(n?8:16);for(let a=0;a<=r;a++){let l=a/r,c=2*Math.PI*Dy*l,h=Math.min(1,6*l,6*(1-l));s.push(new S(h*i*Math.cos(c),h*i*Math.sin(c),t*(.04+.92*l)))}s.unshift(new S(0,0,0)),s.push(new S(0,0,t));let o=new lr(s,!1,"catmullrom",.3);return new Lr(o,r,e,n?4:6).scale(1,1,1/t)}function U1(i,e,t){let n=O1(i,e),s=i.nearness.atMost(n),r={kind:"force",name:e.name},o=new Dt;Mu(i,e.bodies,e.points,r,t);let a=e.look==="spring"||e.look==="spring-damper",l=e.look==="cylinder",c=i.stage.forces.length>P1,[h=(l?1.35:.8)*A1*s,u=.55*Ny*s*(l?1.5:1),d=.58*n]=e.sizes,f=a?vr(o,"wire",F1(T1*s,w1*s,n,c),r,t):null,p=e.look==="spring"?null:vr(o,"foot",Il(h),r,t),y=p?vr(o,"sign",Il(u),r,t):null,g=[0,1].map(()=>vr(o,"signDark",new on(e.sizes.length?1.1*u:.008*s,14,10),r,t));t.moving.push(Cp(i,e.bodies,e.points,o,m=>{f&&(f.scale.z=m),p&&y&&(p.scale.z=Math.min(d,.92*m),y.scale.z=m),g[1].position.z=m}))}function O1(i,e){let t=Oy(i,e.bodies,e.points);return t>1e-6*i.stage.size?t:.2*i.stage.size}function Oy(i,e,t){let[n,s]=[0,1].map(r=>i.place(e[r],t[r],new S));return n.distanceTo(s)}function B1(i,e){let t=1.6*Math.max(i.stage.size,new S(...i.stage.high).distanceTo(new S(...i.stage.low))*.6),n=new ai({color:9412787,transparent:!0,opacity:.16,side:Sn,depthWrite:!1}),s=new St(new ks(t,t),n);s.userData={kind:"force",name:e.name};let r=new Dt,o=new S(...e.axis??[0,0,1]).normalize();s.quaternion.setFromUnitVectors(bu,o),r.add(s);let a=new S,l=new S,c=new S,h=e.bodies[1],u={offset:null};return{object:r,update(){if(r.visible=!i.isBad[h],i.place(h,e.points[1],a),!u.offset){i.place(e.bodies[0],e.points[0],l);let d=c.copy(o).applyQuaternion(i.holder(h).quaternion);u.offset=l.sub(a).addScaledVector(d,-l.dot(d)).applyQuaternion(i.holder(h).quaternion.clone().invert()),Number.isFinite(u.offset.lengthSq())||u.offset.set(0,0,0)}r.quaternion.copy(i.holder(h).quaternion),r.position.copy(u.offset).applyQuaternion(r.quaternion).add(a)}}}var Pp=class{constructor(e,t){this.record=e;this.strain=t.rounded(e.strain),this.values=new Float32Array(e.places.length)}record;values;strain;set(e,t,n,s){let[,r=0,o=0]=this.record.strain.numbers.shape,a=new Float64Array(6);for(let l=0;l<o;l++){for(let h=0;h<6;h++){let u=h*r*o+l;a[h]=(1-s)*this.strain[u+t*o]+s*this.strain[u+n*o]}let c=e.rows.map(h=>h<6?a[h]:this.record.stiffness[h-6].reduce((u,d,f)=>u+d*a[f],0));this.values[l]=c.length===1?c[0]:Math.hypot(...c)}}at(e){let{places:t}=this.record,n=0;for(;n<t.length&&t[n]<e;)n++;if(n===0)return this.values[0];if(n===t.length)return this.values[n-1];let s=(e-t[n-1])/(t[n]-t[n-1]);return this.values[n-1]+s*(this.values[n]-this.values[n-1])}},Su=class{quantities;shown=null;time;beams=new Map;constructor(e,t){this.quantities=e.sections?.quantities??[],this.time=e.sections?t.times(e.sections.time):new Float64Array;for(let n of e.sections?.beams??[])this.beams.set(n.sweep,new Pp(n,t))}of(e){return this.shown?this.beams.get(e)??null:null}show(e){this.shown=this.quantities.find(t=>t.name===e)??null}moveTo(e){if(!this.shown)return;let t=0;for(;t+1<this.time.length&&this.time[t+1]<=e;)t++;let n=Math.min(t+1,this.time.length-1),s=this.time[n]-this.time[t],r=s>0?Math.min(Math.max((e-this.time[t])/s,0),1):0;for(let o of this.beams.values())o.set(this.shown,t,n,r)}};var k1=240,H1=500,z1=10,V1=Math.cos(35*Math.PI/180),Ip=new S(1,0,0),Eu=class{constructor(e,t,n){this.actor=t;this.material=n;this.kept=G1(e.bodies.length);let s=W1(e,this.kept);this.record=s;let r=s.bodies.length-1;this.steps=s.smooth?Math.min(Math.max(Math.floor(k1/r),1),z1):1,this.corners=[...By(s.section,1),...By(s.hollow,-1)],this.caps=[...s.section,...s.hollow],this.turns=s.bodies.map((c,h)=>Y1(s.axes[h],s.across[h]));let o=r*this.steps+1,a=o*this.corners.length+2*this.caps.length,l=new wt;l.setAttribute("position",new Bt(new Float32Array(3*a),3)),l.setAttribute("normal",new Bt(new Float32Array(3*a),3)),l.setAttribute("color",new Bt(new Float32Array(3*a).fill(1),3)),l.setIndex(this.triangles(o)),this.mesh=new St(l,n),this.mesh.castShadow=!n.transparent,this.mesh.frustumCulled=!1}actor;material;mesh;corners;caps;steps;turns;kept;painted=new Hs({vertexColors:!0,shininess:20,specular:1710618,side:Sn});record;nearest(e){let t=new S,n=this.actor.root.worldToLocal(e.clone()),s=this.record.bodies.map((o,a)=>this.actor.place(o,this.record.points[a],t).distanceTo(n)),r=this.record.bodies[s.indexOf(Math.min(...s))];return{kind:"body",name:this.actor.stage.bodies[r].name}}around(e){let t=this.record.bodies.findIndex(l=>this.actor.stage.bodies[l].name===e);if(t<0)return null;let n=new wt;for(let l of["position","normal"])n.setAttribute(l,this.mesh.geometry.getAttribute(l));n.setIndex(this.mesh.geometry.index);let s=Math.max(t-.5,0),r=Math.min(t+.5,this.record.bodies.length-1),o=3*this.corners.length,a=o*Math.floor(s*this.steps);return n.setDrawRange(a,o*Math.ceil(r*this.steps)-a),n}*extent(){for(let[e,t]of this.record.bodies.entries())for(let[n,s]of this.record.section)yield[t,new S(0,n,s).applyQuaternion(this.turns[e]).add(new S(...this.record.points[e]))]}update(){let{bodies:e,points:t}=this.record;if(this.mesh.visible=e.every(d=>!this.actor.isBad[d]),!this.mesh.visible)return;let n=e.map((d,f)=>this.actor.place(d,t[f],new S)),s=e.map((d,f)=>this.actor.holder(d).quaternion.clone().multiply(this.turns[f])),r=new S,o=new S,a=new nt,l=new nt,c=0;for(let d=0;d+1<e.length;d++)for(let f=0;f<this.steps;f++){let p=f/this.steps;q1(p,n[d],n[d+1],s[d],s[d+1],this.record.smooth,r,o),a.slerpQuaternions(s[d],s[d+1],p),this.record.smooth&&o.lengthSq()>0&&a.premultiply(l.setFromUnitVectors(Ip.clone().applyQuaternion(a),o.normalize())),this.ring(c++,r,a)}let h=e.length-1;this.ring(c,n[h],s[h]);let u=(c+1)*this.corners.length;this.cap(u,n[0],s[0],-1),this.cap(u+this.caps.length,n[h],s[h],1);for(let d of["position","normal"])this.mesh.geometry.getAttribute(d).needsUpdate=!0;this.mesh.geometry.boundingSphere=null}paint(e,t,n){if(this.mesh.material=e?this.painted:this.material,!e)return;let s=this.mesh.geometry.getAttribute("color"),r=s.array,o=n>t?n-t:1,a=(this.record.bodies.length-1)*this.steps+1,l=(h,u,d)=>{fu((e.at(d)-t)/o,r,3*h);for(let f=1;f<u;f++)r.copyWithin(3*(h+f),3*h,3*h+3)};for(let h=0;h<a;h++)l(h*this.corners.length,this.corners.length,this.placeOf(h));let c=a*this.corners.length;l(c,this.caps.length,0),l(c+this.caps.length,this.caps.length,this.kept.at(-1)),s.needsUpdate=!0}placeOf(e){let t=Math.min(Math.floor(e/this.steps),this.kept.length-1),[n,s]=[this.kept[t],this.kept[t+1]??this.kept[t]];return n+(s-n)*(e-t*this.steps)/this.steps}ring(e,t,n){this.corners.forEach(({at:[s,r],normal:[o,a]},l)=>this.vertex(e*this.corners.length+l,t,n,s,r,0,o,a))}cap(e,t,n,s){this.caps.forEach(([r,o],a)=>this.vertex(e+a,t,n,r,o,s,0,0))}vertex(e,t,n,s,r,o,a,l){let{position:c,normal:h}=this.mesh.geometry.attributes,u=X1.set(0,s,r).applyQuaternion(n).add(t);c.setXYZ(e,u.x,u.y,u.z),u.set(o,a,l).applyQuaternion(n),h.setXYZ(e,u.x,u.y,u.z)}triangles(e){let t=[],n=this.corners.length;for(let c=0;c+1<e;c++)for(let h=0;h<n;h+=2){let[u,d]=[c*n+h,c*n+h+1];t.push(u,d,d+n,u,d+n,u+n)}let s=this.record.section.map(([c,h])=>new ue(c,h)),r=this.record.hollow.map(([c,h])=>new ue(c,h)),o=Ds.triangulateShape(s,r.length?[r]:[]),a=e*n;for(let[c,h,u]of o)t.push(a+c,a+u,a+h);let l=a+this.caps.length;for(let[c,h,u]of o)t.push(l+c,l+h,l+u);return t}};function G1(i){let e=Math.min(i,H1);return Array.from({length:e},(t,n)=>Math.round(n*(i-1)/(e-1)))}function W1(i,e){let t=n=>e.map(s=>n[s]);return{...i,bodies:t(i.bodies),points:t(i.points),axes:t(i.axes),across:t(i.across)}}var X1=new S;function q1(i,e,t,n,s,r,o,a){if(!r){o.lerpVectors(e,t,i),a.subVectors(t,e);return}let l=e.distanceTo(t),c=Ip.clone().applyQuaternion(n).multiplyScalar(l),h=Ip.clone().applyQuaternion(s).multiplyScalar(l),[u,d]=[i*i,i*i*i];o.copy(e).multiplyScalar(2*d-3*u+1).addScaledVector(t,3*u-2*d).addScaledVector(c,d-2*u+i).addScaledVector(h,d-u),a.subVectors(t,e).multiplyScalar(6*(i-u)).addScaledVector(c,3*u-4*i+1).addScaledVector(h,3*u-2*i)}function Y1(i,e){let t=new S(...i).normalize(),n=new S(...e);return n.addScaledVector(t,-n.dot(t)),n.lengthSq()<1e-12&&n.set(t.z,t.x,t.y).cross(t),n.normalize(),new nt().setFromRotationMatrix(new Qe().makeBasis(t,n,new S().crossVectors(t,n)))}function By(i,e){let t=i.length,s=i.reduce((o,[a,l],c)=>o+a*i[(c+1)%t][1]-i[(c+1)%t][0]*l,0)*e<0?[...i].reverse():i,r=s.map(([o,a],l)=>{let[c,h]=s[(l+1)%t],u=Math.hypot(c-o,h-a)||1;return[(h-a)/u,(o-c)/u]});return s.flatMap((o,a)=>{let l=r[a],c=h=>{if(l[0]*h[0]+l[1]*h[1]<V1)return l;let u=Math.hypot(l[0]+h[0],l[1]+h[1]);return[(l[0]+h[0])/u,(l[1]+h[1])/u]};return[{at:o,normal:c(r[(a+t-1)%t])},{at:s[(a+1)%t],normal:c(r[(a+1)%t])}]})}var ky=.013,$1=.008,Z1=1e30,J1=40,Ll=20,Dl=6,K1=6,j1=.75,Q1=new S,Hy=new nt,Nl=class{constructor(e,t,n,s,r){this.stage=e;this.isGhost=r;this.palette=new xu(n,r),this.nearness=new vu(e),this.frame=new Float32Array(e.layout.width),this.isBad=e.bodies.map(()=>!1),this.levels=new Uint8Array(e.bodies.length),this.ground.position.copy(this.origin).negate(),this.root.add(this.ground);for(let[h,u]of e.bodies.entries())this.bodies.push(new Dt),this.root.add(this.bodies[h]),this.build(h,u,t);s?.sample(s.start,this.frame),this.pose();let{moving:o,pieces:a}=Uy(this,s),l=r?{moving:[],pieces:Br()}:Ry(this);this.stretching=[...o,...l.moving];for(let h of this.stretching)this.root.add(h.object);this.fill(this.solids,this.palette.body,this.batches);let c=this.signs();for(let h of wp)c[h].push(...l.pieces[h]),this.fill(c[h],this.palette[h],this.signBatches),this.fill(a[h],this.palette[h],this.batches);this.pieces=[...this.solids,...wp.flatMap(h=>[...c[h],...a[h]])],this.swept=e.sweeps.map(h=>new Eu(h,this,this.palette.bodyOf(h.colour)));for(let h of this.swept)this.root.add(h.mesh);this.sections=new Su(e,t),this.bones=this.isLarge?new uu(this,r):null,this.bones&&this.root.add(this.bones.object),this.recolour(n),this.deforming=e.flexible.map(h=>new gu(h,t,r,e.size));for(let h of this.deforming)this.holder(h.record.body).add(h.mesh),this.bending.set(h.record.body,h)}stage;isGhost;root=new Dt;bodies=[];ground=new Dt;palette;deforming;swept;sections;time=0;nearness;frame;isBad;solids=[];pieces;levels;bones;stretching;batches=[];signBatches=[];edges=[];extras=new yu(this);bending=new Map;marked=[];holder(e){return this.bodies[e]??this.ground}place(e,t,n){let s=this.holder(e);return this.bent(e,t,this.frame,n,this.bending.get(e)?.exaggeration),n.applyQuaternion(s.quaternion).add(s.position)}placeIn(e,t,n,s){if(t<0)return s.set(...n).add(this.ground.position);let[r,o,a,l,c,h,u]=e.subarray(7*t,7*t+7);return this.bent(t,n,e,s,this.bending.get(t)?.exaggeration),s.applyQuaternion(Hy.set(c,h,u,l).normalize()),s.set(s.x+r,s.y+o,s.z+a)}turnIn(e,t,n,s){if(s.set(...n),t<0)return s;let[r,o,a,l]=e.subarray(7*t+3,7*t+7);return s.applyQuaternion(Hy.set(o,a,l,r).normalize())}bent(e,t,n,s,r=1){let o=this.bending.get(e);return o?o.carried(t,n,7*this.stage.layout.bodies,s).multiplyScalar(r).add(Q1.set(...t)):s.set(...t)}get origin(){return new S(...this.stage.origin)}vector(e,t){let{bodies:n,modes:s}=this.stage.layout,r=7*n+s+3*e;return t.set(this.frame[r],this.frame[r+1],this.frame[r+2])}apply(){this.pose();for(let s of[...this.stretching,...this.swept])s.update();this.sections.moveTo(this.time);let{low:e=0,high:t=0}=this.sections.shown??{};this.swept.forEach((s,r)=>s.paint(this.sections.of(r),e,t)),this.arrange(),this.bones?.update();let n=7*this.stage.layout.bodies;for(let s of this.deforming)s.update(this.frame,n)}look(e,t){if(!this.isLarge)return;let n=new S,s=.5*t/Math.tan(ci.degToRad(e.fov/2)),r=!1;e.updateMatrixWorld(),this.bodies.forEach((o,a)=>{let l=this.nearness.body(a);n.copy(o.position).add(this.root.position).applyMatrix4(e.matrixWorldInverse);let c=Math.max(-n.z,.1*l),h=ky*l*s/c,u=(.5*l+c*Math.tan(ci.degToRad(e.fov/2)))*1.05,f=n.z>l||Math.abs(n.y)>u||Math.abs(n.x)>u*Math.max(e.aspect,1)?yp:h>K1?ou:h>j1?oy:Al;f!==this.levels[a]&&(r=!0),this.levels[a]=f}),r&&this.arrange()}get isLarge(){return this.stage.bodies.length>J1}arrange(){for(let e of[...this.batches,...this.signBatches])e.update(this.levels);this.extras.update(this.levels)}pose(){this.bodies.forEach((e,t)=>{let n=7*t,[s,r,o,a,l,c,h]=[0,1,2,3,4,5,6].map(d=>this.frame[n+d]),u=Number.isFinite(a+l+c+h)&&Math.max(Math.abs(s),Math.abs(r),Math.abs(o))<=Z1;this.isBad[t]=!u,e.visible=u,u&&(e.position.set(s,r,o),e.quaternion.set(l,c,h,a).normalize())})}show(e,t){if(e==="signs")for(let n of this.signBatches)n.mesh.visible=t;else if(e==="edges")for(let n of this.edges)n.visible=t;else this.extras.show(e,t)}recolour(e){this.palette.recolour(e),this.bones?.recolour(e.soft)}mark(e,t){for(let o of this.marked)o.removeFromParent();if(this.marked=[],!e)return;let n=new Rn({color:t.accent,transparent:!0,opacity:.34,depthTest:e.kind==="body",polygonOffset:!0,polygonOffsetFactor:-1,polygonOffsetUnits:-1}),s=o=>o.kind===e.kind&&o.name===e.name,r=this.pieces.filter(({said:o})=>s(o)).map(({geometry:o,holder:a})=>[o,a]);this.root.traverse(o=>{o instanceof St&&s(o.userData)&&r.push([o.geometry,o])});for(let o of e.kind==="body"?this.swept:[]){let a=o.around(e.name);a&&r.push([a,o.mesh])}for(let[o,a]of r){let l=new St(o,n);a.add(l),this.marked.push(l)}}get bodyMeshes(){return this.batches.map(({mesh:e})=>e)}said(e){let t=[...this.batches,...this.signBatches].find(({mesh:s})=>s===e.object);if(t)return t.said(e.batchId??-1);if(e.object instanceof Pr)return e.object.userData.instances.said(e.instanceId);let n=this.swept.find(({mesh:s})=>s===e.object);return n?n.nearest(e.point):e.object instanceof St&&e.object.userData.name?e.object.userData:null}fill(e,t,n){if(!e.length)return;let s=new au(e,t);this.root.add(s.mesh),n.push(s)}build(e,t,n){let s=this.bodies[e],r={kind:"body",name:t.name},o=this.isGhost?void 0:t.colour,a=(u,d,f,p="")=>{let y=p&&!this.isGhost?p:o,g=this.isLarge&&d>Dl?{coarse:u(Dl)}:{};this.solids.push({geometry:u(d),...g,thin:f,body:e,holder:s,said:r,...y?{colour:y}:{}})};for(let u of t.parts){a(p=>Cl(u,n,2*p),u.kind==="mesh"?Dl:Ll,!1,u.colour);let d=this.isGhost||this.isLarge?null:Sy(u);d&&(u.colour||o)&&a(()=>d,Dl,!0,Ey(u.colour||o));let f=mu(u,Cl(u,n));if(f){let p=new Os(f,this.palette.edge);s.add(p),this.edges.push(p)}}let l=new S(...t.centre_of_mass),c=this.nearness.body(e),h=(t.parts.length?$1:ky)*c;for(let u of t.links){let d=new S(...u);d.distanceTo(l)<1e-6*c||(a(f=>py(l,d,h,f),Ll,!0),a(f=>Mp(d,h,f),Ll,!0))}t.automatic&&!t.parts.length&&a(u=>Mp(l,(t.links.length>1?1.5:2.2)*h,u),Ll,!0)}signs(){let e=Br();for(let t of this.isGhost?[]:this.stage.joints){let n={kind:"joint",name:t.name},s=this.nearness.joint(t),r=this.isLarge?Tp(t,this.stage,s,Dl):[];Tp(t,this.stage,s,Ll+4).forEach(({tone:o,geometry:a,standing:l},c)=>{let h=l?-1:t.bodies[t.place],u=r[c]?{coarse:r[c].geometry}:{};e[o].push({geometry:a,...u,thin:!0,body:h,holder:this.holder(h),said:n})})}return e}};var zy=.32,Lp=.0052,wu=.05,Dp=1e-9,eA=100,tA=new S(0,1,0),Au=["applied-force","applied-torque","reaction-force","reaction-torque"],Ru=class{constructor(e,t){this.actor=e;for(let n of Au)this.materials.set(n,new Rn({depthTest:!1,transparent:!0}));this.recolour(t);for(let n of e.stage.arrows){let s=Math.max(2*n.typical,n.largest/4);this.reference.set(n.kind,Math.max(this.reference.get(n.kind)??0,s))}this.dropRoundOff(),this.drawn=e.stage.arrows.map(n=>({record:n,place:0,visible:!1}));for(let n of Au)this.bundle(n)}actor;root=new Dt;shown=new Set;scale=1;only=null;drawn;bundles=new Map;reference=new Map;materials=new Map;has(e){return this.drawn.some(({record:t})=>Wy(t)===e&&t.largest>Dp*(this.reference.get(t.kind)??1/0))}unit(e){return(this.reference.get(e)??0)*.1/(zy*this.scale)}dropRoundOff(){let{size:e}=this.actor.stage,t=this.reference.get("force")??0,n=this.reference.get("torque")??0;n<=Dp*t*e&&this.reference.delete("torque"),t*e<=Dp*n&&this.reference.delete("force")}recolour(e){for(let[t,n]of this.materials)n.color.set(t.startsWith("applied")?e.applied:t.endsWith("torque")?e.moment:e.reaction)}update(){for(let[e,{arrows:t,shafts:n,heads:s}]of this.bundles){let r=this.shown.has(e);n.mesh.visible=s.mesh.visible=r;for(let o of t)o.visible=r&&this.draw(o,n,s);r&&(n.done(),s.done())}}draw({record:e,place:t},n,s){let{size:r}=this.actor.stage,o=Vy(e.kind),a=this.actor.vector(e.vector,Gy).length(),l=this.reference.get(e.kind)??0,c=l>0?a/l*zy*r*this.scale:0;if(!(c>.001*r&&Number.isFinite(c)&&!this.actor.isBad[e.body]&&(!this.only||this.only===e.owner))){n.hide(t);for(let p=0;p<o;p++)s.hide(o*t+p);return!1}let u=Gy.divideScalar(a);e.place>=0?this.actor.vector(e.place,Tu):this.actor.place(e.body,e.point,Tu),Fp.setFromUnitVectors(tA,u);let d=Math.min(wu*r,.5*c),f=d/(wu*r);n.set(t,Tu,Fp,Np.set(1,Math.max(c-d,1e-9),1)),Np.setScalar(f);for(let p=0;p<o;p++)s.set(o*t+p,nA.copy(Tu).addScaledVector(u,c-d-.55*p*d),Fp,Np);return!0}bundle(e){let t=this.drawn.filter(({record:h})=>Wy(h)===e);if(!t.length)return;let{size:n}=this.actor.stage,s=this.materials.get(e),r=t.map(({record:h})=>this.owner(h)),o=t.length>eA?6:18,a=new Qi(new Kt(Lp*n,Lp*n,1,o).translate(0,.5,0),s,r),l=new gi(3.1*Lp*n,wu*n,o).translate(0,.5*wu*n,0),c=new Qi(l,s,r.flatMap((h,u)=>Array(Vy(t[u].record.kind)).fill(h)));t.forEach((h,u)=>h.place=u);for(let{mesh:h}of[a,c])h.renderOrder=5,h.visible=!1,this.root.add(h);this.bundles.set(e,{arrows:t,shafts:a,heads:c})}owner(e){let{joints:t,drivers:n}=this.actor.stage,s=r=>r.name===e.owner;return{kind:e.source==="reaction"&&t.some(s)?"joint":n.some(s)?"driver":"force",name:e.owner}}},Vy=i=>i==="torque"?2:1,[Gy,Tu,nA,Np,Fp]=[new S,new S,new S,new S,new nt];function Wy(i){return`${i.source}-${i.kind}`}var Xy="von Mises stress",Cu=class{constructor(e){this.actor=e;this.spread()}actor;get ofBeams(){return this.actor.sections.quantities.map(e=>e.name)}get ofBodies(){let{deforming:e}=this.actor;return e.some(t=>t.stressed)?[e[0].record.quantity,Xy]:[]}get all(){return[...this.ofBeams,...this.ofBodies]}beams(e){this.actor.sections.show(e)}bodies(e){for(let t of this.actor.deforming)t.showsStress=e===Xy&&t.stressed!==null;this.spread()}scales(){let{shown:e}=this.actor.sections,t=[];e&&t.push({quantity:e.name,unit:e.unit,low:e.low,high:e.high,now:null});for(let n of this.groups()){let[s]=n,{quantity:r,unit:o,low:a,high:l}=s.scale,c=s.showsStress?Math.max(...n.map(h=>h.peakValue)):null;t.push({quantity:r,unit:o,low:a,high:l,now:c})}return t}spread(){for(let e of this.groups()){let t=Math.min(...e.map(s=>s.ownScale.low)),n=Math.max(...e.map(s=>s.ownScale.high));for(let s of e)s.scale={...s.ownScale,low:t,high:n}}}groups(){let e=new Map;for(let t of this.actor.deforming){let{quantity:n,unit:s}=t.ownScale,r=`${n} ${s}`;e.set(r,[...e.get(r)??[],t])}return[...e.values()]}};var Zy=["first","front","right","top","back","left","below"],qy=40,Wo=i=>new S(...i);function Fl(i){let{min:e,max:t}=i;return Array.from({length:8},(n,s)=>new S(s&1?e.x:t.x,s&2?e.y:t.y,s&4?e.z:t.z))}function Up(i,e,t){if(i==="first")return{towards:Wo(e.towards),up:Wo(e.up)};let n=Math.abs(t.z)>.9?new S(0,-1,0):new S(0,0,1),s=new S().crossVectors(t,n);return{towards:{front:n,right:s,top:t.clone(),back:n.clone().negate(),left:s.clone().negate(),below:t.clone().negate()}[i],up:i==="top"?n.clone().negate():i==="below"?n.clone():t.clone()}}var iA=1.08,Yy=.05;function Jy(i,e,t,n,s,r){let o=e.clone().normalize(),a=new S().crossVectors(t,o);a.lengthSq()<1e-6&&a.crossVectors(new S(.1,.3,1),o),a.normalize();let l=new S().crossVectors(o,a),c=Math.tan(ci.degToRad(s/2))/iA/n.height,h=$y(i,a,o,c*Math.max(n.across,qy),Yy*r),u=$y(i,l,o,c*Math.max(n.down,qy),Yy*r),d=new Ot().setFromPoints([...i]).getCenter(new S).dot(o);return{aim:a.multiplyScalar(h.middle).addScaledVector(l,u.middle).addScaledVector(o,d),distance:Math.max(h.eye-d,u.eye-d,.2*r)}}function $y(i,e,t,n,s){let r=-1/0,o=-1/0;for(let a of i){let l=n*a.dot(t);r=Math.max(r,l+a.dot(e)),o=Math.max(o,l-a.dot(e))}return{middle:.5*(r-o),eye:(.5*(r+o)+s)/n}}var sA=24,rA=8e3;function Op(i,e){let t=jy(i),n=Math.max(Math.min(sA,e.count,Math.floor(rA/(8*Math.max(t.length,1)))),1),s=new Float32Array(e.layout.width),r=new nt,o=new Ot(new S(...i.stage.low),new S(...i.stage.high));o.expandByScalar(o.min.distanceTo(o.max)+i.stage.size);let a=[];for(let l=0;l<n;l++)e.sample(e.time[Math.round(l*(e.count-1)/Math.max(n-1,1))],s),t.forEach((c,h)=>{let[u,d,f,p,y,g,m]=s.subarray(7*h,7*h+7);if(c.isEmpty()||!Number.isFinite(u+d+f+p+y+g+m))return;r.set(y,g,m,p).normalize();let x=new S(u,d,f);if(o.containsPoint(x))for(let M of Fl(c))a.push(M.applyQuaternion(r).add(x))});return[...a,...Ky(i)]}function Bp(i){return[...Pu(i).flat(),...Ky(i)]}function Pu(i){return jy(i).map((e,t)=>{let{position:n,quaternion:s}=i.bodies[t];return e.isEmpty()||i.isBad[t]?[]:Fl(e).map(r=>r.applyQuaternion(s).add(n))})}function Ky(i){let e=[],t=new S;for(let n of[...i.stage.joints,...i.stage.forces])n.points.forEach((s,r)=>{n.bodies[r]===-1&&n.kind!=="contact"&&e.push(i.place(-1,s,t).clone())});return e}function jy(i){let e=new Map(i.bodies.map(n=>[n,new Ot])),t=(n,s)=>{s.computeBoundingBox(),s.boundingBox&&e.get(n)?.union(s.boundingBox)};for(let{holder:n,geometry:s}of i.solids)t(n,s);for(let{record:n,mesh:s}of i.deforming)t(i.holder(n.body),s.geometry);for(let n of i.swept)for(let[s,r]of n.extent())e.get(i.holder(s))?.expandByPoint(r);return[...e.values()]}var kp=24,Hp=12,Qy=5,Iu=class{group=new Dt;square;lines;material=new Jn({vertexColors:!0,transparent:!0,depthWrite:!1});shadow;height;shade=new nl({opacity:.16,depthWrite:!1});constructor(e,t){let n=new S(...e.low),s=new S(...e.high),r=new S(...e.up),o=Math.max(n.distanceTo(s),e.size);this.square=zp(o/9);let a=n.clone().add(s).multiplyScalar(.5),l=[n.dot(r),s.dot(r)],c=Math.min(...l)-.04*e.size,h=a.clone().addScaledVector(r,c-a.dot(r)),u=new nt().setFromUnitVectors(new S(0,0,1),r),d=f=>f.applyQuaternion(u.clone().invert());this.height=d(h.clone()).z,this.group.quaternion.copy(u),this.under(h,this.square),this.lines=new Os(oA(this.square),this.material),this.lines.renderOrder=-1,this.shadow=new St(new ks(3*o,3*o),this.shade),this.shadow.receiveShadow=!0,this.shadow.renderOrder=-2,this.group.add(this.lines,this.shadow),this.recolour(t)}under(e,t=Qy*this.square){let n=e.clone().applyQuaternion(this.group.quaternion.clone().invert()),s=new S(Math.round(n.x/t)*t,Math.round(n.y/t)*t,this.height);this.group.position.copy(s.applyQuaternion(this.group.quaternion))}setGrid(e){this.lines.visible=e}setShadows(e){this.shadow.visible=e}recolour(e){this.material.color.set(e.grid),this.shade.opacity=e.dark?.4:.15}};function zp(i){let e=10**Math.floor(Math.log10(i));return e*([5,2,1].find(t=>t*e<=i*1.0001)??1)}function oA(i){let e=[],t=[],n=kp*i,s=n/Hp,r=(a,l,c)=>Math.max(0,1-Math.hypot(a,l)/n)**1.4*(c?1:.5);for(let a=-kp;a<=kp;a++){let l=a*i,c=a%Qy===0;for(let h=-Hp;h<Hp;h++){for(let u of[h*s,(h+1)*s])e.push(l,u,0),t.push(1,1,1,r(l,u,c));for(let u of[h*s,(h+1)*s])e.push(u,l,0),t.push(1,1,1,r(u,l,c))}}let o=new wt;return o.setAttribute("position",new ot(e,3)),o.setAttribute("color",new ot(t,4)),o}var Lu=24,Xo=34,aA=90,Vp=[[1e3,"km"],[1,"m"],[.001,"mm"],[1e-6,"µm"]],lA="http://www.w3.org/2000/svg",Du=class{constructor(e){this.world=e;for(let{line:t,text:n}of this.axes)this.element.append(t,n);this.element.append(this.bar,this.length)}world;element=Ul("svg",{class:"compass",width:"190",height:"72","aria-hidden":"true"});axes=["x","y","z"].map(e=>{let t=Ul("line",{class:`axis ${e}`,x1:String(Xo),y1:String(Xo)}),n=Ul("text",{class:`axis ${e}`});return n.textContent=e,{line:t,text:n}});bar=Ul("path",{class:"bar"});length=Ul("text",{class:"length",x:"84",y:"40"});update(){let{camera:e,controls:t}=this.world,n=e.quaternion.clone().invert(),s=[0,1,2].map(h=>new S().setComponent(h,1).applyQuaternion(n));s.forEach((h,u)=>{let{line:d,text:f}=this.axes[u];d.setAttribute("x2",(Xo+Lu*h.x).toFixed(1)),d.setAttribute("y2",(Xo-Lu*h.y).toFixed(1)),f.setAttribute("x",(Xo+(Lu+8)*h.x).toFixed(1)),f.setAttribute("y",(Xo-(Lu+8)*h.y+4).toFixed(1))});let r=[0,1,2].sort((h,u)=>s[h].z-s[u].z);for(let h of r)this.element.append(this.axes[h].line,this.axes[h].text);let a=2*e.position.distanceTo(t.target)*Math.tan(ci.degToRad(e.fov/2))/Math.max(this.world.holder.clientHeight,1),l=zp(aA*a),c=84+l/a;this.bar.setAttribute("d",`M84 48v6H${c.toFixed(1)}v-6`),this.length.textContent=cA(l)}};function cA(i){let[e,t]=Vp.find(([n])=>i>=.999*n)??Vp[Vp.length-1];return`${Number((i/e).toPrecision(3))} ${t}`}function Ul(i,e){let t=document.createElementNS(lA,i);for(let[n,s]of Object.entries(e))t.setAttribute(n,s);return t}var Nu=new zs,hA=.02;function ex(i,e,t,n){let s=t.clone().sub(n.position),r=s.length();Nu.set(n.position,s.divideScalar(r)),Nu.near=n.near,Nu.far=(1-hA)*r;let o=i.stage.bodies[e]?.name;return Nu.intersectObjects(i.bodyMeshes,!1).some(a=>{let l=i.said(a);return l!==null&&l.kind==="body"&&l.name!==o})}var uA=80,Fu=17,dA=3,fA=60,pA=7,mA=40,gA=2e4,Uu=class{constructor(e,t){this.actor=e;this.holder=t;let{stage:n}=e,s=e.solids.reduce((o,{geometry:a})=>o+(a.index??a.getAttribute("position")).count/3,0);this.looks=n.bodies.length<=mA&&s<=gA;let r=new Map(n.sweeps.flatMap(o=>o.bodies.map((a,l)=>[a,l===o.bodies.length>>1?o.name:""])));for(let[o,a]of n.bodies.entries())this.add("body",r.get(o)??a.name,o,a.centre_of_mass);for(let o of n.joints)this.add("joint",o.name,o.bodies[o.place],o.points[o.place]);for(let o of[...n.forces,...n.drivers])o.points[0]&&this.add("force",o.name,o.bodies[0],o.points[0]);for(let{name:o,wheels:a,joined:l}of n.couplings){let[c]=a,[h]=l;c?this.add("force",o,c.body,c.centre):h&&this.add("force",o,h.body,h.point)}}actor;holder;shown={body:!1,joint:!1,force:!1};labels=[];looks;update(e,t,n,s){let r=new S,o=[],a=this.labels.length>fA?0:dA;for(let l of this.labels){let{style:c}=l.element,h=this.shown[l.kind]&&o.length<uA&&!this.actor.isBad[l.body];if(h&&l.kind==="body"&&this.looks){let M=s&&ex(this.actor,l.body,this.actor.place(l.body,l.point,r),e);l.element.classList.toggle("covered",M)}h&&this.actor.place(l.body,l.point,r).project(e);let u=pA*l.text.length,d=(.5+.5*r.x)*t,f=Math.min(Math.max(d,.5*u+4),t-.5*u-4),p=(.5-.5*r.y)*n,y=M=>!o.some(([_,C,T])=>Math.abs(_-f)<.5*(u+T)&&Math.abs(C-p-Fu*M)<Fu-1),g=!h||r.z>1||d<0||p<0||d>t||p>n,m=0;for(;!g&&m<=a&&!y(m);)m++;let x=!g&&m<=a;c.display=x?"":"none",x&&(o.push([f,p+Fu*m,u]),c.transform=`translate(${f.toFixed(1)}px, ${(p+Fu*m).toFixed(1)}px) translate(-50%, 9px)`)}}add(e,t,n,s){if(!t)return;let r=document.createElement("span");r.className=`label ${e}`,r.textContent=t,r.style.display="none",this.holder.append(r),this.labels.push({element:r,text:t,body:n,point:s,kind:e})}};var Ou=class{constructor(e,t){this.world=e;this.actor=t}world;actor;name=null;body=-1;last=new S;toggle(e){if(this.name===e){this.stop();return}this.name=e,this.body=this.actor.stage.bodies.findIndex(t=>t.name===e),this.centre(this.last),this.world.shift(this.last.clone().sub(this.world.controls.target)),this.world.invalidate()}stop(){this.name=null,this.body=-1}update(){if(this.body<0||this.actor.isBad[this.body])return;let e=this.centre(new S);this.world.shift(e.clone().sub(this.last)),this.last.copy(e)}centre(e){return this.actor.place(this.body,this.actor.stage.bodies[this.body].centre_of_mass,e)}};var yA=20,xA=.008,Bu=class{constructor(e,t,n){this.world=e;this.actor=t;this.send=n;this.dot=new St(new on(xA*t.stage.size,16,12),new Rn({color:14698554,depthTest:!1})),this.line.frustumCulled=!1;for(let r of[this.line,this.dot])r.renderOrder=10,r.raycast=()=>{};this.object.add(this.line,this.dot),this.object.visible=!1;let s=e.renderer.domElement;e.holder.addEventListener("pointerdown",r=>this.pick(r),!0),s.addEventListener("pointermove",r=>this.move(r));for(let r of["pointerup","pointercancel"])addEventListener(r,()=>this.letGo());addEventListener("blur",()=>this.letGo()),setInterval(()=>this.held&&this.say(1),yA)}world;actor;send;isOut=!1;object=new Dt;held=null;caster=new zs;line=new ps(new wt().setFromPoints([new S,new S]),new Jn({color:14698554,depthTest:!1}));dot;update(){if(!this.held)return;let e=this.actor.place(this.held.body,this.held.point.toArray(),new S);this.line.geometry.setFromPoints([e,this.held.towards]),this.dot.position.copy(this.held.towards)}pick(e){if(e.button!==0||!e.isPrimary||!(this.isOut||e.shiftKey)||e.target!==this.world.renderer.domElement)return;this.aim(e);let t=this.caster.intersectObject(this.actor.root,!0).find(c=>this.actor.said(c)?.kind==="body");if(!t)return;let n=this.actor.said(t).name,s=this.actor.stage.bodies.findIndex(c=>c.name===n),r=this.actor.root.worldToLocal(t.point.clone()),o=this.actor.holder(s),a=r.clone().sub(o.position).applyQuaternion(o.quaternion.clone().invert()),l=new si().setFromNormalAndCoplanarPoint(this.world.camera.getWorldDirection(new S),t.point);this.held={body:s,point:a,towards:r,plane:l},this.world.controls.enabled=!1,this.object.visible=!0,e.preventDefault(),this.say(1)}move(e){if(!this.held||!e.isPrimary)return;this.aim(e);let t=this.caster.ray.intersectPlane(this.held.plane,new S);t&&(this.held.towards=this.actor.root.worldToLocal(t)),this.world.invalidate()}letGo(){this.held&&(this.say(0),this.held=null,this.object.visible=!1,this.world.controls.enabled=!0,this.world.invalidate())}say(e){let{body:t,point:n,towards:s}=this.held;this.send({type:"hold",body:t,point:n.toArray(),towards:s.toArray(),on:e}),this.update()}aim(e){let t=this.world.renderer.domElement.getBoundingClientRect(),n=new ue(2*(e.clientX-t.left)/t.width-1,1-2*(e.clientY-t.top)/t.height);this.caster.setFromCamera(n,this.world.camera)}};var vA=400,_A=2,bA=1.5,ku=class{constructor(e,t,n){this.world=e;this.actor=t;this.follow=n}world;actor;follow;body=-1;patience=0;looked=0;start=new Ot;move(e){let{stage:t}=this.actor,n=t.coordinates.find(r=>r.name===e)?.joint,s=t.joints.find(r=>r.name===n);s?this.body=s.bodies[1]>=0?s.bodies[1]:s.bodies[0]:this.body=t.bodies.findIndex(r=>r.name===n)}watchAll(){this.body=0,this.patience=vA,this.start.setFromPoints(Pu(this.actor).flat())}keepInSight(){let e=performance.now();if(e-this.looked<this.patience)return;this.looked=e;let t=this.actor.bodies[this.body];if(!this.world.around||!t||this.actor.isBad[this.body]||this.patience&&!this.world.isFitted||this.world.holds(this.world.isFitted?this.world.around():[t.position]))return;let n=this.patience?this.driven():null;n?this.follow(n):this.world.fit()}driven(){let e=Pu(this.actor).map(o=>new Ot().setFromPoints(o)),t=e.reduce((o,a)=>o.union(a),new Ot),n=this.start.min.distanceTo(this.start.max);if(!(t.getCenter(new S).distanceTo(this.start.getCenter(new S))>_A*n)||t.min.distanceTo(t.max)>bA*n)return null;let r=e.map(o=>o.isEmpty()?0:o.min.distanceTo(o.max));return this.actor.stage.bodies[r.indexOf(Math.max(...r))].name}};var MA=5;function tx(i,e,t,n){let s=i.renderer.domElement,r=null;s.addEventListener("pointerdown",c=>r=c.button===0&&c.isPrimary?{x:c.clientX,y:c.clientY}:null),s.addEventListener("pointerup",c=>{r&&c.isPrimary&&Math.hypot(c.clientX-r.x,c.clientY-r.y)<MA&&n(a(c)),r=null});let o=new zs;function a(c){let h=s.getBoundingClientRect(),u=new ue(2*(c.clientX-h.left)/h.width-1,1-2*(c.clientY-h.top)/h.height);o.setFromCamera(u,i.camera);let f=o.intersectObjects([e.root,t],!0).flatMap(y=>{let g=SA(y.object)?e.said(y):null;return g?[{said:g,distance:y.distance,size:l(g)}]:[]}),p=f[0];return p?(f.find(({said:y,distance:g,size:m})=>y.kind!=="body"&&g<p.distance+.02*m)??p).said:null}function l(c){let h=c.kind==="joint"&&e.stage.joints.find(({name:u})=>u===c.name);return h?e.nearness.joint(h):e.stage.size}}function SA(i){for(let e=i;e;e=e.parent)if(!e.visible)return!1;return!0}var qo=class extends xr{constructor(){super(),this.isLineGeometry=!0,this.type="LineGeometry"}setPositions(e){let t=e.length-3,n=new Float32Array(2*t);for(let s=0;s<t;s+=3)n[2*s]=e[s],n[2*s+1]=e[s+1],n[2*s+2]=e[s+2],n[2*s+3]=e[s+3],n[2*s+4]=e[s+4],n[2*s+5]=e[s+5];return super.setPositions(n),this}setColors(e){let t=e.length-3,n=new Float32Array(2*t);for(let s=0;s<t;s+=3)n[2*s]=e[s],n[2*s+1]=e[s+1],n[2*s+2]=e[s+2],n[2*s+3]=e[s+3],n[2*s+4]=e[s+4],n[2*s+5]=e[s+5];return super.setColors(n),this}setFromPoints(e){let t=e.length-1,n=new Float32Array(6*t);for(let s=0;s<t;s++)n[6*s]=e[s].x,n[6*s+1]=e[s].y,n[6*s+2]=e[s].z||0,n[6*s+3]=e[s+1].x,n[6*s+4]=e[s+1].y,n[6*s+5]=e[s+1].z||0;return super.setPositions(n),this}fromLine(e){let t=e.geometry;return this.setPositions(t.attributes.position.array),this}};var Hu=class extends Go{constructor(e=new qo,t=new gs({color:Math.random()*16777215})){super(e,t),this.isLine2=!0,this.type="Line2"}};var EA=6e3,zu=class{constructor(e,t,n){this.actor=e;this.motion=t;this.look=n}actor;motion;look;root=new Dt;paths=new Map;get keys(){return[...this.paths.keys()]}has(e){return this.paths.has(e)}toggle(e){let t=this.paths.get(e.key);if(t){for(let n of[t.whole,t.past,t.dot])n.removeFromParent();this.paths.delete(e.key)}else this.motion&&this.paths.set(e.key,this.make(e,this.motion))}clear(){this.root.clear(),this.paths.clear()}recolour(e){this.look=e,[...this.paths.values()].forEach((t,n)=>this.paint(t,n))}update(e){for(let t of this.paths.values()){let n=0;for(;n<t.frames.length&&t.frames[n]<=e;)n++;t.past.geometry.instanceCount=Math.max(n-1,0),this.actor.place(t.of.body,t.of.point,t.dot.position),t.dot.visible=!this.actor.isBad[t.of.body]}}make(e,t){let n=Math.max(Math.ceil(t.count/EA),1),s=[],r=[],o=new Float32Array(t.layout.width),a=new nt,l=new S;for(let p=0;p<t.count;p+=n){let y=t.time[p];t.sample(y,o);let[g,m,x,M,_,C,T]=o.subarray(7*e.body,7*e.body+7);a.set(_,C,T,M),this.actor.bent(e.body,e.point,o,l).applyQuaternion(a).add(new S(g,m,x)),Number.isFinite(l.x+l.y+l.z)&&(s.push(l.x,l.y,l.z),r.push(p))}let c=new ps(new wt,new Jn({transparent:!0,opacity:.4}));c.geometry.setAttribute("position",new ot(s,3));let h=new qo;h.setPositions(s.length>=6?s:[...s,...s,0,0,0,0,0,0].slice(0,6));let u=new Hu(h,new gs({linewidth:2.2})),d=new St(new on(.011*this.actor.nearness.body(e.body),16,12),new Rn);for(let p of[c,u])p.frustumCulled=!1;this.root.add(c,u,d);let f={of:e,whole:c,past:u,dot:d,frames:r};return this.paint(f,this.paths.size),f}paint(e,t){let n=this.look.trace[(t+1)%this.look.trace.length];e.whole.material.color.set(n),e.past.material.color.set(n),e.dot.material.color.set(n)}};var wA="#858e98";function nx(i,e){let t=new Dt;t.position.set(...i.origin).negate();let n=new Jn({color:"#1b2430",transparent:!0,opacity:.35}),s=new Map;for(let r of i.surroundings){let o=r.colour||wA,a=s.get(o)??new ai({color:o,polygonOffset:!0,polygonOffsetFactor:1,polygonOffsetUnits:1});s.set(o,a);let l=Cl(r,e),c=new St(l,a);c.castShadow=c.receiveShadow=!0,t.add(c);let h=mu(r,l);h&&t.add(new Os(h,n))}return t}var ix=new et("#a39781"),rx=new et("#694f35"),TA=.5,Vu=class{constructor(e,t,n){this.ground=e;this.actor=n;let s=t.floats(e.heights),r=s.length,[o,a]=[new S(...e.along),new S(...e.across)];this.cell=o.length(),this.columns=e.heights.shape[1],this.normal=o.clone().cross(a).normalize(),this.at=new Float32Array(3*r),s.forEach((h,u)=>{let d=u%this.columns;Ol.set(...e.corner).addScaledVector(o,d).addScaledVector(a,(u-d)/this.columns),Ol.addScaledVector(this.normal,h).toArray(this.at,3*u)});let l=Rl(this.at,PA(r,this.columns));l.computeVertexNormals(),this.normals=l.getAttribute("normal").array,this.colours=new Float32Array(3*r);for(let h=0;h<r;h++)ix.toArray(this.colours,3*h);l.setAttribute("color",new Bt(this.colours,3)),this.steps=new Int32Array(r),this.marked=new Uint8Array(r),this.mesh=new St(l,new ai({vertexColors:!0,side:Sn})),this.mesh.position.set(...n.stage.origin).negate(),this.mesh.castShadow=this.mesh.receiveShadow=!0,this.mesh.frustumCulled=!1,this.heaps=e.loads.map(IA);let c=t.indices(e.nodes);for(let h=1;h<c.length;h++)c[h]+=c[h-1];this.course={time:t.times(e.time),ends:t.indices(e.ends),carried:t.floats(e.carried),nodes:c,moves:t.signed(e.moves)}}ground;actor;mesh;heaps;cell;columns;normal;at;normals;colours;steps;course;marked;waiting=[];passed=0;carried=new Float32Array;goTo(e){let{course:t}=this;if(!t.time.length)return;let n=t.carried.length/t.time.length;for(;this.passed<t.time.length&&t.time[this.passed]<=e;)this.pass(this.passed++,1);for(;this.passed>0&&t.time[this.passed-1]>e;)this.pass(--this.passed,-1);let s=n*Math.max(this.passed-1,0);this.carried=t.carried.subarray(s,s+n),this.settle()}take({carried:e,nodes:t,moves:n}){t.forEach((s,r)=>this.move(s,n[r])),this.carried=e,this.settle()}update(){this.ground.loads.forEach((e,t)=>this.place(e,this.heaps[t]))}place({slot:e,body:t,point:n,half:s},r){let o=this.carried[e]??0;if(r.visible=o>this.cell**3&&!this.actor.isBad[t],!r.visible)return;let a=Math.hypot(...s),l=Math.sqrt(3*o/(4*Math.PI*a));r.scale.set(a,l,l),r.quaternion.copy(this.actor.holder(t).quaternion).multiply(AA.setFromUnitVectors(RA,Ol.set(...s).normalize())),this.actor.place(t,n,r.position)}pass(e,t){let{ends:n,nodes:s,moves:r}=this.course;for(let o=e?n[e-1]:0;o<n[e];o++)this.move(s[o],t*r[o])}move(e,t){let{columns:n,normal:s,at:r}=this,o=t*this.ground.step;this.steps[e]+=t,r[3*e]+=o*s.x,r[3*e+1]+=o*s.y,r[3*e+2]+=o*s.z;for(let a of[e,e-1,e+1,e-n,e+n])a<0||a>=this.marked.length||this.marked[a]||(this.marked[a]=1,this.waiting.push(a))}settle(){if(!this.waiting.length)return;let{columns:e,cell:t}=this,n=this.marked.length/e-1;for(let s of this.waiting){this.marked[s]=0;let r=s%e,o=(s-r)/e;this.between(s-+(r>0),s+ +(r<e-1),Ol),this.between(s-e*+(o>0),s+e*+(o<n),sx),Ol.cross(sx).normalize().toArray(this.normals,3*s),CA.copy(ix).lerp(rx,Math.min(Math.abs(this.steps[s]*this.ground.step)/(TA*t),1)).toArray(this.colours,3*s)}this.waiting=[];for(let s of["position","normal","color"])this.mesh.geometry.getAttribute(s).needsUpdate=!0}between(e,t,n){let{at:s}=this;n.set(s[3*t]-s[3*e],s[3*t+1]-s[3*e+1],s[3*t+2]-s[3*e+2])}},Ol=new S,sx=new S,AA=new nt,RA=new S(1,0,0),CA=new et;function PA(i,e){let t=new Uint32Array(6*(e-1)*(i/e-1)),n=0;for(let s=0;s<i-e;s++)(s+1)%e!==0&&(t.set([s,s+1,s+e+1,s,s+e+1,s+e],n),n+=6);return t}function IA(){let i=new St(new on(1,32,24),new ai({color:rx}));return i.castShadow=i.receiveShadow=!0,i.visible=!1,i}var ox=1500,LA=14247979,Gu=class{constructor(e,t,n){this.actor=e;this.traced=t;this.gaugeCount=n;this.frame=new Float32Array(e.stage.layout.width);for(let{body:s,point:r}of e.stage.markers){if(!t.includes(s))continue;let o=new wt;o.setAttribute("position",new Bt(new Float32Array(3*ox),3)),o.setDrawRange(0,0);let a=new ps(o,new Jn({color:LA}));a.frustumCulled=!1,this.root.add(a),this.lines.push({line:a,body:s,point:r,count:0})}}actor;traced;gaugeCount;root=new Dt;lines=[];frame;time=-1/0;add({width:e,values:t}){let{bodies:n}=this.actor.stage.layout,s=1+this.gaugeCount;for(let r=0;r<t.length;r+=e){if(t[r]<this.time)for(let o of this.lines)o.count=0;this.time=t[r],this.traced.forEach((o,a)=>this.frame.set(t.subarray(r+s+7*a,r+s+7*a+7),7*o)),this.frame.set(t.subarray(r+s+7*this.traced.length,r+e),7*n);for(let o of this.lines)this.lengthen(o)}for(let{line:r,count:o}of this.lines)r.geometry.getAttribute("position").needsUpdate=!0,r.geometry.setDrawRange(0,o)}lengthen(e){let t=e.line.geometry.getAttribute("position").array;e.count===ox?t.copyWithin(0,3):e.count++,this.actor.placeIn(this.frame,e.body,e.point,DA).toArray(t,3*(e.count-1))}},DA=new S;var NA=.12,FA=400,Wu=class{constructor(e,t){this.actor=e;let n=e.stage.size;this.joints=e.stage.joints.filter(r=>r.violation>=0);let s=this.joints.map(({name:r})=>({kind:"joint",name:r}));this.lines=new Qi(new Kt(.004*n,.004*n,1,8).translate(0,.5,0),this.material,s),this.axes=new Qi(new Kt(.003,.003,.16,8),this.material,s),this.dots=new Qi(new on(.011,16,12),this.material,s);for(let{mesh:r}of[this.lines,this.axes,this.dots])this.root.add(r);this.root.visible=!1,this.recolour(t)}actor;root=new Dt;exaggeration=1;on=!1;material=new Rn;joints;lines;dots;axes;get isKnown(){return this.joints.length>0}recolour(e){this.material.color.set(e.dark?"#ff7a70":"#d0312a")}proposed(e){let{bodies:t,modes:n}=this.actor.stage.layout,s=Math.max(1,Math.floor(e.count/FA)),r=0;for(let{violation:o}of this.joints)for(let[a,l]of[[o,1],[o+1,.3*this.actor.stage.size]]){let c=7*t+n+3*a;for(let h=0;h<e.count;h+=s){let u=l*Math.hypot(e.value(c,h),e.value(c+1,h),e.value(c+2,h));Number.isFinite(u)&&(r=Math.max(r,u))}}return r>0?10**Math.round(Math.log10(NA*this.actor.stage.size/r)):1}update(){if(this.root.visible=this.on,!this.on)return;let[e,t,n,s,r]=[0,1,2,3,4].map(()=>new S),o=new nt;this.joints.forEach((a,l)=>{if(a.bodies.some(d=>this.actor.isBad[d])){for(let d of[this.lines,this.dots,this.axes])d.hide(l);return}let c=this.actor.nearness.joint(a);this.actor.place(a.bodies[0],a.points[0],n),this.actor.vector(a.violation,e).multiplyScalar(this.exaggeration).clampLength(0,3*this.actor.stage.size),this.actor.vector(a.violation+1,t).multiplyScalar(this.exaggeration);let h=e.length();h>0&&o.setFromUnitVectors(ax,s.copy(e).divideScalar(h)),this.lines.set(l,n,o,r.set(1,Math.max(h,1e-9),1)),n.add(e),s.set(...a.axes[0]).applyQuaternion(this.actor.holder(a.bodies[0]).quaternion);let u=Math.min(t.length(),Math.PI);u>0&&s.applyAxisAngle(t.normalize(),u),r.setScalar(c),this.axes.set(l,n,o.setFromUnitVectors(ax,s.normalize()),r),this.dots.set(l,n,o,r)});for(let a of[this.lines,this.dots,this.axes])a.done()}},ax=new S(0,1,0);var lx={type:"change"},Wp={type:"start"},hx={type:"end"},Xu=new ar,cx=new si,UA=Math.cos(70*ci.DEG2RAD),In=new S,xi=2*Math.PI,kt={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},Gp=1e-6,qu=class extends ul{constructor(e,t=null){super(e,t),this.state=kt.NONE,this.target=new S,this.cursor=new S,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.keyRotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:fr.ROTATE,MIDDLE:fr.DOLLY,RIGHT:fr.PAN},this.touches={ONE:pr.ROTATE,TWO:pr.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._cursorStyle="auto",this._domElementKeyEvents=null,this._lastPosition=new S,this._lastQuaternion=new nt,this._lastTargetPosition=new S,this._quat=new nt().setFromUnitVectors(e.up,new S(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new Uo,this._sphericalDelta=new Uo,this._scale=1,this._panOffset=new S,this._rotateStart=new ue,this._rotateEnd=new ue,this._rotateDelta=new ue,this._panStart=new ue,this._panEnd=new ue,this._panDelta=new ue,this._dollyStart=new ue,this._dollyEnd=new ue,this._dollyDelta=new ue,this._dollyDirection=new S,this._mouse=new ue,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=BA.bind(this),this._onPointerDown=OA.bind(this),this._onPointerUp=kA.bind(this),this._onContextMenu=qA.bind(this),this._onMouseWheel=VA.bind(this),this._onKeyDown=GA.bind(this),this._onTouchStart=WA.bind(this),this._onTouchMove=XA.bind(this),this._onMouseDown=HA.bind(this),this._onMouseMove=zA.bind(this),this._interceptControlDown=YA.bind(this),this._interceptControlUp=$A.bind(this),this.domElement!==null&&this.connect(this.domElement),this.update()}set cursorStyle(e){this._cursorStyle=e,e==="grab"?this.domElement.style.cursor="grab":this.domElement.style.cursor="auto"}get cursorStyle(){return this._cursorStyle}connect(e){super.connect(e),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.ownerDocument.addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.state=kt.NONE,this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.ownerDocument.removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{capture:!0}),this._controlActive=!1,this._pointers.length=0,this._pointerPositions={},this.domElement.style.touchAction="",this.domElement.style.cursor="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(e){e.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=e}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(lx),this.update(),this.state=kt.NONE}pan(e,t){this._pan(e,t),this.update()}dollyIn(e){this._dollyIn(e),this.update()}dollyOut(e){this._dollyOut(e),this.update()}rotateLeft(e){this._rotateLeft(e),this.update()}rotateUp(e){this._rotateUp(e),this.update()}update(e=null){let t=this.object.position;In.copy(t).sub(this.target),In.applyQuaternion(this._quat),this._spherical.setFromVector3(In),this.autoRotate&&this.state===kt.NONE&&this._rotateLeft(this._getAutoRotationAngle(e)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let n=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(n)&&isFinite(s)&&(n<-Math.PI?n+=xi:n>Math.PI&&(n-=xi),s<-Math.PI?s+=xi:s>Math.PI&&(s-=xi),n<=s?this._spherical.theta=Math.max(n,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(n+s)/2?Math.max(n,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{let o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=o!=this._spherical.radius}if(In.setFromSpherical(this._spherical),In.applyQuaternion(this._quatInverse),t.copy(this.target).add(In),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){let a=In.length();o=this._clampDistance(a*this._scale);let l=a-o;this.object.position.addScaledVector(this._dollyDirection,l),this.object.updateMatrixWorld(),r=!!l}else if(this.object.isOrthographicCamera){let a=new S(this._mouse.x,this._mouse.y,0);a.unproject(this.object);let l=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=l!==this.object.zoom;let c=new S(this._mouse.x,this._mouse.y,0);c.unproject(this.object),this.object.position.sub(c).add(a),this.object.updateMatrixWorld(),o=In.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):(Xu.origin.copy(this.object.position),Xu.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(Xu.direction))<UA?this.object.lookAt(this.target):(cx.setFromNormalAndCoplanarPoint(this.object.up,this.target),Xu.intersectPlane(cx,this.target))))}else if(this.object.isOrthographicCamera){let o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>Gp||8*(1-this._lastQuaternion.dot(this.object.quaternion))>Gp||this._lastTargetPosition.distanceToSquared(this.target)>Gp?(this.dispatchEvent(lx),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(e){return e!==null?xi/60*this.autoRotateSpeed*e:xi/60/60*this.autoRotateSpeed}_getZoomScale(e){let t=Math.abs(e*.01);return Math.pow(.95,this.zoomSpeed*t)}_rotateLeft(e){this._sphericalDelta.theta-=e}_rotateUp(e){this._sphericalDelta.phi-=e}_panLeft(e,t){In.setFromMatrixColumn(t,0),In.multiplyScalar(-e),this._panOffset.add(In)}_panUp(e,t){this.screenSpacePanning===!0?In.setFromMatrixColumn(t,1):(In.setFromMatrixColumn(t,0),In.crossVectors(this.object.up,In)),In.multiplyScalar(e),this._panOffset.add(In)}_pan(e,t){let n=this.domElement;if(this.object.isPerspectiveCamera){let s=this.object.position;In.copy(s).sub(this.target);let r=In.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*e*r/n.clientHeight,this.object.matrix),this._panUp(2*t*r/n.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(e*(this.object.right-this.object.left)/this.object.zoom/n.clientWidth,this.object.matrix),this._panUp(t*(this.object.top-this.object.bottom)/this.object.zoom/n.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(e){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=e:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(e){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=e:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(e,t){if(!this.zoomToCursor)return;this._performCursorZoom=!0;let n=this.domElement.getBoundingClientRect(),s=e-n.left,r=t-n.top,o=n.width,a=n.height;this._mouse.x=s/o*2-1,this._mouse.y=-(r/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(e){return Math.max(this.minDistance,Math.min(this.maxDistance,e))}_handleMouseDownRotate(e){this._rotateStart.set(e.clientX,e.clientY)}_handleMouseDownDolly(e){this._updateZoomParameters(e.clientX,e.clientY),this._dollyStart.set(e.clientX,e.clientY)}_handleMouseDownPan(e){this._panStart.set(e.clientX,e.clientY)}_handleMouseMoveRotate(e){this._rotateEnd.set(e.clientX,e.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let t=this.domElement;this._rotateLeft(xi*this._rotateDelta.x/t.clientHeight),this._rotateUp(xi*this._rotateDelta.y/t.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(e){this._dollyEnd.set(e.clientX,e.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.zoomToCursor&&(this._performCursorZoom=!0,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()),this.update()}_handleMouseMovePan(e){this._panEnd.set(e.clientX,e.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(e){this._updateZoomParameters(e.clientX,e.clientY),e.deltaY<0?this._dollyIn(this._getZoomScale(e.deltaY)):e.deltaY>0&&this._dollyOut(this._getZoomScale(e.deltaY)),this.update()}_handleKeyDown(e){let t=!1;switch(e.code){case this.keys.UP:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateUp(xi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,this.keyPanSpeed),t=!0;break;case this.keys.BOTTOM:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateUp(-xi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,-this.keyPanSpeed),t=!0;break;case this.keys.LEFT:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateLeft(xi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(this.keyPanSpeed,0),t=!0;break;case this.keys.RIGHT:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateLeft(-xi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(-this.keyPanSpeed,0),t=!0;break}t&&(e.preventDefault(),this.update())}_handleTouchStartRotate(e){if(this._pointers.length===1)this._rotateStart.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),n=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._rotateStart.set(n,s)}}_handleTouchStartPan(e){if(this._pointers.length===1)this._panStart.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),n=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._panStart.set(n,s)}}_handleTouchStartDolly(e){let t=this._getSecondPointerPosition(e),n=e.pageX-t.x,s=e.pageY-t.y,r=Math.sqrt(n*n+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(e){this.enableZoom&&this._handleTouchStartDolly(e),this.enablePan&&this._handleTouchStartPan(e)}_handleTouchStartDollyRotate(e){this.enableZoom&&this._handleTouchStartDolly(e),this.enableRotate&&this._handleTouchStartRotate(e)}_handleTouchMoveRotate(e){if(this._pointers.length==1)this._rotateEnd.set(e.pageX,e.pageY);else{let n=this._getSecondPointerPosition(e),s=.5*(e.pageX+n.x),r=.5*(e.pageY+n.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let t=this.domElement;this._rotateLeft(xi*this._rotateDelta.x/t.clientHeight),this._rotateUp(xi*this._rotateDelta.y/t.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(e){if(this._pointers.length===1)this._panEnd.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),n=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._panEnd.set(n,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(e){let t=this._getSecondPointerPosition(e),n=e.pageX-t.x,s=e.pageY-t.y,r=Math.sqrt(n*n+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);let o=(e.pageX+t.x)*.5,a=(e.pageY+t.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(e){this.enableZoom&&this._handleTouchMoveDolly(e),this.enablePan&&this._handleTouchMovePan(e)}_handleTouchMoveDollyRotate(e){this.enableZoom&&this._handleTouchMoveDolly(e),this.enableRotate&&this._handleTouchMoveRotate(e)}_addPointer(e){this._pointers.push(e.pointerId)}_removePointer(e){delete this._pointerPositions[e.pointerId];for(let t=0;t<this._pointers.length;t++)if(this._pointers[t]==e.pointerId){this._pointers.splice(t,1);return}}_isTrackingPointer(e){for(let t=0;t<this._pointers.length;t++)if(this._pointers[t]==e.pointerId)return!0;return!1}_trackPointer(e){let t=this._pointerPositions[e.pointerId];t===void 0&&(t=new ue,this._pointerPositions[e.pointerId]=t),t.set(e.pageX,e.pageY)}_getSecondPointerPosition(e){let t=e.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[t]}_customWheelEvent(e){let t=e.deltaMode,n={clientX:e.clientX,clientY:e.clientY,deltaY:e.deltaY};switch(t){case 1:n.deltaY*=16;break;case 2:n.deltaY*=100;break}return e.ctrlKey&&!this._controlActive&&(n.deltaY*=10),n}};function OA(i){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(i.pointerId),this.domElement.ownerDocument.addEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(i)&&(this._addPointer(i),i.pointerType==="touch"?this._onTouchStart(i):this._onMouseDown(i),this._cursorStyle==="grab"&&(this.domElement.style.cursor="grabbing")))}function BA(i){this.enabled!==!1&&(i.pointerType==="touch"?this._onTouchMove(i):this._onMouseMove(i))}function kA(i){switch(this._removePointer(i),this._pointers.length){case 0:this.domElement.releasePointerCapture(i.pointerId),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(hx),this.state=kt.NONE,this._cursorStyle==="grab"&&(this.domElement.style.cursor="grab");break;case 1:let e=this._pointers[0],t=this._pointerPositions[e];this._onTouchStart({pointerId:e,pageX:t.x,pageY:t.y});break}}function HA(i){let e;switch(i.button){case 0:e=this.mouseButtons.LEFT;break;case 1:e=this.mouseButtons.MIDDLE;break;case 2:e=this.mouseButtons.RIGHT;break;default:e=-1}switch(e){case fr.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(i),this.state=kt.DOLLY;break;case fr.ROTATE:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=kt.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=kt.ROTATE}break;case fr.PAN:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=kt.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=kt.PAN}break;default:this.state=kt.NONE}this.state!==kt.NONE&&this.dispatchEvent(Wp)}function zA(i){switch(this.state){case kt.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(i);break;case kt.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(i);break;case kt.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(i);break}}function VA(i){this.enabled===!1||this.enableZoom===!1||this.state!==kt.NONE||(i.preventDefault(),this.dispatchEvent(Wp),this._handleMouseWheel(this._customWheelEvent(i)),this.dispatchEvent(hx))}function GA(i){this.enabled!==!1&&this._handleKeyDown(i)}function WA(i){switch(this._trackPointer(i),this._pointers.length){case 1:switch(this.touches.ONE){case pr.ROTATE:if(this.enableRotate===!1){this.state=kt.NONE;break}this._handleTouchStartRotate(i),this.state=kt.TOUCH_ROTATE;break;case pr.PAN:if(this.enablePan===!1){this.state=kt.NONE;break}this._handleTouchStartPan(i),this.state=kt.TOUCH_PAN;break;default:this.state=kt.NONE}break;case 2:switch(this.touches.TWO){case pr.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(i),this.state=kt.TOUCH_DOLLY_PAN;break;case pr.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(i),this.state=kt.TOUCH_DOLLY_ROTATE;break;default:this.state=kt.NONE}break;default:this.state=kt.NONE}this.state!==kt.NONE&&this.dispatchEvent(Wp)}function XA(i){switch(this._trackPointer(i),this.state){case kt.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(i),this.update();break;case kt.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(i),this.update();break;case kt.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(i),this.update();break;case kt.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(i),this.update();break;default:this.state=kt.NONE}}function qA(i){this.enabled!==!1&&i.preventDefault()}function YA(i){i.key==="Control"&&(this._controlActive=!0,this.domElement.ownerDocument.addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function $A(i){i.key==="Control"&&(this._controlActive=!1,this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}var ZA=260,Yu=class{constructor(e,t,n,s){this.from=e;this.target=t;this.to=n;this.aim=s}from;target;to;aim;start=performance.now();shift(e){this.to.add(e),this.aim.add(e)}bring(e,t,n){let s=Math.min(Math.max((n-this.start)/ZA,0),1),r=s*s*(3-2*s);t.lerpVectors(this.target,this.aim,r);let o=this.from.clone().sub(this.target),a=this.to.clone().sub(this.aim),l=ci.lerp(o.length(),a.length(),r),c=new nt().setFromUnitVectors(o.clone().normalize(),a.clone().normalize());return e.copy(o.applyQuaternion(new nt().slerp(c,r)).setLength(l)).add(t),s>=1}};var JA=26,KA=30,ux=12,jA=3,QA=300,$u=class{constructor(e,t){this.holder=e;this.stage=t;let n=eR();document.body.classList.toggle("plain",n),this.renderer=new iu({antialias:!n,powerPreference:"high-performance"}),this.renderer.shadowMap.enabled=!0,this.renderer.shadowMap.type=n?Af:mr,this.renderer.toneMapping=Hi,this.finest=n?1:Math.min(devicePixelRatio,2),this.ratio=this.finest;let s=this.renderer.domElement;s.setAttribute("aria-label",`${t.name} in three dimensions: drag to turn, two fingers or right button to move, wheel to zoom`),s.setAttribute("role","img"),s.tabIndex=0,e.append(s),this.up=Wo(t.up),this.low=Wo(t.low),this.high=Wo(t.high),this.cloud=Fl(new Ot(this.low,this.high)),this.camera.up.copy(this.up),this.controls=new qu(this.camera,s),this.controls.enableDamping=!1,this.controls.zoomToCursor=!0,this.controls.addEventListener("change",()=>this.invalidate()),this.controls.addEventListener("start",()=>{this.flight=null,this.fitted=!1}),this.floor=new Iu(t,this.look),this.floor.group.visible=!t.surroundings.length&&!t.terrains.length,this.scene.add(this.floor.group,this.sky,this.sun,this.sun.target),this.light(),this.recolour(),matchMedia("(prefers-color-scheme: dark)").addEventListener("change",()=>this.recolour()),new ResizeObserver(()=>{this.resize(),this.fitted&&this.fit(!1)}).observe(e),this.resize(),this.view("first",!1),requestAnimationFrame(r=>this.tick(r))}holder;stage;scene=new La;renderer;camera=new ri(JA,1,.01,1e3);controls;floor;look=Ep();onBeforeRender=()=>{};onEdges=()=>{};onRecolour=()=>{};around=null;now=null;frameCount=0;sun=new ll(16777215,2.1);sky=new rl(16777215,8950688,1.55);low;high;up;cloud;free={left:0,top:0,right:0,bottom:0};dirty=!0;finest;ratio;shadows=!0;fitted=!0;level=0;learnt=0;last=0;paces=[];flight=null;running=!1;invalidate(){this.dirty=!0}keepFree(e){this.free=e,this.resize(),this.fitted&&this.fit(!1)}setShadows(e){this.shadows=e,this.sun.castShadow=e&&this.level<1,this.floor.setShadows(this.sun.castShadow),this.invalidate()}drawFinely(){document.body.classList.remove("plain"),this.renderer.shadowMap.type=mr,this.finest=this.ratio=2,this.scene.traverse(e=>{if(e instanceof St)for(let t of[e.material].flat())t.needsUpdate=!0}),this.resize()}view(e,t=!0){let{towards:n,up:s}=Up(e,this.stage.viewpoint,this.up);this.fitted=!0,this.around&&this.see(this.around()),this.flyTo(n,s,t)}fit(e=!0){this.fitted=!0,this.around&&this.see(this.around());let t=this.camera.position.clone().sub(this.controls.target).normalize();this.flyTo(t,this.up,e)}fitNow(){if(this.around||!this.now)return this.fit();let e=this.cloud;this.see(this.now()),this.fit(),this.cloud=e,this.fitted=!1}get isFitted(){return this.fitted}holds(e){return this.flight?!0:(this.camera.updateMatrixWorld(),e.every(t=>{let{x:n,y:s,z:r}=t.clone().project(this.camera);return Math.abs(n)<=1&&Math.abs(s)<=1&&Math.abs(r)<=1}))}orbit(e,t){let n=this.camera.position.clone().sub(this.controls.target);n.applyAxisAngle(this.up,e);let s=new S().crossVectors(this.up,n).normalize(),r=n.clone().applyAxisAngle(s,-t);Math.abs(r.clone().normalize().dot(this.up))<.995&&n.copy(r),this.camera.position.copy(this.controls.target).add(n),this.controls.update(),this.invalidate()}zoom(e){this.fitted=!1,this.camera.position.sub(this.controls.target).multiplyScalar(e).add(this.controls.target),this.controls.update(),this.invalidate()}shift(e){if(this.fitted=!1,this.camera.position.add(e),this.controls.target.add(e),this.flight?.shift(e),this.controls.update(),!!this.around){for(let t of this.cloud)t.add(e);this.floor.under(this.controls.target),this.light()}}tick(e){requestAnimationFrame(t=>this.tick(t)),this.flight&&this.fly(e),this.onBeforeRender(e),this.running?this.draw(this.learnt):this.level&&e-this.last>QA&&this.draw(0),this.dirty&&(this.dirty=!1,this.near(),this.renderer.render(this.scene,this.camera),this.frameCount++,this.pace(e))}pace(e){let t=e-this.last;if(this.last=e,!this.running||t>500||(this.paces.push(t),this.paces.length<ux))return;let n=this.paces.sort((s,r)=>s-r)[ux>>1];this.paces.length=0,n>KA&&this.learnt<jA&&this.draw(++this.learnt)}draw(e){e!==this.level&&(this.level=e,this.sun.castShadow=this.shadows&&e<1,this.floor.setShadows(this.sun.castShadow),this.onEdges(e<2),this.ratio=e<3?this.finest:.6*this.finest,this.resize())}see(e){e.length&&(this.cloud=e)}middle(){return new Ot().setFromPoints(this.cloud).getCenter(new S)}framed(e,t){let{width:n,height:s}=this.size(),r={height:s,across:n-this.free.left-this.free.right,down:s-this.free.top-this.free.bottom};return Jy(this.cloud,e,t,r,this.camera.fov,this.stage.size)}flyTo(e,t,n){let{aim:s,distance:r}=this.framed(e,t),o=e.clone().normalize();Math.abs(o.dot(this.up))>.9999&&o.addScaledVector(t,-.001*Math.sign(o.dot(this.up))).normalize();let a=s.clone().addScaledVector(o,r),l=matchMedia("(prefers-reduced-motion: reduce)").matches;if(!n||l){this.flight=null,this.camera.position.copy(a),this.controls.target.copy(s),this.controls.update(),this.invalidate();return}this.flight=new Yu(this.camera.position.clone(),this.controls.target.clone(),a,s.clone())}fly(e){this.flight.bring(this.camera.position,this.controls.target,e)&&(this.flight=null),this.controls.update(),this.invalidate()}near(){let e=this.camera.position.distanceTo(this.middle()),t=.5*this.low.distanceTo(this.high)+12*this.stage.size,n=this.camera.position.distanceTo(this.controls.target);this.camera.near=Math.max(e-t,.02*Math.min(n,.2*this.stage.size)),this.camera.far=e+4*t,this.camera.updateProjectionMatrix()}light(){let e=this.middle(),t=Math.max(.75*this.low.distanceTo(this.high),.75*this.stage.size),{towards:n}=Up("first",this.stage.viewpoint,this.up),s=new S().crossVectors(this.up,n),r=this.up.clone().multiplyScalar(1.5).addScaledVector(n,.5).addScaledVector(s,-.55).normalize();this.sun.position.copy(e).addScaledVector(r,3*t),this.sun.target.position.copy(e),this.sun.castShadow=this.shadows&&this.level<1,this.sun.shadow.mapSize.set(2048,2048),this.sun.shadow.radius=3,this.sun.shadow.normalBias=.004*this.stage.size;let o=this.sun.shadow.camera;o.left=o.bottom=-1.25*t,o.right=o.top=1.25*t,o.near=.5*t,o.far=8*t,this.sky.position.copy(this.up)}recolour(){this.look=Ep(),this.scene.background=new et(this.look.sky),this.sky.intensity=this.look.dark?1.75:1.7,this.sun.intensity=this.look.dark?2.2:1.9,this.floor.recolour(this.look),this.onRecolour(this.look),this.invalidate()}size(){return{width:Math.max(this.holder.clientWidth,1),height:Math.max(this.holder.clientHeight,1)}}resize(){let{width:e,height:t}=this.size();this.renderer.setPixelRatio(this.ratio),this.renderer.setSize(e,t),this.camera.aspect=e/t;let{left:n,top:s,right:r,bottom:o}=this.free;this.camera.setViewOffset(e,t,(r-n)/2,(o-s)/2,e,t),this.camera.updateProjectionMatrix(),this.invalidate()}};function eR(){let i=document.createElement("canvas").getContext("webgl2"),e=i?.getExtension("WEBGL_debug_renderer_info"),t=i&&e?String(i.getParameter(e.UNMASKED_RENDERER_WEBGL)):"";return i?.getExtension("WEBGL_lose_context")?.loseContext(),/swiftshader|llvmpipe|softpipe|software|basic render/i.test(t)}function W(i,e={},...t){let n=document.createElement(i);for(let[s,r]of Object.entries(e))r===void 0||r===!1||(typeof r=="function"?n.addEventListener(s.slice(2),r):n.setAttribute(s,r===!0?"":String(r)));return n.append(...t.filter(s=>s!=null&&s!==!1)),n}var tR={play:'<path d="M6.5 4.2v11.6l9-5.8z" fill="currentColor" stroke-linejoin="round"/>',pause:'<path d="M6.8 4.5v11M13.2 4.5v11" stroke-width="2.6"/>',back:'<path d="M13.5 5l-6 5 6 5zM6 5v10" />',forward:'<path d="M6.5 5l6 5-6 5zM14 5v10"/>',loop:'<path d="M4 9.5a5 5 0 0 1 5-5h5.5M12 2l2.7 2.5L12 7M16 10.5a5 5 0 0 1-5 5H5.5M8 18l-2.7-2.5L8 13"/>',tree:'<path d="M4 4.5h6M4 4.5v11h4M4 10h4M11 10h5M11 15.5h5"/>',plot:'<path d="M3.5 3.5v13h13M6 13l3.2-4.5 2.6 2.6L16 5.5"/>',eye:'<path d="M2 10s3-5 8-5 8 5 8 5-3 5-8 5-8-5-8-5z"/><circle cx="10" cy="10" r="2.4"/>',cube:'<path d="M10 2.8l6.2 3.5v7.4L10 17.2l-6.2-3.5V6.3zM3.8 6.3L10 9.9l6.2-3.6M10 9.9v7.3"/>',help:'<circle cx="10" cy="10" r="7.2"/><path d="M7.8 7.8a2.2 2.2 0 1 1 3.2 2c-.7.4-1 .8-1 1.6M10 14.2v.1"/>',close:'<path d="M5.5 5.5l9 9M14.5 5.5l-9 9"/>',fit:'<path d="M3.5 7V3.5H7M13 3.5h3.5V7M16.5 13v3.5H13M7 16.5H3.5V13"/>',target:'<circle cx="10" cy="10" r="5.2"/><path d="M10 2v4M10 14v4M2 10h4M14 10h4"/>',path:'<path d="M3 15c3-9 6-9 7-4s4 4 7-6"/><circle cx="17" cy="5" r="1.6" fill="currentColor"/>',reset:'<path d="M4.5 10a5.5 5.5 0 1 0 1.8-4.1M6.5 2.5v3.7h3.7"/>'};function qs(i){let e=document.createElement("template");return e.innerHTML=`<svg viewBox="0 0 20 20" width="20" height="20" fill="none" stroke="currentColor" stroke-width="1.6" stroke-linecap="round" stroke-linejoin="round" aria-hidden="true">${tR[i]}</svg>`,e.content.firstElementChild}function En(i,e,t,n=""){return W("button",{type:"button",class:"icon-button","aria-label":e,title:n?`${e} (${n})`:e,onclick:t},qs(i))}function Zu(i,e,t,n=""){i.getAttribute("aria-label")!==t&&(i.replaceChildren(qs(e)),i.setAttribute("aria-label",t),i.title=n?`${t} (${n})`:t)}function ui(i,e,t){let n=W("input",{type:"checkbox",role:"switch",checked:e});return n.addEventListener("change",()=>t(n.checked)),W("label",{class:"toggle"},n,W("span",{},i))}function Xp(i,e,t,n){let s=W("select",{},...e.map(r=>W("option",{value:r},r||t)));return s.addEventListener("change",()=>n(s.value)),W("label",{class:"choice"},W("span",{},i),s)}function _s(i){return i.split(/(?<=[._-])/).flatMap((e,t)=>t?[document.createElement("wbr"),e]:[e])}var nR=1e-9,iR=.001,sR=["m","rad","deg","m/s","rad/s","m/s^2","rad/s^2","N","N m"];function Hr(i,e){let t=sR.includes(e)?iR:0;for(let n of i)n!==null&&Math.abs(n)>t&&(t=Math.abs(n));return Number.isFinite(t)?t:0}function mn(i,e=0){if(!Number.isFinite(i))return"–";let t=Math.abs(i);return t<=nR*e?"0":(t>=.001&&t<1e6?String(+i.toPrecision(5)):i.toExponential(2).replace(/\.?0+e/,"e").replace("e+","e")).replace(/^-/,"−").replace("e-","e−")}var rR=["N","N m","Pa","J","W"],oR=[[1e9,"G"],[1e6,"M"],[1e3,"k"]];function Yo(i,e,t=Hr(i,e)){let n=Math.max(...i.map(Math.abs)),[s,r]=rR.includes(e)&&oR.find(([o])=>n>=o)||[1,""];return{texts:i.map(o=>mn(+(o/s).toPrecision(4),t/s)),unit:e==="1"?"":r+e}}var Ju=class{constructor(e,t,n){this.move=t;let r=e.filter(o=>o.free).map(o=>this.row(o));this.element=W("div",{class:"coordinates"},W("header",{},W("h3",{},"Move the machine"),En("reset","Back to the assembled position",n,"R")),this.problem,r.length?W("ul",{},...r):W("p",{class:"note"},"Nothing of this machine can move."))}move;element;rows=[];problem=W("p",{class:"problem",role:"status"});update(e,t,n){let s=new Map(t.map((r,o)=>[r.name,e[o]]));for(let r of this.rows){let o=s.get(r.record.name);o!==void 0&&((document.activeElement!==r.slider||n)&&(r.slider.value=String(o)),r.value.textContent=dx(o,r.record))}this.problem.textContent=n}row(e){let t=W("output",{},dx(e.value,e)),n=W("input",{type:"range",min:e.low,max:e.high,step:"any",value:e.value,"aria-label":e.name});return n.addEventListener("input",()=>this.move(e.name,Number(n.value))),this.rows.push({record:e,slider:n,value:t}),W("li",{},W("label",{},W("span",{class:"name"},..._s(e.name)),t,n))}};function dx(i,{unit:e,low:t,high:n}){return e==="rad"?`${(i*180/Math.PI).toFixed(1)}°`.replace(/^-0\.0°/,"0.0°").replace("-","−"):`${mn(i,Hr([t,n],e))} ${e}`}var aR=[["first","First","0"],["front","Front","1"],["right","Right","2"],["top","Top","3"],["back","Back","4"],["left","Left","5"],["below","Below","6"]],lR={"applied-force":"Applied forces","applied-torque":"Applied torques","reaction-force":"Reaction forces","reaction-torque":"Reaction torques"},Ku=class{constructor(e){this.app=e;let t=aR.map(([n,s,r])=>W("button",{type:"button",class:"chip",title:`${s} (${r})`,onclick:()=>e.look(n)},s));this.element=W("div",{class:"display"},zr("Look from",W("div",{class:"chips"},...t)),this.colours(),zr("Show",...this.shown()),this.arrows(),this.violations(),this.flexible(),this.ghost())}app;element;shown(){let{app:e}=this,{stage:t}=e.actor;return[ui("Names of bodies",e.labels.shown.body,n=>e.name("body",n)),ui("Names of joints",e.labels.shown.joint,n=>e.name("joint",n)),...t.forces.length+t.drivers.length+t.couplings.length?[ui(t.couplings.length?"Names of forces and couplings":"Names of forces",e.labels.shown.force,n=>e.name("force",n))]:[],ui("Joint symbols",!e.live,n=>e.show("signs",n)),...t.joints.length?[ui("Joint axes",!1,n=>e.show("axes",n)),ui("Joint frames",!1,n=>e.show("joints",n))]:[],...t.markers.length?[ui("Marker frames",!1,n=>e.show("markers",n))]:[],ui("Body frames",!1,n=>e.show("triads",n)),ui("Centres of mass",!1,n=>e.show("centres",n)),ui("Grid",!0,n=>e.change(()=>e.world.floor.setGrid(n))),ui("Shadows",!0,n=>e.world.setShadows(n))]}arrows(){let{app:e}=this,t=Au.filter(c=>e.arrows.has(c));if(!t.length)return null;let n=c=>mn(+c.toPrecision(2)),s=n(e.actor.stage.size*.1),r=W("p",{class:"note"}),o=()=>{let h=["force","torque"].filter(u=>e.arrows.unit(u)>0).map(u=>`${n(e.arrows.unit(u))} ${u==="force"?"N":"N m"}`);r.textContent=`${s} m of arrow: ${h.join(", ")}`},a=qp("Length of arrows",-1,2,0,c=>{e.change(()=>e.arrows.scale=10**c),o()});o();let l=t.map(c=>ui(lR[c],e.arrows.shown.has(c),h=>e.change(()=>h?e.arrows.shown.add(c):e.arrows.shown.delete(c))));for(let[c,h]of t.entries())l[c].classList.add(h);return zr("Arrows",...l,a,r)}violations(){let{app:e}=this;if(!e.violations.isKnown||!e.motion)return null;let t=W("output",{}),n=Math.log10(e.violations.proposed(e.motion)),s=o=>{let a=10**Math.round(o);e.change(()=>e.violations.exaggeration=a),t.textContent=`× ${mn(a)}`},r=qp("Exaggeration",Math.min(0,n-4),Math.max(n+3,3),n,s,1);return s(n),zr("Open joints",ui("Constraint violations",!1,o=>e.change(()=>e.violations.on=o)),r,W("p",{class:"note"},"Exaggerated ",t))}colours(){let{app:e}=this,{ofBeams:t,ofBodies:n}=e.colours,s=e.actor.stage.colourless.map(a=>W("p",{class:"note"},a)),r=t.length?Xp("Beams by",["",...t],"nothing",a=>e.change(()=>e.colours.beams(a))):null,o=n.length?Xp("Bodies by",n,"",a=>e.change(()=>e.colours.bodies(a))):null;return r||o||s.length?zr("Colours",r,o,...s):null}flexible(){let{app:e}=this;if(!e.actor.deforming.length)return null;let t=W("output",{},"× 1"),n=qp("Exaggerate the deformation",0,3,0,s=>{for(let r of e.actor.deforming)r.exaggeration=10**s;t.textContent=`× ${mn(10**s)}`,e.refreshFrame()});return zr("Deformation",n,W("p",{class:"note"},"Drawn ",t))}ghost(){let{app:e}=this;return e.ghosts.length?zr("Second result",ui(e.ghosts.map(t=>t.actor.stage.title).join(", "),!0,t=>e.showGhosts(t)),...e.ghosts.flatMap(t=>t.actor.stage.notes.map(n=>W("p",{class:"note"},n)))):null}};function zr(i,...e){return W("section",{},W("h3",{},i),...e)}function qp(i,e,t,n,s,r="any"){let o=W("input",{type:"range",min:e,max:t,step:r,value:n});return o.addEventListener("input",()=>s(Number(o.value))),W("label",{class:"range"},W("span",{},i),o)}var fx="hydraulics.",px=1e5,cR=220;function hR(i){return`hsl(${Math.round(cR*(1-Math.min(Math.max(i,0),1)))} 80% 42%)`}var ju=class{element;shown=[];levels=[];key;highest=0;frame=0;constructor(e,t,n){let s=W("div",{class:"diagram"});s.innerHTML=e;let r=W("dialog",{class:"large-circuit"},W("form",{method:"dialog"},W("button",{class:"chip"},qs("close"),"Close"))),o=()=>{r.append(s),r.showModal()};this.element=W("section",{class:"circuits"},W("h3",{},"Hydraulics"),W("button",{type:"button",class:"chip",onclick:o},qs("fit"),"Large"),s),r.addEventListener("close",()=>this.element.append(s)),document.body.append(r),this.key=s.querySelector("[data-highest]");for(let a of s.querySelectorAll("[data-level]"))t.get(0,fx+a.getAttribute("data-level")).then(l=>{if(typeof l!="string"){this.levels.push({line:a,values:l});for(let c of l)this.highest=Math.max(this.highest,c);this.moveTo(this.frame)}});for(let a of s.querySelectorAll("[data-pressure]")){let l=fx+a.getAttribute("data-pressure"),c={place:a,values:null};this.shown.push(c),a.textContent="",a.closest("text")?.addEventListener("click",()=>n.toggle(l)),t.get(0,l).then(h=>{typeof h!="string"&&(c.values=h,this.moveTo(this.frame))})}}moveTo(e){this.frame=e;for(let{place:t,values:n}of this.shown){let s=n?.[e];s!==void 0&&(t.textContent=`${+(s/px).toPrecision(4)} bar`)}for(let{line:t,values:n}of this.levels){let s=n[e];s!==void 0&&this.highest>0&&(t.style.stroke=hR(s/this.highest))}this.key&&this.highest>0&&(this.key.textContent=`${+(this.highest/px).toPrecision(4)}`)}};var uR=60,Qu=class{constructor(e,t,n,s,r){this.stage=e;this.columns=t;this.plots=n;this.traces=s;this.actions=r;this.search.addEventListener("input",()=>this.list()),this.element.append(this.head,n.element),t.list().length&&this.element.append(W("section",{class:"all"},W("h3",{},"Variables"),this.search,this.found)),this.select(null)}stage;columns;plots;traces;actions;element=W("div",{class:"inspector"});numbers=[];picked=null;frame=0;head=W("div",{class:"chosen"});found=W("div",{class:"variables"});search=W("input",{type:"search",class:"search",placeholder:"Find a variable","aria-label":"Find a variable"});put(e){this.plots.element.after(e)}select(e){this.picked=e,this.describe(),this.list()}refresh(){this.describe(),this.list()}moveTo(e){this.frame=e;for(let{element:t,values:n,scale:s}of this.numbers)n&&(t.textContent=mn(n[e]??NaN,s))}describe(){let{picked:e}=this;if(!e){this.head.replaceChildren(W("p",{class:"note"},"Choose a part in the picture or the list to see its data."));return}let t=this.stage.bodies.findIndex(p=>p.name===e.name),{bodies:n,joints:s,forces:r,drivers:o,couplings:a}=this.stage,h={body:n,joint:s,force:r,driver:o,coupling:a}[e.kind].find(p=>p.name===e.name)?.facts??[],u=e.kind==="body"&&W("button",{type:"button",class:"chip","aria-pressed":String(this.actions.isFollowed(e)),onclick:()=>this.actions.follow()},qs("target"),"Follow"),f=(this.actions.canPlay?fR(this.stage,e,t):[]).map(p=>W("button",{type:"button",class:"chip","aria-pressed":String(this.traces.has(p.key)),onclick:()=>this.trace(p)},qs("path"),`Trace ${p.label}`));this.head.replaceChildren(W("h2",{},..._s(e.name)),W("dl",{},...h.flatMap(([p,y])=>[W("dt",{},p),W("dd",{},y)])),W("div",{class:"chips"},u,...f))}trace(e){this.traces.toggle(e),this.actions.change(),this.describe()}list(){let e=this.search.value.trim().toLowerCase(),t=this.columns.list(),n=a=>this.picked?a.owner===this.picked.name:a.owner==="",s=e?t.filter(a=>a.name.toLowerCase().includes(e)):t.filter(n);this.numbers.length=0;let r=s.slice(0,uR).map(a=>this.row(a)),o=s.length-r.length;this.found.replaceChildren(W("ul",{},...r),o>0?W("p",{class:"note"},`and ${o} more: write more of the name`):"",r.length?"":W("p",{class:"note"},e?"No variable has this in its name.":"None of its own.")),this.moveTo(this.frame)}row(e){let t=W("output",{}),n={element:t,values:null,scale:0};this.numbers.push(n),this.columns.get(0,e.name).then(r=>{typeof r!="string"&&(n.values=r,n.scale=Hr(r,e.unit),t.textContent=mn(r[this.frame]??NaN,n.scale))});let s=this.picked&&e.owner===this.picked.name?dR(e.name,e.owner):e.name;return W("li",{},W("button",{type:"button","aria-pressed":String(this.plots.has(e.name)),title:`Plot ${e.name}`,"aria-label":`Plot ${e.name}`,onclick:()=>this.plots.toggle(e.name)},qs("plot"),W("span",{class:"name"},..._s(s))),t,W("small",{},e.unit==="1"?"":e.unit))}};function dR(i,e){let t=["","force.","driver.","coupling."].map(n=>`${n}${e}.`).find(n=>i.startsWith(n));return t?i.slice(t.length):i}function fR(i,e,t){if(e.kind==="joint"){let r=i.joints.find(a=>a.name===e.name);if(!r)return[];let o=r.bodies[r.place]>=0?r.place:r.bodies[0]>=0?0:1;return r.bodies[o]<0?[]:[{key:`joint ${r.name}`,label:"its point",body:r.bodies[o],point:r.points[o]}]}let n=i.bodies[t];if(e.kind!=="body"||!n)return[];let s=i.markers.filter(r=>r.body===t).map(r=>({key:`marker ${r.name}`,label:r.name,body:t,point:r.point}));return[{key:`body ${n.name}`,label:"centre of mass",body:t,point:n.centre_of_mass},...s]}var ed=class{element=W("div",{class:"legend",role:"group","aria-label":"Colours"});said="";nows=[];show(e){let t=JSON.stringify(e.map(({now:n,...s})=>s));t!==this.said&&(this.nows.length=0,this.element.replaceChildren(...e.map(n=>this.row(n))),this.said=t),e.forEach((n,s)=>{let r=n.now===null?"":pR(n);this.nows[s].textContent!==r&&(this.nows[s].textContent=r)})}row({quantity:e,unit:t,low:n,high:s}){let r=W("div",{class:"ramp"});r.style.background=fy();let{texts:o,unit:a}=Yo([n,s],t),l=W("span");return this.nows.push(l),W("div",{class:"scale"},W("p",{class:"of"},`${e}${a?` [${a}]`:""}`),r,W("p",{class:"ends"},W("span",{},o[0]),l,W("span",{},o[1])))}};function pR({low:i,high:e,now:t,unit:n}){return`now up to ${Yo([i,e,t],n).texts[2]}`}var mx=[["space","play and pause"],["← →","one frame; ten with shift"],["home end","to the start, to the end"],["+ −","faster, slower"],["L","repeat"],["0 to 6","first view, front, right, top, back, left, below"],["F","follow the chosen body; fit everything where none is chosen"],["alt + arrows","turn the view; with page up and down, zoom"],["N","names"],["S, D","structure, display"],["P","data and plots"],["esc","close, choose nothing"],["?","this list"]],mR=[["space","run and pause"],["R","back to the start"],...mx.filter(([i])=>!/^(space|← →|home end|\+ −|L)$/.test(i))];function gx(i){let e=new Set(i?.flatMap(([s])=>s.split(" "))),t=i?mR.filter(([s])=>!s.split(/,? /).some(r=>e.has(r))):mx,n=W("dialog",{class:"help","aria-label":"Keys and mouse"},W("header",{},W("h2",{},"Keys and mouse"),En("close","Close",()=>n.close())),W("dl",{},...[...i??[],...t].flatMap(([s,r])=>[W("dt",{},s),W("dd",{},r)])),W("p",{class:"note"},"Drag to turn, right button or two fingers to move, wheel or pinch to zoom, click a part to choose it, click a plot to go to its time. Of a live machine, shift and drag pulls a body."));return n}function gR(i,e){return i instanceof HTMLElement?i instanceof HTMLInputElement&&(i.type==="search"||i.type==="text")?e!=="Escape":i instanceof HTMLInputElement&&i.type==="range"?!i.classList.contains("scrub")&&/Arrow|Home|End|Page/.test(e):i instanceof HTMLSelectElement?e!=="Escape":i instanceof HTMLButtonElement||i instanceof HTMLInputElement||i.tagName==="SUMMARY"?e===" "||e==="Enter":!1:!1}function yx(i){addEventListener("keydown",e=>{e.ctrlKey||e.metaKey||gR(e.target,e.key)||yR(i,e)&&e.preventDefault()})}function yR(i,e){let{key:t}=e,n=e.shiftKey?10:1;if(e.altKey)return xR(i,t);let s=Zy[Number(t)];if(/^[0-6]$/.test(t)&&s)return wn(i.look(s));if(t==="?")return wn(i.help());if(t==="Escape")return wn(i.escape());if(/^f$/i.test(t))return wn(i.followOrFit());if(/^n$/i.test(t))return wn(i.toggleNames());if(/^s$/i.test(t))return wn(i.togglePanel("structure"));if(/^d$/i.test(t))return wn(i.togglePanel("display"));if(/^p$/i.test(t))return wn(i.togglePanel("data"));if(/^r$/i.test(t))return wn(i.reset());let{player:r,live:o}=i;return o&&t===" "?wn(o.toggle()):r?t===" "?wn(r.toggle()):t==="ArrowLeft"?wn(r.step(-n)):t==="ArrowRight"?wn(r.step(n)):t==="Home"||t==="End"?(r.toggle(!1),wn(r.seek(t==="Home"?r.motion.start:r.motion.end))):t==="+"||t==="="?wn(r.faster(1)):t==="-"||t==="−"?wn(r.faster(-1)):/^l$/i.test(t)?(r.loop=!r.loop,wn(r.onChange())):!1:!1}function xR(i,e){let t=Math.PI/24,s={ArrowLeft:[-t,0],ArrowRight:[t,0],ArrowUp:[0,t],ArrowDown:[0,-t]}[e];return s?wn(i.world.orbit(...s)):e==="PageUp"?wn(i.world.zoom(.87)):e==="PageDown"?wn(i.world.zoom(1.15)):!1}function wn(i){return!0}var td=class{constructor(e,t,n){this.controls=e;this.send=t;this.take=n;this.values=e.map(s=>s.rest),this.hand=e.map(()=>null),this.keys=new Set(e.flatMap(s=>[s.raises,s.lowers]).filter(Boolean)),addEventListener("keydown",s=>this.press(s),!0),addEventListener("keyup",s=>this.held.delete(xx(s.key))&&this.refresh(),!0),addEventListener("blur",()=>this.letGo()),document.addEventListener("visibilitychange",()=>document.hidden&&this.letGo()),setInterval(()=>this.refresh(),20)}controls;send;take;values;driving=!1;onValues=()=>{};held=new Set;hand;sticks=new Map;keys;last=performance.now();asked=-1e3;move(e,t){this.begin(),!(t===null&&this.controls[e].hold)&&(this.hand[e]=t)}deflect(e,t){t&&this.begin(),this.sticks.set(e,t)}follow(e){this.controls.forEach((t,n)=>{t.hold&&(this.hand[n]=this.values[n]=e[n]??t.rest)})}rest(){this.letGo(),this.controls.forEach((e,t)=>{this.hand[t]=null,this.values[t]=e.rest})}letGo(){this.held.clear(),this.sticks.clear(),this.controls.forEach((e,t)=>e.hold||(this.hand[t]=null))}begin(){this.driving||this.take()}askWithPad(){let e=performance.now();e-this.asked<1e3||(this.asked=e,this.take())}press(e){let t=xx(e.key);e.ctrlKey||e.metaKey||e.altKey||!this.keys.has(t)||_R(e.target)||(e.preventDefault(),e.stopImmediatePropagation(),!this.held.has(t)&&(this.begin(),this.held.add(t),this.refresh()))}refresh(){let e=performance.now(),t=Math.min(e-this.last,100)/1e3;this.last=e;let n=[...navigator.getGamepads?.()??[]].find(s=>s?.connected)??null;this.controls.forEach((s,r)=>this.values[r]=this.wanted(s,r,n,t)),this.driving&&this.send(this.values),this.onValues()}wanted(e,t,n,s){let{low:r,high:o,rest:a,hold:l}=e,c=Number(this.held.has(e.raises))-Number(this.held.has(e.lowers)),h=c||this.sticks.get(e.stick)||vR(e,n);if(!c&&h&&n&&!this.driving&&this.askWithPad(),l){let u=this.hand[t]??this.values[t],d=Math.min(Math.max(u+h*s*(o-r)/1.5,r),o);return this.hand[t]=d,d}return h?h>0?a+h*(o-a):a+h*(a-r):this.hand[t]??a}};function vR(i,e){if(!e)return 0;let t=i.axis>=0?e.axes[i.axis]??0:i.button>=0?e.buttons[i.button]?.value??0:0,n=(Math.abs(t)-i.dead_zone)/(1-i.dead_zone),s=n>0?Math.min(n,1)**i.exponent:0;return(i.reverse?-1:1)*Math.sign(t)*s}function xx(i){return i.length===1?i.toLowerCase():i}function _R(i){return i instanceof HTMLInputElement&&(i.type==="search"||i.type==="text")}var nd=38,id=class{constructor(e,t,n){this.moved=n;let s=W("div",{class:"stick",role:"application","aria-label":t.join(", ")},this.knob);this.element=W("figure",{},s,W("figcaption",{},...t.map(a=>W("span",{},a))));let r=(a,l)=>{this.knob.style.transform=`translate(${a*nd}px, ${-l*nd}px)`,this.moved(`${e}-x`,a),this.moved(`${e}-y`,l)},o=a=>{let l=s.getBoundingClientRect(),c=h=>Math.min(Math.max(h,-1),1);r(c((a.clientX-l.left-l.width/2)/nd),c((l.top+l.height/2-a.clientY)/nd))};s.addEventListener("pointerdown",a=>{s.setPointerCapture(a.pointerId),o(a)}),s.addEventListener("pointermove",a=>a.buttons&&o(a));for(let a of["pointerup","pointercancel","lostpointercapture"])s.addEventListener(a,()=>r(0,0))}moved;element;knob=W("i",{})};var vx=15,_x=1e-6,bR=284,MR=40,bx=4,sd=class{constructor(e){this.gauge=e;let t=SR(e);this.element=W("li",{class:"strip",title:e.name},W("span",{class:"name"},e.label),this.output,this.canvas,t?W("small",{class:"scale"},t):null)}gauge;element;times=[];numbers=[];value=NaN;output=W("output",{});canvas=W("canvas",{width:2*bR,height:2*MR,"aria-hidden":"true"});show(e){this.value=e}add(e,t){let n=this.times.at(-1);for(n!==void 0&&e<n&&(this.times.length=this.numbers.length=0),this.times.push(e),this.numbers.push(Math.abs(t)<.001*_x?0:t);this.times[0]<e-vx;)this.times.shift(),this.numbers.shift()}draw(){let{low:e,high:t,limit:n}=this.gauge,s=Math.max(...this.numbers.map(Math.abs),Math.abs(e??0),Math.abs(t??0),.001),{texts:r,unit:o}=$p(this.gauge,[this.value],s);this.output.textContent=Yp(r[0],o),this.element.classList.toggle("beyond",n!==null&&Math.abs(this.value)>n);let a=this.canvas.getContext("2d"),l=this.times.at(-1);if(!a||l===void 0)return;let{width:c,height:h}=this.canvas,u=Math.min(...this.numbers,e??1/0),d=Math.max(...this.numbers,t??-1/0),f=Math.max(d-u,_x*Math.max(Math.abs(u),Math.abs(d),1)),p=g=>h-bx-(g-u)/f*(h-2*bx),y=getComputedStyle(this.element);if(a.clearRect(0,0,c,h),n!==null){a.strokeStyle=y.getPropertyValue("--limit"),a.lineWidth=2,a.setLineDash([8,6]);for(let g of[n,-n].filter(m=>m<=d&&m>=u))a.beginPath(),a.moveTo(0,p(g)),a.lineTo(c,p(g)),a.stroke();a.setLineDash([])}a.strokeStyle=y.getPropertyValue("--accent"),a.lineWidth=2.5,a.beginPath(),this.numbers.forEach((g,m)=>{let x=c*(1-(l-this.times[m])/vx);m?a.lineTo(x,p(g)):a.moveTo(x,p(g))}),a.stroke()}};function SR(i){let{low:e,high:t,limit:n}=i,s=[];if(e!==null&&t!==null){let{texts:r,unit:o}=$p(i,[e,t]);s.push(Yp(r.join(" … "),o))}if(n!==null){let{texts:r,unit:o}=$p(i,[n]);s.push(`limit ${Yp(r[0],o)}`)}return s.join(", ")}function Yp(i,e){return e==="°"?`${i}°`:`${i} ${e}`.trim()}function $p({unit:i},e,t){if(i!=="rad"&&i!=="deg")return Yo(e,i,t);let n=s=>i==="deg"?s:s*180/Math.PI;return{...Yo(e.map(n),"deg",t&&n(t)),unit:"°"}}var ER=[.05,.1,.25,.5,1],wR={you:"You operate",other:"Somebody operates",program:"A program operates",nobody:"Take the controls"},Zp=3,TR=100,rd=class{constructor(e,t,n,s,r){this.controls=e;this.gauges=t;this.send=n;this.alone=s;this.operator=new td(e,f=>n({type:"drive",values:f}),()=>this.take(!0)),this.run=En("play","Run",()=>this.toggle(),"space"),this.run.classList.add("main-button"),this.seat=W("button",{type:"button",class:"chip seat",onclick:()=>this.take(this.status?.driver!=="you")},"Take the controls"),this.speed=W("select",{"aria-label":"Speed",title:"Simulated over real time"},...ER.map(f=>W("option",{value:f,selected:f===1},`${f}×`))),this.speed.addEventListener("change",()=>this.say("speed",Number(this.speed.value)));let o=W("button",{type:"button",class:"chip",title:"Drag a body with the mouse; shift does it too","aria-pressed":"false"},"Pick up");o.addEventListener("click",()=>{let f=o.getAttribute("aria-pressed")!=="true";o.setAttribute("aria-pressed",String(f)),this.onHand(f)});let a=En("forward","One tick",()=>this.say("step")),l=En("reset","Back to the start",()=>this.say("reset")),c=W("button",{type:"button",class:"chip",onclick:()=>this.say("save")},"Save state"),h=W("button",{type:"button",class:"chip",onclick:()=>this.say("restore")},"Restore"),u=W("button",{type:"button",class:"chip",title:"Save all frames of this motion as a table (CSV)",onclick:()=>n({type:"command",word:"table",number:0})},"Save table");this.commands=[this.run,a,l,o,c,h,this.speed,this.seat],this.bar=W("footer",{class:"timeline live-bar",role:"group","aria-label":"Live"},W("div",{class:"transport"},this.run,a,l),W("div",{class:"clock"},this.clock),W("span",{class:"of load"},this.light,this.load),W("div",{class:"pace"},o,c,h,s?u:null,this.speed,this.seat)),this.hint=W("p",{class:"note"},CR(e)),this.rows=e.map((f,p)=>this.row(f,p)),this.strips=t.map(f=>new sd(f));let d=["left","right"].filter(f=>e.some(p=>p.stick.startsWith(f)));this.panel=W("div",{class:"live"},this.problem,this.reasons,e.length?W("h3",{},"Controls"):null,e.length?this.hint:null,d.length?W("div",{class:"sticks"},...d.map(f=>new id(f,PR(f,e),(p,y)=>this.operator.deflect(p,y)).element)):null,W("ul",{class:"controls"},...this.rows.map(f=>f.output.closest("li"))),r.length?W("h3",{},"Parameters"):null,r.length?W("p",{class:"note"},"With another value the machine goes back to its start."):null,W("ul",{class:"controls"},...r.map((f,p)=>this.parameter(f,p))),t.length?W("h3",{},"Gauges"):null,W("ul",{class:"strips"},...this.strips.map(f=>f.element)))}controls;gauges;send;alone;bar;panel;operator;status=null;onHand=()=>{};strips;rows;run;seat;speed;clock=W("output",{class:"time","aria-live":"off"});load=W("span",{});light=W("span",{class:"light",role:"img"});reasons=W("ul",{class:"reasons"});problem=W("p",{class:"problem",role:"status"});hint;commands;chosen=[];drawn=0;resumes=!1;toggle(){this.say(this.status?.mode==="running"?"pause":"run")}take(e){this.send({type:"take",on:e?1:0}),e||this.operator.rest(),this.operator.driving=e&&this.status?.driver!=="other"}say(e,t=0){this.status?.watches||(!this.operator.driving&&this.status?.driver!=="program"&&this.take(!0),this.send({type:"command",word:e,number:t}))}lose(){this.resumes||=this.operator.driving,this.operator.driving=!1}get keys(){return this.controls.filter(e=>e.lowers||e.raises).map(e=>[[e.lowers,e.raises].filter(Boolean).map(Sx).join(" "),e.description?`${e.label}: ${e.description}`:e.label])}update(e){this.status=e,this.operator.driving=e.driver==="you",this.resumes&&e.driver==="nobody"&&this.take(!0),this.resumes=!1;let t=e.mode==="running";Zu(this.run,t?"pause":"play",t?"Pause":"Run","space"),this.seat.textContent=wR[e.driver],this.seat.setAttribute("aria-pressed",String(e.driver==="you")),this.clock.textContent=`${e.time.toFixed(2)} s`;let n=100*e.computing/e.tick;this.load.textContent=`${t?"":`${e.mode} · `}${mn(+e.computing.toPrecision(2))} µs a tick, ${n.toPrecision(2)} %${e.overruns?`, ${e.overruns} late`:""}`,this.load.title=`99 % of the ticks are computed in at most this time, and begin at most ${mn(+e.late.toPrecision(2))} µs after their deadlines. ${e.overruns} ended after the next deadline, ${e.own} of them by their own computing.`,this.problem.textContent=e.text,this.judge(e),this.allow(e),document.activeElement!==this.speed&&(this.speed.value=String(e.speed)),this.hint.hidden=e.driver==="you"||e.driver==="program"}judge(e){this.light.dataset.verdict=e.light;let t=`Energy, joints, circuits and computing time are ${e.light} so far.`;this.light.title=[t,`Not verified: the errors of the steps are not examined${this.alone?"":"; nivel replay estimates them"}.`,...e.reasons].join(`
`),this.light.setAttribute("aria-label",`trust: ${e.light}, not verified`);let n=e.text?e.reasons.filter(s=>!s.includes(e.text)):e.reasons;this.reasons.dataset.shown!==n.join(`
`)&&(this.reasons.dataset.shown=n.join(`
`),this.reasons.dataset.verdict=e.light,this.reasons.replaceChildren(...n.map(s=>W("li",{},s))))}allow(e){for(let t of this.commands)t.disabled=!!e.watches||t===this.seat&&e.driver==="program";for(let{slider:t}of this.rows)t&&(t.disabled=e.driver==="program");this.bar.title=e.watches,e.watches&&!e.text&&(this.problem.textContent=`${e.watches[0].toUpperCase()}${e.watches.slice(1)}.`),this.problem.classList.toggle("watching",!!e.watches&&!e.text)}sample({width:e,values:t}){for(let n=0;n<t.length;n+=e)this.strips.forEach((s,r)=>s.add(t[n],t[n+1+r]))}show(e,t){this.clock.textContent=`${e.toFixed(2)} s`,this.strips.forEach((s,r)=>s.show(t[r]??NaN)),this.operator.driving||this.operator.follow(t.subarray(this.gauges.length));let n=performance.now();if(!(n-this.drawn<TR)){this.drawn=n;for(let s of this.strips)s.draw();this.rows.forEach((s,r)=>{let o=t[this.gauges.length+r]??NaN;s.output.textContent=Mx(s.control,o),s.slider&&document.activeElement!==s.slider&&(s.slider.value=String(this.operator.driving?this.operator.values[r]:o))})}}parameter(e,t){let{name:n,unit:s,value:r,least:o}=e,[a,l]=AR(e),c=W("input",{type:"range",min:a,max:l,step:"any",value:r,"aria-label":n}),h=W("input",{type:"number",step:"any",value:r,"aria-label":`${n}, as a number`}),u=d=>{let f=d>=o?d:this.chosen[t];[c.value,h.value]=[String(f),String(+f.toPrecision(6))],f!==this.chosen[t]&&this.send({type:"adjust",parameter:t,value:f}),this.chosen[t]=f};return this.chosen[t]=r,c.addEventListener("input",()=>h.value=String(+Number(c.value).toPrecision(6))),c.addEventListener("change",()=>u(Number(c.value))),h.addEventListener("change",()=>u(h.value?Number(h.value):r)),W("li",{class:"parameter"},W("span",{class:"name"},n),W("span",{},h,` ${s}`),c)}row(e,t){let n=W("output",{},Mx(e,e.rest)),s=[e.lowers,e.raises].filter(Boolean).map(l=>W("kbd",{},Sx(l))),r=e.description?W("small",{},e.description):null,o=W("span",{class:"name"},e.label,...s,r);if(e.look==="button"){let l=W("button",{type:"button",class:"chip"},"Press"),c=()=>this.operator.move(t,e.high),h=()=>this.operator.driving&&this.operator.move(t,null);l.addEventListener("pointerdown",c),l.addEventListener("keydown",u=>(u.key===" "||u.key==="Enter")&&c());for(let u of["pointerup","pointerleave","pointercancel","keyup","blur"])l.addEventListener(u,h);return W("li",{},o,n,l),{control:e,slider:null,output:n}}let a=W("input",{type:"range",min:e.low,max:e.high,step:"any",value:e.rest,"aria-label":e.label});return a.addEventListener("input",()=>this.operator.move(t,Number(a.value))),a.addEventListener("change",()=>{this.operator.move(t,null),e.hold||(a.value=String(e.rest),a.blur())}),W("li",{},W("label",{},o,n,a)),{control:e,slider:a,output:n}}};function AR({value:i,least:e}){if(i<0)return[Zp*i,0];let t=i?0:-1;return[e>0?i/Zp**2:Math.max(t,e),i?Zp*i:1]}function Mx({unit:i,low:e,high:t},n){let s=Math.max(Math.abs(e),Math.abs(t));return!i&&s===1?`${mn(Math.round(100*n))} %`:`${mn(+n.toPrecision(3),s)} ${i}`.trim()}var RR={ArrowLeft:"←",ArrowRight:"→",ArrowUp:"↑",ArrowDown:"↓"," ":"space"};function Sx(i){return RR[i]??i.toUpperCase()}function CR(i){let e=[...i.some(n=>n.raises||n.lowers)?["hold a key"]:[],"move a slider",...i.some(n=>n.stick)?["a stick"]:[],...i.some(n=>n.axis>=0||n.button>=0)?["a gamepad"]:[]];return`To operate the machine, ${e.length>1?`${e.slice(0,-1).join(", ")} or ${e.at(-1)}`:e[0]}.`}function PR(i,e){return e.filter(t=>t.stick.startsWith(i)).map(t=>`${t.stick.endsWith("x")?"↔":"↕"} ${t.label}`)}var Bl={structure:"Structure",data:"Data and plots",display:"Display"},IR={structure:"tree",data:"plot",display:"eye"},Ex={structure:"S",data:"P",display:"D"},od=760,LR=60,DR=1080,ad=class{constructor(e,t,n,s,r,o,a){this.world=n;this.timeline=r;let l=Object.keys(Bl);this.buttons=Object.fromEntries(l.map(d=>[d,En(IR[d],Bl[d],()=>this.toggle(d),Ex[d])])),this.panels=Object.fromEntries(l.map(d=>[d,this.panel(d,s[d])]));let c=t.map(d=>W("li",{class:"ghost"},W("i",{}),NR(d,e))),h=e.notes.length+c.length?W("ul",{class:"notes"},...e.notes.map(d=>W("li",{},d)),...c):null;this.bar=W("header",{class:"top"},this.buttons.structure,W("div",{class:"title"},W("h1",{},e.name),h,o),W("nav",{"aria-label":"Panels"},En("fit","Fit to the present position",()=>n.fitNow(),"F"),this.buttons.display,this.buttons.data,En("help","Keys and mouse",a,"?"))),this.elements=[this.bar,...l.map(d=>this.panels[d]),...r?[r]:[]],document.body.classList.toggle("has-timeline",!!r);let u=new ResizeObserver(()=>this.arrange());u.observe(this.bar),r&&u.observe(r),addEventListener("resize",()=>{this.makeRoom(),this.arrange()})}world;timeline;elements;panels;buttons;bar;latest="data";settle(e,t=!0){e&&this.rename("data","Joints and data"),innerWidth>=DR&&innerHeight>480?(this.set("structure",t),this.set("data",!0)):e&&this.set("data",!0),this.arrange(),this.world.view("first",!1)}toggle(e){let t=this.panels[e].hidden===!0;t&&(this.latest=e),t&&innerWidth<od&&this.close(),t&&e==="data"&&this.set("display",!1),t&&e==="display"&&this.set("data",!1),this.set(e,t),this.arrange()}offer(e){innerWidth<od||!this.panels[e].hidden||!this.panels.display.hidden||this.toggle(e)}closeTop(){for(let e of["display","data","structure"])if(!this.panels[e].hidden){this.toggle(e);return}}close(){for(let e of Object.keys(this.panels))this.set(e,!1)}makeRoom(){let e=this.open();if(innerWidth>=od||e.length<2)return;let t=e.includes(this.latest)?this.latest:e[0];for(let n of e)n!==t&&this.set(n,!1)}open(){return Object.keys(this.panels).filter(e=>!this.panels[e].hidden)}rename(e,t){this.panels[e].setAttribute("aria-label",t),this.panels[e].querySelector("h2").textContent=t,this.buttons[e].setAttribute("aria-label",t),this.buttons[e].title=`${t} (${Ex[e]})`}set(e,t){this.panels[e].hidden=!t,this.buttons[e].setAttribute("aria-pressed",String(t))}arrange(){this.panels.structure.style.setProperty("--top",`${Math.max(LR,this.bar.offsetHeight)}px`),document.body.style.setProperty("--foot",`${this.timeline?.offsetHeight??0}px`);let e={left:0,top:this.bar.offsetHeight,right:0,bottom:this.timeline?.offsetHeight?innerHeight-this.timeline.getBoundingClientRect().top:0};for(let t of this.open()){let n=this.panels[t].getBoundingClientRect();innerWidth<od?e.bottom+=n.height:t==="structure"?e.left=n.right:e.right=innerWidth-n.left}this.world.keepFree(e)}panel(e,t){return W("aside",{class:`panel ${e==="structure"?"left":"right"} ${e}`,hidden:!0,"aria-label":Bl[e]},W("div",{class:"panel-head"},W("h2",{},Bl[e]),En("close",`Close ${Bl[e].toLowerCase()}`,()=>this.toggle(e))),W("div",{class:"panel-body"},t))}};function NR(i,e){let t=s=>s.bodies.map(r=>r.name).join(`
`),n=i.name===e.name&&t(i)===t(e);return`Ghost: ${i.title}${n?"":i.title===i.name?", another machine":`, another machine: ${i.name}`}`}var FR="uplot",UR="u-hz",OR="u-vt",BR="u-title",kR="u-wrap",HR="u-under",zR="u-over",VR="u-axis",Wr="u-off",GR="u-select",WR="u-cursor-x",XR="u-cursor-y",qR="u-cursor-pt",YR="u-legend",$R="u-live",ZR="u-inline",JR="u-series",KR="u-marker",wx="u-label",jR="u-value",Hl="width",zl="height";var Tx="bottom",$o="left",Jp="right",fm="#000",Ax=fm+"0",Kp="mousemove",Rx="mousedown",jp="mouseup",Cx="mouseenter",Px="mouseleave",Ix="dblclick",QR="resize",eC="scroll",Lx="change",dd="dppxchange",pm="--",ta=typeof window<"u",im=ta?document:null,Jo=ta?window:null,tC=ta?navigator:null,Ht,ld;function sm(){let i=devicePixelRatio;Ht!=i&&(Ht=i,ld&&om(Lx,ld,sm),ld=matchMedia(`(min-resolution: ${Ht-.001}dppx) and (max-resolution: ${Ht+.001}dppx)`),Xr(Lx,ld,sm),Jo.dispatchEvent(new CustomEvent(dd)))}function Ii(i,e){if(e!=null){let t=i.classList;!t.contains(e)&&t.add(e)}}function rm(i,e){let t=i.classList;t.contains(e)&&t.remove(e)}function sn(i,e,t){i.style[e]=t+"px"}function es(i,e,t,n){let s=im.createElement(i);return e!=null&&Ii(s,e),t?.insertBefore(s,n),s}function Vi(i,e){return es("div",i,e)}var Dx=new WeakMap;function bs(i,e,t,n,s){let r="translate("+e+"px,"+t+"px)",o=Dx.get(i);r!=o&&(i.style.transform=r,Dx.set(i,r),e<0||t<0||e>n||t>s?Ii(i,Wr):rm(i,Wr))}var Nx=new WeakMap;function Fx(i,e,t){let n=e+t,s=Nx.get(i);n!=s&&(Nx.set(i,n),i.style.background=e,i.style.borderColor=t)}var Ux=new WeakMap;function Ox(i,e,t,n){let s=e+""+t,r=Ux.get(i);s!=r&&(Ux.set(i,s),i.style.height=t+"px",i.style.width=e+"px",i.style.marginLeft=n?-e/2+"px":0,i.style.marginTop=n?-t/2+"px":0)}var mm={passive:!0},nC={...mm,capture:!0};function Xr(i,e,t,n){e.addEventListener(i,t,n?nC:mm)}function om(i,e,t,n){e.removeEventListener(i,t,mm)}ta&&sm();function ts(i,e,t,n){let s;t=t||0,n=n||e.length-1;let r=n<=2147483647;for(;n-t>1;)s=r?t+n>>1:Li((t+n)/2),e[s]<i?t=s:n=s;return i-e[t]<=e[n]-i?t:n}function uv(i){return(t,n,s)=>{let r=-1,o=-1;for(let a=n;a<=s;a++)if(i(t[a])){r=a;break}for(let a=s;a>=n;a--)if(i(t[a])){o=a;break}return[r,o]}}var dv=i=>i!=null,fv=i=>i!=null&&i>0,md=uv(dv),iC=uv(fv);function sC(i,e,t,n=0,s=!1){let r=s?iC:md,o=s?fv:dv;[e,t]=r(i,e,t);let a=i[e],l=i[e];if(e>-1)if(n==1)a=i[e],l=i[t];else if(n==-1)a=i[t],l=i[e];else for(let c=e;c<=t;c++){let h=i[c];o(h)&&(h<a?a=h:h>l&&(l=h))}return[a??Zt,l??-Zt]}function gd(i,e,t,n){let s=Hx(i),r=Hx(e);i==e&&(s==-1?(i*=t,e/=t):(i/=t,e*=t));let o=t==10?Ys:pv,a=s==1?Li:Gi,l=r==1?Gi:Li,c=a(o(Dn(i))),h=l(o(Dn(e))),u=Ko(t,c),d=Ko(t,h);return t==10&&(c<0&&(u=Jt(u,-c)),h<0&&(d=Jt(d,-h))),n||t==2?(i=u*s,e=d*r):(i=xv(i,u),e=yd(e,d)),[i,e]}function gm(i,e,t,n){let s=gd(i,e,t,n);return i==0&&(s[0]=0),e==0&&(s[1]=0),s}var ym=.1,Bx={mode:3,pad:ym},Gl={pad:0,soft:null,mode:0},rC={min:Gl,max:Gl};function fd(i,e,t,n){return xd(t)?kx(i,e,t):(Gl.pad=t,Gl.soft=n?0:null,Gl.mode=n?3:0,kx(i,e,rC))}function Ft(i,e){return i??e}function oC(i,e,t){for(e=Ft(e,0),t=Ft(t,i.length-1);e<=t;){if(i[e]!=null)return!0;e++}return!1}function kx(i,e,t){let n=t.min,s=t.max,r=Ft(n.pad,0),o=Ft(s.pad,0),a=Ft(n.hard,-Zt),l=Ft(s.hard,Zt),c=Ft(n.soft,Zt),h=Ft(s.soft,-Zt),u=Ft(n.mode,0),d=Ft(s.mode,0),f=e-i,p=Ys(f),y=di(Dn(i),Dn(e)),g=Ys(y),m=Dn(g-p);(f<1e-24||m>10)&&(f=0,(i==0||e==0)&&(f=1e-24,u==2&&c!=Zt&&(r=0),d==2&&h!=-Zt&&(o=0)));let x=f||y||1e3,M=Ys(x),_=Ko(10,Li(M)),C=x*(f==0?i==0?.1:1:r),T=Jt(xv(i-C,_/10),24),v=i>=c&&(u==1||u==3&&T<=c||u==2&&T>=c)?c:Zt,E=di(a,T<v&&i>=v?v:ns(v,T)),N=x*(f==0?e==0?.1:1:o),P=Jt(yd(e+N,_/10),24),I=e<=h&&(d==1||d==3&&P>=h||d==2&&P<=h)?h:-Zt,k=ns(l,P>I&&e<=I?I:di(I,P));return E==k&&E==0&&(k=100),[E,k]}var aC=new Intl.NumberFormat(ta?tC.language:"en-US"),xm=i=>aC.format(i),Di=Math,ud=Di.PI,Dn=Di.abs,Li=Di.floor,Ln=Di.round,Gi=Di.ceil,ns=Di.min,di=Di.max,Ko=Di.pow,Hx=Di.sign,Ys=Di.log10,pv=Di.log2,lC=(i,e=1)=>Di.sinh(i)*e,Qp=(i,e=1)=>Di.asinh(i/e),Zt=1/0;function zx(i){return(Ys((i^i>>31)-(i>>31))|0)+1}function am(i,e,t){return ns(di(i,e),t)}function mv(i){return typeof i=="function"}function It(i){return mv(i)?i:()=>i}var cC=()=>{},gv=i=>i,yv=(i,e)=>e,hC=i=>null,Vx=i=>!0,Gx=(i,e)=>i==e,uC=/\.\d*?(?=9{6,}|0{6,})/gm,qr=i=>{if(_v(i)||br.has(i))return i;let e=`${i}`,t=e.match(uC);if(t==null)return i;let n=t[0].length-1;if(e.indexOf("e-")!=-1){let[s,r]=e.split("e");return+`${qr(s)}e${r}`}return Jt(i,n)};function Vr(i,e){return qr(Jt(qr(i/e))*e)}function yd(i,e){return qr(Gi(qr(i/e))*e)}function xv(i,e){return qr(Li(qr(i/e))*e)}function Jt(i,e=0){if(_v(i))return i;let t=10**e,n=i*t*(1+Number.EPSILON);return Ln(n)/t}var br=new Map;function vv(i){return((""+i).split(".")[1]||"").length}function Xl(i,e,t,n){let s=[],r=n.map(vv);for(let o=e;o<t;o++){let a=Dn(o),l=Jt(Ko(i,o),a);for(let c=0;c<n.length;c++){let h=i==10?+`${n[c]}e${o}`:n[c]*l,u=(o>=0?0:a)+(o>=r[c]?0:r[c]),d=i==10?h:Jt(h,u);s.push(d),br.set(d,u)}}return s}var Wl={},vm=[],jo=[null,null],_r=Array.isArray,_v=Number.isInteger,dC=i=>i===void 0;function Wx(i){return typeof i=="string"}function xd(i){let e=!1;if(i!=null){let t=i.constructor;e=t==null||t==Object}return e}function fC(i){return i!=null&&typeof i=="object"}var pC=Object.getPrototypeOf(Uint8Array),bv="__proto__";function Qo(i,e=xd){let t;if(_r(i)){let n=i.find(s=>s!=null);if(_r(n)||e(n)){t=Array(i.length);for(let s=0;s<i.length;s++)t[s]=Qo(i[s],e)}else t=i.slice()}else if(i instanceof pC)t=i.slice();else if(e(i)){t={};for(let n in i)n!=bv&&(t[n]=Qo(i[n],e))}else t=i;return t}function Tn(i){let e=arguments;for(let t=1;t<e.length;t++){let n=e[t];for(let s in n)s!=bv&&(xd(i[s])?Tn(i[s],Qo(n[s])):i[s]=Qo(n[s]))}return i}var mC=0,gC=1,yC=2;function xC(i,e,t){for(let n=0,s,r=-1;n<e.length;n++){let o=e[n];if(o>r){for(s=o-1;s>=0&&i[s]==null;)i[s--]=null;for(s=o+1;s<t&&i[s]==null;)i[r=s++]=null}}}function vC(i,e){if(MC(i)){let o=i[0].slice();for(let a=1;a<i.length;a++)o.push(...i[a].slice(1));return SC(o[0])||(o=bC(o)),o}let t=new Set;for(let o=0;o<i.length;o++){let l=i[o][0],c=l.length;for(let h=0;h<c;h++)t.add(l[h])}let n=[Array.from(t).sort((o,a)=>o-a)],s=n[0].length,r=new Map;for(let o=0;o<s;o++)r.set(n[0][o],o);for(let o=0;o<i.length;o++){let a=i[o],l=a[0];for(let c=1;c<a.length;c++){let h=a[c],u=Array(s).fill(void 0),d=e?e[o][c]:gC,f=[];for(let p=0;p<h.length;p++){let y=h[p],g=r.get(l[p]);y===null?d!=mC&&(u[g]=y,d==yC&&f.push(g)):u[g]=y}xC(u,f,s),n.push(u)}}return n}var _C=typeof queueMicrotask>"u"?i=>Promise.resolve().then(i):queueMicrotask;function bC(i){let e=i[0],t=e.length,n=Array(t);for(let r=0;r<n.length;r++)n[r]=r;n.sort((r,o)=>e[r]-e[o]);let s=[];for(let r=0;r<i.length;r++){let o=i[r],a=Array(t);for(let l=0;l<t;l++)a[l]=o[n[l]];s.push(a)}return s}function MC(i){let e=i[0][0],t=e.length;for(let n=1;n<i.length;n++){let s=i[n][0];if(s.length!=t)return!1;if(s!=e){for(let r=0;r<t;r++)if(s[r]!=e[r])return!1}}return!0}function SC(i,e=100){let t=i.length;if(t<=1)return!0;let n=0,s=t-1;for(;n<=s&&i[n]==null;)n++;for(;s>=n&&i[s]==null;)s--;if(s<=n)return!0;let r=di(1,Li((s-n+1)/e));for(let o=i[n],a=n+r;a<=s;a+=r){let l=i[a];if(l!=null){if(l<=o)return!1;o=l}}return!0}var Mv=["January","February","March","April","May","June","July","August","September","October","November","December"],Sv=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function Ev(i){return i.slice(0,3)}var EC=Sv.map(Ev),wC=Mv.map(Ev),TC={MMMM:Mv,MMM:wC,WWWW:Sv,WWW:EC};function kl(i){return(i<10?"0":"")+i}function AC(i){return(i<10?"00":i<100?"0":"")+i}var RC={YYYY:i=>i.getFullYear(),YY:i=>(i.getFullYear()+"").slice(2),MMMM:(i,e)=>e.MMMM[i.getMonth()],MMM:(i,e)=>e.MMM[i.getMonth()],MM:i=>kl(i.getMonth()+1),M:i=>i.getMonth()+1,DD:i=>kl(i.getDate()),D:i=>i.getDate(),WWWW:(i,e)=>e.WWWW[i.getDay()],WWW:(i,e)=>e.WWW[i.getDay()],HH:i=>kl(i.getHours()),H:i=>i.getHours(),h:i=>{let e=i.getHours();return e==0?12:e>12?e-12:e},AA:i=>i.getHours()>=12?"PM":"AM",aa:i=>i.getHours()>=12?"pm":"am",a:i=>i.getHours()>=12?"p":"a",mm:i=>kl(i.getMinutes()),m:i=>i.getMinutes(),ss:i=>kl(i.getSeconds()),s:i=>i.getSeconds(),fff:i=>AC(i.getMilliseconds())};function _m(i,e){e=e||TC;let t=[],n=/\{([a-z]+)\}|[^{]+/gi,s;for(;s=n.exec(i);)t.push(s[0][0]=="{"?RC[s[1]]:s[0]);return r=>{let o="";for(let a=0;a<t.length;a++)o+=typeof t[a]=="string"?t[a]:t[a](r,e);return o}}var CC=new Intl.DateTimeFormat().resolvedOptions().timeZone;function PC(i,e){let t;return e=="UTC"||e=="Etc/UTC"?t=new Date(+i+i.getTimezoneOffset()*6e4):e==CC?t=i:(t=new Date(i.toLocaleString("en-US",{timeZone:e})),t.setMilliseconds(i.getMilliseconds())),t}var wv=i=>i%1==0,pd=[1,2,2.5,5],IC=Xl(10,-32,0,pd),Tv=Xl(10,0,32,pd),LC=Tv.filter(wv),Gr=IC.concat(Tv),bm=`
`,Av="{YYYY}",Xx=bm+Av,Rv="{M}/{D}",Vl=bm+Rv,cd=Vl+"/{YY}",Cv="{aa}",DC="{h}:{mm}",Zo=DC+Cv,qx=bm+Zo,Yx=":{ss}",Wt=null;function Pv(i){let e=i*1e3,t=e*60,n=t*60,s=n*24,r=s*30,o=s*365,l=(i==1?Xl(10,0,3,pd).filter(wv):Xl(10,-3,0,pd)).concat([e,e*5,e*10,e*15,e*30,t,t*5,t*10,t*15,t*30,n,n*2,n*3,n*4,n*6,n*8,n*12,s,s*2,s*3,s*4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,o,o*2,o*5,o*10,o*25,o*50,o*100]),c=[[o,Av,Wt,Wt,Wt,Wt,Wt,Wt,1],[s*28,"{MMM}",Xx,Wt,Wt,Wt,Wt,Wt,1],[s,Rv,Xx,Wt,Wt,Wt,Wt,Wt,1],[n,"{h}"+Cv,cd,Wt,Vl,Wt,Wt,Wt,1],[t,Zo,cd,Wt,Vl,Wt,Wt,Wt,1],[e,Yx,cd+" "+Zo,Wt,Vl+" "+Zo,Wt,qx,Wt,1],[i,Yx+".{fff}",cd+" "+Zo,Wt,Vl+" "+Zo,Wt,qx,Wt,1]];function h(u){return(d,f,p,y,g,m)=>{let x=[],M=g>=o,_=g>=r&&g<o,C=u(p),T=Jt(C*i,3),v=em(C.getFullYear(),M?0:C.getMonth(),_||M?1:C.getDate()),E=Jt(v*i,3);if(_||M){let N=_?g/r:0,P=M?g/o:0,I=T==E?T:Jt(em(v.getFullYear()+P,v.getMonth()+N,1)*i,3),k=new Date(Ln(I/i)),V=k.getFullYear(),F=k.getMonth();for(let z=0;I<=y;z++){let Y=em(V+P*z,F+N*z,1),G=Y-u(Jt(Y*i,3));I=Jt((+Y+G)*i,3),I<=y&&x.push(I)}}else{let N=g>=s?s:g,P=Li(p)-Li(T),I=E+P+yd(T-E,N);x.push(I);let k=u(I),V=k.getHours()+k.getMinutes()/t+k.getSeconds()/n,F=g/n,z=d.axes[f]._space,Y=m/z;for(;I=Jt(I+g,i==1?0:3),!(I>y);)if(F>1){let G=Li(Jt(V+F,6))%24,Q=u(I).getHours()-G;Q>1&&(Q=-1),I-=Q*n,V=(V+F)%24;let te=x[x.length-1];Jt((I-te)/g,3)*Y>=.7&&x.push(I)}else x.push(I)}return x}}return[l,c,h]}var[NC,FC,UC]=Pv(1),[OC,BC,kC]=Pv(.001);Xl(2,-53,53,[1]);function $x(i,e){return i.map(t=>t.map((n,s)=>s==0||s==8||n==null?n:e(s==1||t[8]==0?n:t[1]+n)))}function Zx(i,e){return(t,n,s,r,o)=>{let a=e.find(p=>o>=p[0])||e[e.length-1],l,c,h,u,d,f;return n.map(p=>{let y=i(p),g=y.getFullYear(),m=y.getMonth(),x=y.getDate(),M=y.getHours(),_=y.getMinutes(),C=y.getSeconds(),T=g!=l&&a[2]||m!=c&&a[3]||x!=h&&a[4]||M!=u&&a[5]||_!=d&&a[6]||C!=f&&a[7]||a[1];return l=g,c=m,h=x,u=M,d=_,f=C,T(y)})}}function HC(i,e){let t=_m(e);return(n,s,r,o,a)=>s.map(l=>t(i(l)))}function em(i,e,t){return new Date(i,e,t)}function Jx(i,e){return e(i)}var zC="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function Kx(i,e){return(t,n,s,r)=>r==null?pm:e(i(n))}function VC(i,e){let t=i.series[e];return t.width?t.stroke(i,e):t.points.width?t.points.stroke(i,e):null}function GC(i,e){return i.series[e].fill(i,e)}var WC={show:!0,live:!0,isolate:!1,mount:cC,markers:{show:!0,width:2,stroke:VC,fill:GC,dash:"solid"},idx:null,idxs:null,values:[]};function XC(i,e){let t=i.cursor.points,n=Vi(),s=t.size(i,e);sn(n,Hl,s),sn(n,zl,s);let r=s/-2;sn(n,"marginLeft",r),sn(n,"marginTop",r);let o=t.width(i,e,s);return o&&sn(n,"borderWidth",o),n}function qC(i,e){let t=i.series[e].points;return t._fill||t._stroke}function YC(i,e){let t=i.series[e].points;return t._stroke||t._fill}function $C(i,e){return i.series[e].points.size}var tm=[0,0];function ZC(i,e,t){return tm[0]=e,tm[1]=t,tm}function hd(i,e,t,n=!0){return s=>{s.button==0&&(!n||s.target==e)&&t(s)}}function nm(i,e,t,n=!0){return s=>{(!n||s.target==e)&&t(s)}}var JC={show:!0,x:!0,y:!0,lock:!1,move:ZC,points:{one:!1,show:XC,size:$C,width:0,stroke:YC,fill:qC},bind:{mousedown:hd,mouseup:hd,click:hd,dblclick:hd,mousemove:nm,mouseleave:nm,mouseenter:nm},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(i,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(i,e,t,n,s)=>n-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},Iv={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},Mm=Tn({},Iv,{filter:yv}),Lv=Tn({},Mm,{size:10}),Dv=Tn({},Iv,{show:!1}),Sm='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',Nv="bold "+Sm,Fv=1.5,jx={show:!0,scale:"x",stroke:fm,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:Nv,side:2,grid:Mm,ticks:Lv,border:Dv,font:Sm,lineGap:Fv,rotate:0},KC="Value",jC="Time",Qx={show:!0,scale:"x",auto:!1,sorted:1,min:Zt,max:-Zt,idxs:[]};function QC(i,e,t,n,s){return e.map(r=>r==null?"":xm(r))}function eP(i,e,t,n,s,r,o){let a=[],l=br.get(s)||0;t=o?t:Jt(yd(t,s),l);for(let c=t;c<=n;c=Jt(c+s,l))a.push(Object.is(c,-0)?0:c);return a}function lm(i,e,t,n,s,r,o){let a=[],l=i.scales[i.axes[e].scale].log,c=l==10?Ys:pv,h=Li(c(t));s=Ko(l,h),l==10&&(s=Gr[ts(s,Gr)]);let u=t,d=s*l;l==10&&(d=Gr[ts(d,Gr)]);do a.push(u),u=u+s,l==10&&!br.has(u)&&(u=Jt(u,br.get(s))),u>=d&&(s=u,d=s*l,l==10&&(d=Gr[ts(d,Gr)]));while(u<=n);return a}function tP(i,e,t,n,s,r,o){let l=i.scales[i.axes[e].scale].asinh,c=n>l?lm(i,e,di(l,t),n,s):[l],h=n>=0&&t<=0?[0]:[];return(t<-l?lm(i,e,di(l,-n),-t,s):[l]).reverse().map(d=>-d).concat(h,c)}var Uv=/./,nP=/[12357]/,iP=/[125]/,ev=/1/,cm=(i,e,t,n)=>i.map((s,r)=>e==4&&s==0||r%n==0&&t.test(s.toExponential()[s<0?1:0])?s:null);function sP(i,e,t,n,s){let r=i.axes[t],o=r.scale,a=i.scales[o],l=i.valToPos,c=r._space,h=l(10,o),u=l(9,o)-h>=c?Uv:l(7,o)-h>=c?nP:l(5,o)-h>=c?iP:ev;if(u==ev){let d=Dn(l(1,o)-h);if(d<c)return cm(e.slice().reverse(),a.distr,u,Gi(c/d)).reverse()}return cm(e,a.distr,u,1)}function rP(i,e,t,n,s){let r=i.axes[t],o=r.scale,a=r._space,l=i.valToPos,c=Dn(l(1,o)-l(2,o));return c<a?cm(e.slice().reverse(),3,Uv,Gi(a/c)).reverse():e}function oP(i,e,t,n){return n==null?pm:e==null?"":xm(e)}var tv={show:!0,scale:"y",stroke:fm,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:Nv,side:3,grid:Mm,ticks:Lv,border:Dv,font:Sm,lineGap:Fv,rotate:0};function aP(i,e){let t=3+(i||1)*2;return Jt(t*e,3)}function lP(i,e){let{scale:t,idxs:n}=i.series[0],s=i._data[0],r=i.valToPos(s[n[0]],t,!0),o=i.valToPos(s[n[1]],t,!0),a=Dn(o-r),l=i.series[e],c=a/(l.points.space*Ht);return n[1]-n[0]<=c}var nv={scale:null,auto:!0,sorted:0,min:Zt,max:-Zt},Ov=(i,e,t,n,s)=>s,iv={show:!0,auto:!0,sorted:0,gaps:Ov,alpha:1,facets:[Tn({},nv,{scale:"x"}),Tn({},nv,{scale:"y"})]},sv={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:Ov,alpha:1,points:{show:lP,filter:null},values:null,min:Zt,max:-Zt,idxs:[],path:null,clip:null};function cP(i,e,t,n,s){return t/10}var Bv={time:!0,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},hP=Tn({},Bv,{time:!1,ori:1}),rv={};function kv(i,e){let t=rv[i];return t||(t={key:i,plots:[],sub(n){t.plots.push(n)},unsub(n){t.plots=t.plots.filter(s=>s!=n)},pub(n,s,r,o,a,l,c){for(let h=0;h<t.plots.length;h++)t.plots[h]!=s&&t.plots[h].pub(n,s,r,o,a,l,c)}},i!=null&&(rv[i]=t)),t}var ea=1,hm=2;function Yr(i,e,t){let n=i.mode,s=i.series[e],r=n==2?i._data[e]:i._data,o=i.scales,a=i.bbox,l=r[0],c=n==2?r[1]:r[e],h=n==2?o[s.facets[0].scale]:o[i.series[0].scale],u=n==2?o[s.facets[1].scale]:o[s.scale],d=a.left,f=a.top,p=a.width,y=a.height,g=i.valToPosH,m=i.valToPosV;return h.ori==0?t(s,l,c,h,u,g,m,d,f,p,y,_d,na,Md,zv,Gv):t(s,l,c,h,u,m,g,f,d,y,p,bd,ia,Tm,Vv,Wv)}function Em(i,e){let t=0,n=0,s=Ft(i.bands,vm);for(let r=0;r<s.length;r++){let o=s[r];o.series[0]==e?t=o.dir:o.series[1]==e&&(o.dir==1?n|=1:n|=2)}return[t,n==1?-1:n==2?1:n==3?2:0]}function uP(i,e,t,n,s){let r=i.mode,o=i.series[e],a=r==2?o.facets[1].scale:o.scale,l=i.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function $s(i,e,t,n,s,r){return Yr(i,e,(o,a,l,c,h,u,d,f,p,y,g)=>{let m=o.pxRound,x=c.dir*(c.ori==0?1:-1),M=c.ori==0?na:ia,_,C;x==1?(_=t,C=n):(_=n,C=t);let T=m(u(a[_],c,y,f)),v=m(d(l[_],h,g,p)),E=m(u(a[C],c,y,f)),N=m(d(r==1?h.max:h.min,h,g,p)),P=new Path2D(s);return M(P,E,N),M(P,T,N),M(P,T,v),P})}function vd(i,e,t,n,s,r){let o=null;if(i.length>0){o=new Path2D;let a=e==0?Md:Tm,l=t;for(let u=0;u<i.length;u++){let d=i[u];if(d[1]>d[0]){let f=d[0]-l;f>0&&a(o,l,n,f,n+r),l=d[1]}}let c=t+s-l,h=10;c>0&&a(o,l,n-h/2,c,n+r+h)}return o}function dP(i,e,t){let n=i[i.length-1];n&&n[0]==e?n[1]=t:i.push([e,t])}function wm(i,e,t,n,s,r,o){let a=[],l=i.length;for(let c=s==1?t:n;c>=t&&c<=n;c+=s)if(e[c]===null){let u=c,d=c;if(s==1)for(;++c<=n&&e[c]===null;)d=c;else for(;--c>=t&&e[c]===null;)d=c;let f=r(i[u]),p=d==u?f:r(i[d]),y=u-s;f=o<=0&&y>=0&&y<l?r(i[y]):f;let m=d+s;p=o>=0&&m>=0&&m<l?r(i[m]):p,p>=f&&a.push([f,p])}return a}function ov(i){return i==0?gv:i==1?Ln:e=>Vr(e,i)}function Hv(i){let e=i==0?_d:bd,t=i==0?(s,r,o,a,l,c)=>{s.arcTo(r,o,a,l,c)}:(s,r,o,a,l,c)=>{s.arcTo(o,r,l,a,c)},n=i==0?(s,r,o,a,l)=>{s.rect(r,o,a,l)}:(s,r,o,a,l)=>{s.rect(o,r,l,a)};return(s,r,o,a,l,c=0,h=0)=>{c==0&&h==0?n(s,r,o,a,l):(c=ns(c,a/2,l/2),h=ns(h,a/2,l/2),e(s,r+c,o),t(s,r+a,o,r+a,o+l,c),t(s,r+a,o+l,r,o+l,h),t(s,r,o+l,r,o,h),t(s,r,o,r+a,o,c),s.closePath())}}var _d=(i,e,t)=>{i.moveTo(e,t)},bd=(i,e,t)=>{i.moveTo(t,e)},na=(i,e,t)=>{i.lineTo(e,t)},ia=(i,e,t)=>{i.lineTo(t,e)},Md=Hv(0),Tm=Hv(1),zv=(i,e,t,n,s,r)=>{i.arc(e,t,n,s,r)},Vv=(i,e,t,n,s,r)=>{i.arc(t,e,n,s,r)},Gv=(i,e,t,n,s,r,o)=>{i.bezierCurveTo(e,t,n,s,r,o)},Wv=(i,e,t,n,s,r,o)=>{i.bezierCurveTo(t,e,s,n,o,r)};function Xv(i){return(e,t,n,s,r)=>Yr(e,t,(o,a,l,c,h,u,d,f,p,y,g)=>{let{pxRound:m,points:x}=o,M,_;c.ori==0?(M=_d,_=zv):(M=bd,_=Vv);let C=Jt(x.width*Ht,3),T=(x.size-x.width)/2*Ht,v=Jt(T*2,3),E=new Path2D,N=new Path2D,{left:P,top:I,width:k,height:V}=e.bbox;Md(N,P-v,I-v,k+v*2,V+v*2);let F=z=>{if(l[z]!=null){let Y=m(u(a[z],c,y,f)),G=m(d(l[z],h,g,p));M(E,Y+T,G),_(E,Y,G,T,0,ud*2)}};if(r)r.forEach(F);else for(let z=n;z<=s;z++)F(z);return{stroke:C>0?E:null,fill:E,clip:N,flags:ea|hm}})}function qv(i){return(e,t,n,s,r,o)=>{n!=s&&(r!=n&&o!=n&&i(e,t,n),r!=s&&o!=s&&i(e,t,s),i(e,t,o))}}var fP=qv(na),pP=qv(ia);function Yv(i){let e=Ft(i?.alignGaps,0);return(t,n,s,r)=>Yr(t,n,(o,a,l,c,h,u,d,f,p,y,g)=>{[s,r]=md(l,s,r);let m=o.pxRound,x=V=>m(u(V,c,y,f)),M=V=>m(d(V,h,g,p)),_,C;c.ori==0?(_=na,C=fP):(_=ia,C=pP);let T=c.dir*(c.ori==0?1:-1),v={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:ea},E=v.stroke,N=!1;if(r-s>=y*4){let V=he=>t.posToVal(he,c.key,!0),F=null,z=null,Y,G,ce,J=x(a[T==1?s:r]),Q=x(a[s]),te=x(a[r]),pe=V(T==1?Q+1:te-1);for(let he=T==1?s:r;he>=s&&he<=r;he+=T){let ee=a[he],ve=(T==1?ee<pe:ee>pe)?J:x(ee),Le=l[he];ve==J?Le!=null?(G=Le,F==null?(_(E,ve,M(G)),Y=F=z=G):G<F?F=G:G>z&&(z=G)):Le===null&&(N=!0):(F!=null&&C(E,J,M(F),M(z),M(Y),M(G)),Le!=null?(G=Le,_(E,ve,M(G)),F=z=Y=G):(F=z=null,Le===null&&(N=!0)),J=ve,pe=V(J+T))}F!=null&&F!=z&&ce!=J&&C(E,J,M(F),M(z),M(Y),M(G))}else for(let V=T==1?s:r;V>=s&&V<=r;V+=T){let F=l[V];F===null?N=!0:F!=null&&_(E,x(a[V]),M(F))}let[I,k]=Em(t,n);if(o.fill!=null||I!=0){let V=v.fill=new Path2D(E),F=o.fillTo(t,n,o.min,o.max,I),z=M(F),Y=x(a[s]),G=x(a[r]);T==-1&&([G,Y]=[Y,G]),_(V,G,z),_(V,Y,z)}if(!o.spanGaps){let V=[];N&&V.push(...wm(a,l,s,r,T,x,e)),v.gaps=V=o.gaps(t,n,s,r,V),v.clip=vd(V,c.ori,f,p,y,g)}return k!=0&&(v.band=k==2?[$s(t,n,s,r,E,-1),$s(t,n,s,r,E,1)]:$s(t,n,s,r,E,k)),v})}function mP(i){let e=Ft(i.align,1),t=Ft(i.ascDesc,!1),n=Ft(i.alignGaps,0),s=Ft(i.extend,!1);return(r,o,a,l)=>Yr(r,o,(c,h,u,d,f,p,y,g,m,x,M)=>{[a,l]=md(u,a,l);let _=c.pxRound,{left:C,width:T}=r.bbox,v=Q=>_(p(Q,d,x,g)),E=Q=>_(y(Q,f,M,m)),N=d.ori==0?na:ia,P={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:ea},I=P.stroke,k=d.dir*(d.ori==0?1:-1),V=E(u[k==1?a:l]),F=v(h[k==1?a:l]),z=F,Y=F;s&&e==-1&&(Y=C,N(I,Y,V)),N(I,F,V);for(let Q=k==1?a:l;Q>=a&&Q<=l;Q+=k){let te=u[Q];if(te==null)continue;let pe=v(h[Q]),he=E(te);e==1?N(I,pe,V):N(I,z,he),N(I,pe,he),V=he,z=pe}let G=z;s&&e==1&&(G=C+T,N(I,G,V));let[ce,J]=Em(r,o);if(c.fill!=null||ce!=0){let Q=P.fill=new Path2D(I),te=c.fillTo(r,o,c.min,c.max,ce),pe=E(te);N(Q,G,pe),N(Q,Y,pe)}if(!c.spanGaps){let Q=[];Q.push(...wm(h,u,a,l,k,v,n));let te=c.width*Ht/2,pe=t||e==1?te:-te,he=t||e==-1?-te:te;Q.forEach(ee=>{ee[0]+=pe,ee[1]+=he}),P.gaps=Q=c.gaps(r,o,a,l,Q),P.clip=vd(Q,d.ori,g,m,x,M)}return J!=0&&(P.band=J==2?[$s(r,o,a,l,I,-1),$s(r,o,a,l,I,1)]:$s(r,o,a,l,I,J)),P})}function av(i,e,t,n,s,r,o=Zt){if(i.length>1){let a=null;for(let l=0,c=1/0;l<i.length;l++)if(e[l]!==void 0){if(a!=null){let h=Dn(i[l]-i[a]);h<c&&(c=h,o=Dn(t(i[l],n,s,r)-t(i[a],n,s,r)))}a=l}}return o}function gP(i){i=i||Wl;let e=Ft(i.size,[.6,Zt,1]),t=i.align||0,n=i.gap||0,s=i.radius;s=s==null?[0,0]:typeof s=="number"?[s,0]:s;let r=It(s),o=1-e[0],a=Ft(e[1],Zt),l=Ft(e[2],1),c=Ft(i.disp,Wl),h=Ft(i.each,f=>{}),{fill:u,stroke:d}=c;return(f,p,y,g)=>Yr(f,p,(m,x,M,_,C,T,v,E,N,P,I)=>{let k=m.pxRound,V=t,F=n*Ht,z=a*Ht,Y=l*Ht,G,ce;_.ori==0?[G,ce]=r(f,p):[ce,G]=r(f,p);let J=_.dir*(_.ori==0?1:-1),Q=_.ori==0?Md:Tm,te=_.ori==0?h:(Me,Xe,ft,we,zt,$e,tt)=>{h(Me,Xe,ft,zt,we,tt,$e)},pe=Ft(f.bands,vm).find(Me=>Me.series[0]==p),he=pe!=null?pe.dir:0,ee=m.fillTo(f,p,m.min,m.max,he),ye=k(v(ee,C,I,N)),ve,Le,Ee,Ve=P,at=k(m.width*Ht),Je=!1,lt=null,rt=null,oe=null,_e=null;u!=null&&(at==0||d!=null)&&(Je=!0,lt=u.values(f,p,y,g),rt=new Map,new Set(lt).forEach(Me=>{Me!=null&&rt.set(Me,new Path2D)}),at>0&&(oe=d.values(f,p,y,g),_e=new Map,new Set(oe).forEach(Me=>{Me!=null&&_e.set(Me,new Path2D)})));let{x0:xe,size:Be}=c;if(xe!=null&&Be!=null){V=1,x=xe.values(f,p,y,g),xe.unit==2&&(x=x.map(ft=>f.posToVal(E+ft*P,_.key,!0)));let Me=Be.values(f,p,y,g);Be.unit==2?Le=Me[0]*P:Le=T(Me[0],_,P,E)-T(0,_,P,E),Ve=av(x,M,T,_,P,E,Ve),Ee=Ve-Le+F}else Ve=av(x,M,T,_,P,E,Ve),Ee=Ve*o+F,Le=Ve-Ee;Ee<1&&(Ee=0),at>=Le/2&&(at=0),Ee<5&&(k=gv);let De=Ee>0,st=Ve-Ee-(De?at:0);Le=k(am(st,Y,z)),ve=(V==0?Le/2:V==J?0:Le)-V*J*((V==0?F/2:0)+(De?at/2:0));let ke={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},vt=Je?null:new Path2D,gt=null;if(pe!=null)gt=f.data[pe.series[1]];else{let{y0:Me,y1:Xe}=c;Me!=null&&Xe!=null&&(M=Xe.values(f,p,y,g),gt=Me.values(f,p,y,g))}let bt=G*Le,O=ce*Le;for(let Me=J==1?y:g;Me>=y&&Me<=g;Me+=J){let Xe=M[Me];if(Xe==null)continue;if(gt!=null){let q=gt[Me]??0;if(Xe-q==0)continue;ye=v(q,C,I,N)}let ft=_.distr!=2||c!=null?x[Me]:Me,we=T(ft,_,P,E),zt=v(Ft(Xe,ee),C,I,N),$e=k(we-ve),tt=k(di(zt,ye)),L=k(ns(zt,ye)),w=tt-L;if(Xe!=null){let q=Xe<0?O:bt,fe=Xe<0?bt:O;Je?(at>0&&oe[Me]!=null&&Q(_e.get(oe[Me]),$e,L+Li(at/2),Le,di(0,w-at),q,fe),lt[Me]!=null&&Q(rt.get(lt[Me]),$e,L+Li(at/2),Le,di(0,w-at),q,fe)):Q(vt,$e,L+Li(at/2),Le,di(0,w-at),q,fe),te(f,p,Me,$e-at/2,L,Le+at,w)}}return at>0?ke.stroke=Je?_e:vt:Je||(ke._fill=m.width==0?m._fill:m._stroke??m._fill,ke.width=0),ke.fill=Je?rt:vt,ke})}function yP(i,e){let t=Ft(e?.alignGaps,0);return(n,s,r,o)=>Yr(n,s,(a,l,c,h,u,d,f,p,y,g,m)=>{[r,o]=md(c,r,o);let x=a.pxRound,M=G=>x(d(G,h,g,p)),_=G=>x(f(G,u,m,y)),C,T,v;h.ori==0?(C=_d,v=na,T=Gv):(C=bd,v=ia,T=Wv);let E=h.dir*(h.ori==0?1:-1),N=M(l[E==1?r:o]),P=N,I=[],k=[];for(let G=E==1?r:o;G>=r&&G<=o;G+=E)if(c[G]!=null){let J=l[G],Q=M(J);I.push(P=Q),k.push(_(c[G]))}let V={stroke:i(I,k,C,v,T,x),fill:null,clip:null,band:null,gaps:null,flags:ea},F=V.stroke,[z,Y]=Em(n,s);if(a.fill!=null||z!=0){let G=V.fill=new Path2D(F),ce=a.fillTo(n,s,a.min,a.max,z),J=_(ce);v(G,P,J),v(G,N,J)}if(!a.spanGaps){let G=[];G.push(...wm(l,c,r,o,E,M,t)),V.gaps=G=a.gaps(n,s,r,o,G),V.clip=vd(G,h.ori,p,y,g,m)}return Y!=0&&(V.band=Y==2?[$s(n,s,r,o,F,-1),$s(n,s,r,o,F,1)]:$s(n,s,r,o,F,Y)),V})}function xP(i){return yP(vP,i)}function vP(i,e,t,n,s,r){let o=i.length;if(o<2)return null;let a=new Path2D;if(t(a,i[0],e[0]),o==2)n(a,i[1],e[1]);else{let l=Array(o),c=Array(o-1),h=Array(o-1),u=Array(o-1);for(let d=0;d<o-1;d++)h[d]=e[d+1]-e[d],u[d]=i[d+1]-i[d],c[d]=h[d]/u[d];l[0]=c[0];for(let d=1;d<o-1;d++)c[d]===0||c[d-1]===0||c[d-1]>0!=c[d]>0?l[d]=0:(l[d]=3*(u[d-1]+u[d])/((2*u[d]+u[d-1])/c[d-1]+(u[d]+2*u[d-1])/c[d]),isFinite(l[d])||(l[d]=0));l[o-1]=c[o-2];for(let d=0;d<o-1;d++)s(a,i[d]+u[d]/3,e[d]+l[d]*u[d]/3,i[d+1]-u[d]/3,e[d+1]-l[d+1]*u[d]/3,i[d+1],e[d+1])}return a}var um=new Set;function lv(){for(let i of um)i.syncRect(!0)}ta&&(Xr(QR,Jo,lv),Xr(eC,Jo,lv,!0),Xr(dd,Jo,()=>{Hn.pxRatio=Ht}));var _P=Yv(),bP=Xv();function cv(i,e,t,n){return(n?[i[0],i[1]].concat(i.slice(2)):[i[0]].concat(i.slice(1))).map((r,o)=>dm(r,o,e,t))}function MP(i,e){return i.map((t,n)=>n==0?{}:Tn({},e,t))}function dm(i,e,t,n){return Tn({},e==0?t:n,i)}function $v(i,e,t){return e==null?jo:[e,t]}var SP=$v;function EP(i,e,t){return e==null?jo:fd(e,t,ym,!0)}function Zv(i,e,t,n){return e==null?jo:gd(e,t,i.scales[n].log,!1)}var wP=Zv;function Jv(i,e,t,n){return e==null?jo:gm(e,t,i.scales[n].log,!1)}var TP=Jv;function AP(i,e,t,n,s){let r=di(zx(i),zx(e)),o=e-i,a=ts(s/n*o,t);do{let l=t[a],c=n*l/o;if(c>=s&&r+(l<5?br.get(l):0)<=17)return[l,c]}while(++a<t.length);return[0,0]}function hv(i){let e,t;return i=i.replace(/(\d+)px/,(n,s)=>(e=Ln((t=+s)*Ht))+"px"),[i,e,t]}function RP(i){i.show&&[i.font,i.labelFont].forEach(e=>{let t=Jt(e[2]*Ht,1);e[0]=e[0].replace(/[0-9.]+px/,t+"px"),e[1]=t})}function Hn(i,e,t){let n={mode:Ft(i.mode,1)},s=n.mode;function r(b,A,D,U){let X=A.valToPct(b);return U+D*(A.dir==-1?1-X:X)}function o(b,A,D,U){let X=A.valToPct(b);return U+D*(A.dir==-1?X:1-X)}function a(b,A,D,U){return A.ori==0?r(b,A,D,U):o(b,A,D,U)}n.valToPosH=r,n.valToPosV=o;let l=!1;n.status=0;let c=n.root=Vi(FR);if(i.id!=null&&(c.id=i.id),Ii(c,i.class),i.title){let b=Vi(BR,c);b.textContent=i.title}let h=es("canvas"),u=n.ctx=h.getContext("2d"),d=Vi(kR,c);Xr("click",d,b=>{b.target===p&&(Qt!=eo||rn!=to)&&zn.click(n,b)},!0);let f=n.under=Vi(HR,d);d.appendChild(h);let p=n.over=Vi(zR,d);i=Qo(i);let y=+Ft(i.pxAlign,1),g=ov(y);(i.plugins||[]).forEach(b=>{b.opts&&(i=b.opts(n,i)||i)});let m=i.ms||.001,x=n.series=s==1?cv(i.series||[],Qx,sv,!1):MP(i.series||[null],iv),M=n.axes=cv(i.axes||[],jx,tv,!0),_=n.scales={},C=n.bands=i.bands||[];C.forEach(b=>{b.fill=It(b.fill||null),b.dir=Ft(b.dir,-1)});let T=s==2?x[1].facets[0].scale:x[0].scale,v={axes:ws,series:At},E=(i.drawOrder||["axes","series"]).map(b=>v[b]);function N(b){let A=b.distr==3?D=>Ys(D>0?D:b.clamp(n,D,b.min,b.max,b.key)):b.distr==4?D=>Qp(D,b.asinh):b.distr==100?D=>b.fwd(D):D=>D;return D=>{let U=A(D),{_min:X,_max:K}=b,le=K-X;return(U-X)/le}}function P(b){let A=_[b];if(A==null){let D=(i.scales||Wl)[b]||Wl;if(D.from!=null){P(D.from);let U=Tn({},_[D.from],D,{key:b});U.valToPct=N(U),_[b]=U}else{A=_[b]=Tn({},b==T?Bv:hP,D),A.key=b;let U=A.time,X=A.range,K=_r(X);if((b!=T||s==2&&!U)&&(K&&(X[0]==null||X[1]==null)&&(X={min:X[0]==null?Bx:{mode:1,hard:X[0],soft:X[0]},max:X[1]==null?Bx:{mode:1,hard:X[1],soft:X[1]}},K=!1),!K&&xd(X))){let le=X;X=(me,Ae,He)=>Ae==null?jo:fd(Ae,He,le)}A.range=It(X||(U?SP:b==T?A.distr==3?wP:A.distr==4?TP:$v:A.distr==3?Zv:A.distr==4?Jv:EP)),A.auto=It(K?!1:A.auto),A.clamp=It(A.clamp||cP),A._min=A._max=null,A.valToPct=N(A)}}}P("x"),P("y"),s==1&&x.forEach(b=>{P(b.scale)}),M.forEach(b=>{P(b.scale)});for(let b in i.scales)P(b);let I=_[T],k=I.distr,V,F;I.ori==0?(Ii(c,UR),V=r,F=o):(Ii(c,OR),V=o,F=r);let z={};for(let b in _){let A=_[b];(A.min!=null||A.max!=null)&&(z[b]={min:A.min,max:A.max},A.min=A.max=null)}let Y=i.tzDate||(b=>new Date(Ln(b/m))),G=i.fmtDate||_m,ce=m==1?UC(Y):kC(Y),J=Zx(Y,$x(m==1?FC:BC,G)),Q=Kx(Y,Jx(zC,G)),te=[],pe=n.legend=Tn({},WC,i.legend),he=n.cursor=Tn({},JC,{drag:{y:s==2}},i.cursor),ee=pe.show,ye=he.show,ve=pe.markers;pe.idxs=te,ve.width=It(ve.width),ve.dash=It(ve.dash),ve.stroke=It(ve.stroke),ve.fill=It(ve.fill);let Le,Ee,Ve,at=[],Je=[],lt,rt=!1,oe={};if(pe.live){let b=x[1]?x[1].values:null;rt=b!=null,lt=rt?b(n,1,0):{_:0};for(let A in lt)oe[A]=pm}if(ee)if(Le=es("table",YR,c),Ve=es("tbody",null,Le),pe.mount(n,Le),rt){Ee=es("thead",null,Le,Ve);let b=es("tr",null,Ee);es("th",null,b);for(var _e in lt)es("th",wx,b).textContent=_e}else Ii(Le,ZR),pe.live&&Ii(Le,$R);let xe={show:!0},Be={show:!1};function De(b,A){if(A==0&&(rt||!pe.live||s==2))return jo;let D=[],U=es("tr",JR,Ve,Ve.childNodes[A]);Ii(U,b.class),b.show||Ii(U,Wr);let X=es("th",null,U);if(ve.show){let me=Vi(KR,X);if(A>0){let Ae=ve.width(n,A);Ae&&(me.style.border=Ae+"px "+ve.dash(n,A)+" "+ve.stroke(n,A)),me.style.background=ve.fill(n,A)}}let K=Vi(wx,X);b.label instanceof HTMLElement?K.appendChild(b.label):K.textContent=b.label,A>0&&(ve.show||(K.style.color=b.width>0?ve.stroke(n,A):ve.fill(n,A)),ke("click",X,me=>{if(he._lock)return;ut(me);let Ae=x.indexOf(b);if((me.ctrlKey||me.metaKey)!=pe.isolate){let He=x.some((ze,We)=>We>0&&We!=Ae&&ze.show);x.forEach((ze,We)=>{We>0&&os(We,He?We==Ae?xe:Be:xe,!0,bn.setSeries)})}else os(Ae,{show:!b.show},!0,bn.setSeries)},!1),dt&&ke(Cx,X,me=>{he._lock||(ut(me),os(x.indexOf(b),io,!0,bn.setSeries))},!1));for(var le in lt){let me=es("td",jR,U);me.textContent="--",D.push(me)}return[U,D]}let st=new Map;function ke(b,A,D,U=!0){let X=st.get(A)||{},K=he.bind[b](n,A,D,U);K&&(Xr(b,A,X[b]=K),st.set(A,X))}function vt(b,A,D){let U=st.get(A)||{};for(let X in U)(b==null||X==b)&&(om(X,A,U[X]),delete U[X]);b==null&&st.delete(A)}let gt=0,bt=0,O=0,Me=0,Xe=0,ft=0,we=Xe,zt=ft,$e=O,tt=Me,L=0,w=0,q=0,fe=0;n.bbox={};let ae=!1,Se=!1,Te=!1,ne=!1,se=!1,ge=!1;function B(b,A,D){(D||b!=n.width||A!=n.height)&&re(b,A),Mt(!1),Te=!0,Se=!0,qn()}function re(b,A){n.width=gt=O=b,n.height=bt=Me=A,Xe=ft=0,Re(),Ke();let D=n.bbox;L=D.left=Vr(Xe*Ht,.5),w=D.top=Vr(ft*Ht,.5),q=D.width=Vr(O*Ht,.5),fe=D.height=Vr(Me*Ht,.5)}let ie=3;function Ce(){let b=!1,A=0;for(;!b;){A++;let D=Kr(A),U=rs(A);b=A==ie||D&&U,b||(re(n.width,n.height),Se=!0)}}function be({width:b,height:A}){B(b,A)}n.setSize=be;function Re(){let b=!1,A=!1,D=!1,U=!1;M.forEach((X,K)=>{if(X.show&&X._show){let{side:le,_size:me}=X,Ae=le%2,He=X.label!=null?X.labelSize:0,ze=me+He;ze>0&&(Ae?(O-=ze,le==3?(Xe+=ze,U=!0):D=!0):(Me-=ze,le==0?(ft+=ze,b=!0):A=!0))}}),is[0]=b,is[1]=D,is[2]=A,is[3]=U,O-=Wi[1]+Wi[3],Xe+=Wi[3],Me-=Wi[2]+Wi[0],ft+=Wi[0]}function Ke(){let b=Xe+O,A=ft+Me,D=Xe,U=ft;function X(K,le){switch(K){case 1:return b+=le,b-le;case 2:return A+=le,A-le;case 3:return D-=le,D+le;case 0:return U-=le,U+le}}M.forEach((K,le)=>{if(K.show&&K._show){let me=K.side;K._pos=X(me,K._size),K.label!=null&&(K._lpos=X(me,K.labelSize))}})}if(he.dataIdx==null){let b=he.hover,A=b.skip=new Set(b.skip??[]);A.add(void 0);let D=b.prox=It(b.prox),U=b.bias??=0;he.dataIdx=(X,K,le,me)=>{if(K==0)return le;let Ae=le,He=D(X,K,le,me)??Zt,ze=He>=0&&He<Zt,We=I.ori==0?O:Me,xt=he.left,Ut=e[0],Nt=e[K];if(A.has(Nt[le])){Ae=null;let Rt=null,ct=null,je;if(U==0||U==-1)for(je=le;Rt==null&&je-- >0;)A.has(Nt[je])||(Rt=je);if(U==0||U==1)for(je=le;ct==null&&je++<Nt.length;)A.has(Nt[je])||(ct=je);if(Rt!=null||ct!=null)if(ze){let tn=Rt==null?-1/0:V(Ut[Rt],I,We,0),dn=ct==null?1/0:V(Ut[ct],I,We,0),On=xt-tn,$t=dn-xt;On<=$t?On<=He&&(Ae=Rt):$t<=He&&(Ae=ct)}else Ae=ct==null?Rt:Rt==null?ct:le-Rt<=ct-le?Rt:ct}else ze&&Dn(xt-V(Ut[le],I,We,0))>He&&(Ae=null);return Ae}}let ut=b=>{he.event=b};he.idxs=te,he._lock=!1;let de=he.points;de.show=It(de.show),de.size=It(de.size),de.stroke=It(de.stroke),de.width=It(de.width),de.fill=It(de.fill);let qe=n.focus=Tn({},i.focus||{alpha:.3},he.focus),dt=qe.prox>=0,Ne=dt&&de.one,_t=[],jt=[],jn=[];function sa(b,A){let D=de.show(n,A);if(D instanceof HTMLElement)return Ii(D,qR),Ii(D,b.class),bs(D,-10,-10,O,Me),p.insertBefore(D,_t[A]),D}function $r(b,A){if(s==1||A>0){let D=s==1&&_[b.scale].time,U=b.value;b.value=D?Wx(U)?Kx(Y,Jx(U,G)):U||Q:U||oP,b.label=b.label||(D?jC:KC)}if(Ne||A>0){b.width=b.width==null?1:b.width,b.paths=b.paths||_P||hC,b.fillTo=It(b.fillTo||uP),b.pxAlign=+Ft(b.pxAlign,y),b.pxRound=ov(b.pxAlign),b.stroke=It(b.stroke||null),b.fill=It(b.fill||null),b._stroke=b._fill=b._paths=b._focus=null;let D=aP(di(1,b.width),1),U=b.points=Tn({},{size:D,width:di(1,D*.2),stroke:b.stroke,space:D*2,paths:bP,_stroke:null,_fill:null},b.points);U.show=It(U.show),U.filter=It(U.filter),U.fill=It(U.fill),U.stroke=It(U.stroke),U.paths=It(U.paths),U.pxAlign=b.pxAlign}if(ee){let D=De(b,A);at.splice(A,0,D[0]),Je.splice(A,0,D[1]),pe.values.push(null)}if(ye){te.splice(A,0,null);let D=null;Ne?A==0&&(D=sa(b,A)):A>0&&(D=sa(b,A)),_t.splice(A,0,D),jt.splice(A,0,0),jn.splice(A,0,0)}Un("addSeries",A)}function Rd(b,A){A=A??x.length,b=s==1?dm(b,A,Qx,sv):dm(b,A,{},iv),x.splice(A,0,b),$r(x[A],A)}n.addSeries=Rd;function Yl(b){if(x.splice(b,1),ee){pe.values.splice(b,1),Je.splice(b,1);let A=at.splice(b,1)[0];vt(null,A.firstChild),A.remove()}ye&&(te.splice(b,1),_t.splice(b,1)[0].remove(),jt.splice(b,1),jn.splice(b,1)),Un("delSeries",b)}n.delSeries=Yl;let is=[!1,!1,!1,!1];function Ms(b,A){if(b._show=b.show,b.show){let D=b.side%2,U=_[b.scale];U==null&&(b.scale=D?x[1].scale:T,U=_[b.scale]);let X=U.time;b.size=It(b.size),b.space=It(b.space),b.rotate=It(b.rotate),_r(b.incrs)&&b.incrs.forEach(le=>{!br.has(le)&&br.set(le,vv(le))}),b.incrs=It(b.incrs||(U.distr==2?LC:X?m==1?NC:OC:Gr)),b.splits=It(b.splits||(X&&U.distr==1?ce:U.distr==3?lm:U.distr==4?tP:eP)),b.stroke=It(b.stroke),b.grid.stroke=It(b.grid.stroke),b.ticks.stroke=It(b.ticks.stroke),b.border.stroke=It(b.border.stroke);let K=b.values;b.values=_r(K)&&!_r(K[0])?It(K):X?_r(K)?Zx(Y,$x(K,G)):Wx(K)?HC(Y,K):K||J:K||QC,b.filter=It(b.filter||(U.distr>=3&&U.log==10?sP:U.distr==3&&U.log==2?rP:yv)),b.font=hv(b.font),b.labelFont=hv(b.labelFont),b._size=b.size(n,null,A,0),b._space=b._rotate=b._incrs=b._found=b._splits=b._values=null,b._size>0&&(is[A]=!0,b._el=Vi(VR,d))}}function Ss(b,A,D,U){let[X,K,le,me]=D,Ae=A%2,He=0;return Ae==0&&(me||K)&&(He=A==0&&!X||A==2&&!le?Ln(jx.size/3):0),Ae==1&&(X||le)&&(He=A==1&&!K||A==3&&!me?Ln(tv.size/2):0),He}let ra=n.padding=(i.padding||[Ss,Ss,Ss,Ss]).map(b=>It(Ft(b,Ss))),Wi=n._padding=ra.map((b,A)=>b(n,A,is,0)),hn,gn=null,yn=null,ss=s==1?x[0].idxs:null,vi=null,Zs=!1;function oa(b,A){if(e=b??[],n.data=n._data=e,s==2){hn=0;for(let D=1;D<x.length;D++)hn+=e[D][0].length}else{e.length==0&&(n.data=n._data=e=[[]]),vi=e[0],hn=vi.length;let D=e;if(k==2){D=e.slice();let U=D[0]=Array(hn);for(let X=0;X<hn;X++)U[X]=X}n._data=e=D}if(Mt(!0),Un("setData"),k==2&&(Te=!0),A!==!1){let D=I;D.auto(n,Zs)?aa():js(T,D.min,D.max),ne=ne||he.left>=0,ge=!0,qn()}}n.setData=oa;function aa(){Zs=!0;let b,A;s==1&&(hn>0?(gn=ss[0]=0,yn=ss[1]=hn-1,b=e[0][gn],A=e[0][yn],k==2?(b=gn,A=yn):b==A&&(k==3?[b,A]=gd(b,b,I.log,!1):k==4?[b,A]=gm(b,b,I.log,!1):I.time?A=b+Ln(86400/m):[b,A]=fd(b,A,ym,!0))):(gn=ss[0]=b=null,yn=ss[1]=A=null)),js(T,b,A)}let Zr,Js,Jr,R,H,j,$,Z,Pe,Ue;function Ie(b,A,D,U,X,K){b??=Ax,D??=vm,U??="butt",X??=Ax,K??="round",b!=Zr&&(u.strokeStyle=Zr=b),X!=Js&&(u.fillStyle=Js=X),A!=Jr&&(u.lineWidth=Jr=A),K!=H&&(u.lineJoin=H=K),U!=j&&(u.lineCap=j=U),D!=R&&u.setLineDash(R=D)}function Oe(b,A,D,U){A!=Js&&(u.fillStyle=Js=A),b!=$&&(u.font=$=b),D!=Z&&(u.textAlign=Z=D),U!=Pe&&(u.textBaseline=Pe=U)}function Ze(b,A,D,U,X=0){if(U.length>0&&b.auto(n,Zs)&&(A==null||A.min==null)){let K=Ft(gn,0),le=Ft(yn,U.length-1),me=D.min==null?sC(U,K,le,X,b.distr==3):[D.min,D.max];b.min=ns(b.min,D.min=me[0]),b.max=di(b.max,D.max=me[1])}}let pt={min:null,max:null};function Tt(){for(let U in _){let X=_[U];z[U]==null&&(X.min==null||z[T]!=null&&X.auto(n,Zs))&&(z[U]=pt)}for(let U in _){let X=_[U];z[U]==null&&X.from!=null&&z[X.from]!=null&&(z[U]=pt)}z[T]!=null&&Mt(!0);let b={};for(let U in z){let X=z[U];if(X!=null){let K=b[U]=Qo(_[U],fC);if(X.min!=null)Tn(K,X);else if(U!=T||s==2)if(hn==0&&K.from==null){let le=K.range(n,null,null,U);K.min=le[0],K.max=le[1]}else K.min=Zt,K.max=-Zt}}if(hn>0){x.forEach((U,X)=>{if(s==1){let K=U.scale,le=z[K];if(le==null)return;let me=b[K];if(X==0){let Ae=me.range(n,me.min,me.max,K);me.min=Ae[0],me.max=Ae[1],gn=ts(me.min,e[0]),yn=ts(me.max,e[0]),yn-gn>1&&(e[0][gn]<me.min&&gn++,e[0][yn]>me.max&&yn--),U.min=vi[gn],U.max=vi[yn]}else U.show&&U.auto&&Ze(me,le,U,e[X],U.sorted);U.idxs[0]=gn,U.idxs[1]=yn}else if(X>0&&U.show&&U.auto){let[K,le]=U.facets,me=K.scale,Ae=le.scale,[He,ze]=e[X],We=b[me],xt=b[Ae];We!=null&&Ze(We,z[me],K,He,K.sorted),xt!=null&&Ze(xt,z[Ae],le,ze,le.sorted),U.min=le.min,U.max=le.max}});for(let U in b){let X=b[U],K=z[U];if(X.from==null&&(K==null||K.min==null)){let le=X.range(n,X.min==Zt?null:X.min,X.max==-Zt?null:X.max,U);X.min=le[0],X.max=le[1]}}}for(let U in b){let X=b[U];if(X.from!=null){let K=b[X.from];if(K.min==null)X.min=X.max=null;else{let le=X.range(n,K.min,K.max,U);X.min=le[0],X.max=le[1]}}}let A={},D=!1;for(let U in b){let X=b[U],K=_[U];if(K.min!=X.min||K.max!=X.max){K.min=X.min,K.max=X.max;let le=K.distr;K._min=le==3?Ys(K.min):le==4?Qp(K.min,K.asinh):le==100?K.fwd(K.min):K.min,K._max=le==3?Ys(K.max):le==4?Qp(K.max,K.asinh):le==100?K.fwd(K.max):K.max,A[U]=D=!0}}if(D){x.forEach((U,X)=>{s==2?X>0&&A.y&&(U._paths=null):A[U.scale]&&(U._paths=null)});for(let U in A)Te=!0,Un("setScale",U);ye&&he.left>=0&&(ne=ge=!0)}for(let U in z)z[U]=null}function Ye(b){let A=am(gn-1,0,hn-1),D=am(yn+1,0,hn-1);for(;b[A]==null&&A>0;)A--;for(;b[D]==null&&D<hn-1;)D++;return[A,D]}function At(){if(hn>0){let b=x.some(A=>A._focus)&&Ue!=qe.alpha;b&&(u.globalAlpha=Ue=qe.alpha),x.forEach((A,D)=>{if(D>0&&A.show&&(an(D,!1),an(D,!0),A._paths==null)){let U=Ue;Ue!=A.alpha&&(u.globalAlpha=Ue=A.alpha);let X=s==2?[0,e[D][0].length-1]:Ye(e[D]);A._paths=A.paths(n,D,X[0],X[1]),Ue!=U&&(u.globalAlpha=Ue=U)}}),x.forEach((A,D)=>{if(D>0&&A.show){let U=Ue;Ue!=A.alpha&&(u.globalAlpha=Ue=A.alpha),A._paths!=null&&Xt(D,!1);{let X=A._paths!=null?A._paths.gaps:null,K=A.points.show(n,D,gn,yn,X),le=A.points.filter(n,D,K,X);(K||le)&&(A.points._paths=A.points.paths(n,D,gn,yn,le),Xt(D,!0))}Ue!=U&&(u.globalAlpha=Ue=U),Un("drawSeries",D)}}),b&&(u.globalAlpha=Ue=1)}}function an(b,A){let D=A?x[b].points:x[b];D._stroke=D.stroke(n,b),D._fill=D.fill(n,b)}function Xt(b,A){let D=A?x[b].points:x[b],{stroke:U,fill:X,clip:K,flags:le,_stroke:me=D._stroke,_fill:Ae=D._fill,_width:He=D.width}=D._paths;He=Jt(He*Ht,3);let ze=null,We=He%2/2;A&&Ae==null&&(Ae=He>0?"#fff":me);let xt=D.pxAlign==1&&We>0;if(xt&&u.translate(We,We),!A){let Ut=L-He/2,Nt=w-He/2,Rt=q+He,ct=fe+He;ze=new Path2D,ze.rect(Ut,Nt,Rt,ct)}A?Ge(me,He,D.dash,D.cap,Ae,U,X,le,K):qt(b,me,He,D.dash,D.cap,Ae,U,X,le,ze,K),xt&&u.translate(-We,-We)}function qt(b,A,D,U,X,K,le,me,Ae,He,ze){let We=!1;Ae!=0&&C.forEach((xt,Ut)=>{if(xt.series[0]==b){let Nt=x[xt.series[1]],Rt=e[xt.series[1]],ct=(Nt._paths||Wl).band;_r(ct)&&(ct=xt.dir==1?ct[0]:ct[1]);let je,tn=null;Nt.show&&ct&&oC(Rt,gn,yn)?(tn=xt.fill(n,Ut)||K,je=Nt._paths.clip):ct=null,Ge(A,D,U,X,tn,le,me,Ae,He,ze,je,ct),We=!0}}),We||Ge(A,D,U,X,K,le,me,Ae,He,ze)}let An=ea|hm;function Ge(b,A,D,U,X,K,le,me,Ae,He,ze,We){Ie(b,A,D,U,X),(Ae||He||We)&&(u.save(),Ae&&u.clip(Ae),He&&u.clip(He)),We?(me&An)==An?(u.clip(We),ze&&u.clip(ze),Pt(X,le),xn(b,K,A)):me&hm?(Pt(X,le),u.clip(We),xn(b,K,A)):me&ea&&(u.save(),u.clip(We),ze&&u.clip(ze),Pt(X,le),u.restore(),xn(b,K,A)):(Pt(X,le),xn(b,K,A)),(Ae||He||We)&&u.restore()}function xn(b,A,D){D>0&&(A instanceof Map?A.forEach((U,X)=>{u.strokeStyle=Zr=X,u.stroke(U)}):A!=null&&b&&u.stroke(A))}function Pt(b,A){A instanceof Map?A.forEach((D,U)=>{u.fillStyle=Js=U,u.fill(D)}):A!=null&&b&&u.fill(A)}function Es(b,A,D,U){let X=M[b],K;if(U<=0)K=[0,0];else{let le=X._space=X.space(n,b,A,D,U),me=X._incrs=X.incrs(n,b,A,D,U,le);K=AP(A,D,me,U,le)}return X._found=K}function vn(b,A,D,U,X,K,le,me,Ae,He){let ze=le%2/2;y==1&&u.translate(ze,ze),Ie(me,le,Ae,He,me),u.beginPath();let We,xt,Ut,Nt,Rt=X+(U==0||U==3?-K:K);D==0?(xt=X,Nt=Rt):(We=X,Ut=Rt);for(let ct=0;ct<b.length;ct++)A[ct]!=null&&(D==0?We=Ut=b[ct]:xt=Nt=b[ct],u.moveTo(We,xt),u.lineTo(Ut,Nt));u.stroke(),y==1&&u.translate(-ze,-ze)}function Kr(b){let A=!0;return M.forEach((D,U)=>{if(!D.show)return;let X=_[D.scale];if(X.min==null){D._show&&(A=!1,D._show=!1,Mt(!1));return}else D._show||(A=!1,D._show=!0,Mt(!1));let K=D.side,le=K%2,{min:me,max:Ae}=X,[He,ze]=Es(U,me,Ae,le==0?O:Me);if(ze==0)return;let We=X.distr==2,xt=D._splits=D.splits(n,U,me,Ae,He,ze,We),Ut=X.distr==2?xt.map(je=>vi[je]):xt,Nt=X.distr==2?vi[xt[1]]-vi[xt[0]]:He,Rt=D._values=D.values(n,D.filter(n,Ut,U,ze,Nt),U,ze,Nt);D._rotate=K==2?D.rotate(n,Rt,U,ze):0;let ct=D._size;D._size=Gi(D.size(n,Rt,U,b)),ct!=null&&D._size!=ct&&(A=!1)}),A}function rs(b){let A=!0;return ra.forEach((D,U)=>{let X=D(n,U,is,b);X!=Wi[U]&&(A=!1),Wi[U]=X}),A}function ws(){for(let b=0;b<M.length;b++){let A=M[b];if(!A.show||!A._show)continue;let D=A.side,U=D%2,X,K,le=A.stroke(n,b),me=D==0||D==3?-1:1,[Ae,He]=A._found;if(A.label!=null){let ti=A.labelGap*me,Mi=Ln((A._lpos+ti)*Ht);Oe(A.labelFont[0],le,"center",D==2?"top":Tx),u.save(),U==1?(X=K=0,u.translate(Mi,Ln(w+fe/2)),u.rotate((D==3?-ud:ud)/2)):(X=Ln(L+q/2),K=Mi);let Er=mv(A.label)?A.label(n,b,Ae,He):A.label;u.fillText(Er,X,K),u.restore()}if(He==0)continue;let ze=_[A.scale],We=U==0?q:fe,xt=U==0?L:w,Ut=A._splits,Nt=ze.distr==2?Ut.map(ti=>vi[ti]):Ut,Rt=ze.distr==2?vi[Ut[1]]-vi[Ut[0]]:Ae,ct=A.ticks,je=A.border,tn=ct.show?ct.size:0,dn=Ln(tn*Ht),On=Ln((A.alignTo==2?A._size-tn-A.gap:A.gap)*Ht),$t=A._rotate*-ud/180,fn=g(A._pos*Ht),_i=(dn+On)*me,ei=fn+_i;K=U==0?ei:0,X=U==1?ei:0;let Ni=A.font[0],Xi=A.align==1?$o:A.align==2?Jp:$t>0?$o:$t<0?Jp:U==0?"center":D==3?Jp:$o,ls=$t||U==1?"middle":D==2?"top":Tx;Oe(Ni,le,Xi,ls);let bi=A.font[1]*A.lineGap,Fi=Ut.map(ti=>g(a(ti,ze,We,xt))),qi=A._values;for(let ti=0;ti<qi.length;ti++){let Mi=qi[ti];if(Mi!=null){U==0?X=Fi[ti]:K=Fi[ti],Mi=""+Mi;let Er=Mi.indexOf(`
`)==-1?[Mi]:Mi.split(/\n/gm);for(let ni=0;ni<Er.length;ni++){let $m=Er[ni];$t?(u.save(),u.translate(X,K+ni*bi),u.rotate($t),u.fillText($m,0,0),u.restore()):u.fillText($m,X,K+ni*bi)}}}ct.show&&vn(Fi,ct.filter(n,Nt,b,He,Rt),U,D,fn,dn,Jt(ct.width*Ht,3),ct.stroke(n,b),ct.dash,ct.cap);let cs=A.grid;cs.show&&vn(Fi,cs.filter(n,Nt,b,He,Rt),U,U==0?2:1,U==0?w:L,U==0?fe:q,Jt(cs.width*Ht,3),cs.stroke(n,b),cs.dash,cs.cap),je.show&&vn([fn],[1],U==0?1:0,U==0?1:2,U==1?w:L,U==1?fe:q,Jt(je.width*Ht,3),je.stroke(n,b),je.dash,je.cap)}Un("drawAxes")}function Mt(b){x.forEach((A,D)=>{D>0&&(A._paths=null,b&&(s==1?(A.min=null,A.max=null):A.facets.forEach(U=>{U.min=null,U.max=null})))})}let un=!1,Qn=!1,Yt=[];function _n(){Qn=!1;for(let b=0;b<Yt.length;b++)Un(...Yt[b]);Yt.length=0}function qn(){un||(_C(Pm),un=!0)}function $l(b,A=!1){un=!0,Qn=A,b(n),Pm(),A&&Yt.length>0&&queueMicrotask(_n)}n.batch=$l;function Pm(){if(ae&&(Tt(),ae=!1),Te&&(Ce(),Te=!1),Se){if(sn(f,$o,Xe),sn(f,"top",ft),sn(f,Hl,O),sn(f,zl,Me),sn(p,$o,Xe),sn(p,"top",ft),sn(p,Hl,O),sn(p,zl,Me),sn(d,Hl,gt),sn(d,zl,bt),h.width=Ln(gt*Ht),h.height=Ln(bt*Ht),M.forEach(({_el:b,_show:A,_size:D,_pos:U,side:X})=>{if(b!=null)if(A){let K=X===3||X===0?D:0,le=X%2==1;sn(b,le?"left":"top",U-K),sn(b,le?"width":"height",D),sn(b,le?"top":"left",le?ft:Xe),sn(b,le?"height":"width",le?Me:O),rm(b,Wr)}else Ii(b,Wr)}),Zr=Js=Jr=H=j=$=Z=Pe=R=null,Ue=1,ha(!0),Xe!=we||ft!=zt||O!=$e||Me!=tt){Mt(!1);let b=O/$e,A=Me/tt;if(ye&&!ne&&he.left>=0){he.left*=b,he.top*=A,jr&&bs(jr,Ln(he.left),0,O,Me),Qr&&bs(Qr,0,Ln(he.top),O,Me);for(let D=0;D<_t.length;D++){let U=_t[D];U!=null&&(jt[D]*=b,jn[D]*=A,bs(U,Gi(jt[D]),Gi(jn[D]),O,Me))}}if(en.show&&!se&&en.left>=0&&en.width>0){en.left*=b,en.width*=b,en.top*=A,en.height*=A;for(let D in Nd)sn(no,D,en[D])}we=Xe,zt=ft,$e=O,tt=Me}Un("setSize"),Se=!1}gt>0&&bt>0&&(u.clearRect(0,0,h.width,h.height),Un("drawClear"),E.forEach(b=>b()),Un("draw")),en.show&&se&&(Zl(en),se=!1),ye&&ne&&(Sr(null,!0,!1),ne=!1),pe.show&&pe.live&&ge&&(Ld(),ge=!1),l||(l=!0,n.status=1,Un("ready")),Zs=!1,un=!1}n.redraw=(b,A)=>{Te=A||!1,b!==!1?js(T,I.min,I.max):qn()};function Cd(b,A){let D=_[b];if(D.from==null){if(hn==0){let U=D.range(n,A.min,A.max,b);A.min=U[0],A.max=U[1]}if(A.min>A.max){let U=A.min;A.min=A.max,A.max=U}if(hn>1&&A.min!=null&&A.max!=null&&A.max-A.min<1e-16)return;b==T&&D.distr==2&&hn>0&&(A.min=ts(A.min,e[0]),A.max=ts(A.max,e[0]),A.min==A.max&&A.max++),z[b]=A,ae=!0,qn()}}n.setScale=Cd;let Pd,Id,jr,Qr,Im,Lm,eo,to,Dm,Nm,Qt,rn,Ks=!1,zn=he.drag,Nn=zn.x,Fn=zn.y;ye&&(he.x&&(Pd=Vi(WR,p)),he.y&&(Id=Vi(XR,p)),I.ori==0?(jr=Pd,Qr=Id):(jr=Id,Qr=Pd),Qt=he.left,rn=he.top);let en=n.select=Tn({show:!0,over:!0,left:0,width:0,top:0,height:0},i.select),no=en.show?Vi(GR,en.over?p:f):null;function Zl(b,A){if(en.show){for(let D in b)en[D]=b[D],D in Nd&&sn(no,D,b[D]);A!==!1&&Un("setSelect")}}n.setSelect=Zl;function o_(b){if(x[b].show)ee&&rm(at[b],Wr);else if(ee&&Ii(at[b],Wr),ye){let D=Ne?_t[0]:_t[b];D!=null&&bs(D,-10,-10,O,Me)}}function js(b,A,D){Cd(b,{min:A,max:D})}function os(b,A,D,U){A.focus!=null&&u_(b),A.show!=null&&x.forEach((X,K)=>{K>0&&(b==K||b==null)&&(X.show=A.show,o_(K),s==2?(js(X.facets[0].scale,null,null),js(X.facets[1].scale,null,null)):js(X.scale,null,null),qn())}),D!==!1&&Un("setSeries",b,A),U&&ua("setSeries",n,b,A)}n.setSeries=os;function a_(b,A){Tn(C[b],A)}function l_(b,A){b.fill=It(b.fill||null),b.dir=Ft(b.dir,-1),A=A??C.length,C.splice(A,0,b)}function c_(b){b==null?C.length=0:C.splice(b,1)}n.addBand=l_,n.setBand=a_,n.delBand=c_;function h_(b,A){x[b].alpha=A,ye&&_t[b]!=null&&(_t[b].style.opacity=A),ee&&at[b]&&(at[b].style.opacity=A)}let Ts,Qs,Mr,io={focus:!0};function u_(b){if(b!=Mr){let A=b==null,D=qe.alpha!=1;x.forEach((U,X)=>{if(s==1||X>0){let K=A||X==0||X==b;U._focus=A?null:K,D&&h_(X,K?1:qe.alpha)}}),Mr=b,D&&qn()}}ee&&dt&&ke(Px,Le,b=>{he._lock||(ut(b),Mr!=null&&os(null,io,!0,bn.setSeries))});function as(b,A,D){let U=_[A];D&&(b=b/Ht-(U.ori==1?ft:Xe));let X=O;U.ori==1&&(X=Me,b=X-b),U.dir==-1&&(b=X-b);let K=U._min,le=U._max,me=b/X,Ae=K+(le-K)*me,He=U.distr;return He==3?Ko(10,Ae):He==4?lC(Ae,U.asinh):He==100?U.bwd(Ae):Ae}function d_(b,A){let D=as(b,T,A);return ts(D,e[0],gn,yn)}n.valToIdx=b=>ts(b,e[0]),n.posToIdx=d_,n.posToVal=as,n.valToPos=(b,A,D)=>_[A].ori==0?r(b,_[A],D?q:O,D?L:0):o(b,_[A],D?fe:Me,D?w:0),n.setCursor=(b,A,D)=>{Qt=b.left,rn=b.top,Sr(null,A,D)};function Fm(b,A){sn(no,$o,en.left=b),sn(no,Hl,en.width=A)}function Um(b,A){sn(no,"top",en.top=b),sn(no,zl,en.height=A)}let la=I.ori==0?Fm:Um,ca=I.ori==1?Fm:Um;function f_(){if(ee&&pe.live)for(let b=s==2?1:0;b<x.length;b++){if(b==0&&rt)continue;let A=pe.values[b],D=0;for(let U in A)Je[b][D++].firstChild.nodeValue=A[U]}}function Ld(b,A){if(b!=null&&(b.idxs?b.idxs.forEach((D,U)=>{te[U]=D}):dC(b.idx)||te.fill(b.idx),pe.idx=te[0]),ee&&pe.live){for(let D=0;D<x.length;D++)(D>0||s==1&&!rt)&&p_(D,te[D]);f_()}ge=!1,A!==!1&&Un("setLegend")}n.setLegend=Ld;function p_(b,A){let D=x[b],U=b==0&&k==2?vi:e[b],X;rt?X=D.values(n,b,A)??oe:(X=D.value(n,A==null?null:U[A],b,A),X=X==null?oe:{_:X}),pe.values[b]=X}function Sr(b,A,D){Dm=Qt,Nm=rn,[Qt,rn]=he.move(n,Qt,rn),he.left=Qt,he.top=rn,ye&&(jr&&bs(jr,Ln(Qt),0,O,Me),Qr&&bs(Qr,0,Ln(rn),O,Me));let U,X=gn>yn;Ts=Zt,Qs=null;let K=I.ori==0?O:Me,le=I.ori==1?O:Me;if(Qt<0||hn==0||X){U=he.idx=null;for(let me=0;me<x.length;me++){let Ae=_t[me];Ae!=null&&bs(Ae,-10,-10,O,Me)}dt&&os(null,io,!0,b==null&&bn.setSeries),pe.live&&(te.fill(U),ge=!0)}else{let me,Ae,He;s==1&&(me=I.ori==0?Qt:rn,Ae=as(me,T),U=he.idx=ts(Ae,e[0],gn,yn),He=V(e[0][U],I,K,0));let ze=-10,We=-10,xt=0,Ut=0,Nt=!0,Rt="",ct="";for(let je=s==2?1:0;je<x.length;je++){let tn=x[je],dn=te[je],On=dn==null?null:s==1?e[je][dn]:e[je][1][dn],$t=he.dataIdx(n,je,U,Ae),fn=$t==null?null:s==1?e[je][$t]:e[je][1][$t];if(ge=ge||fn!=On||$t!=dn,te[je]=$t,je>0&&tn.show){let _i=$t==null?-10:$t==U?He:V(s==1?e[0][$t]:e[je][0][$t],I,K,0),ei=fn==null?-10:F(fn,s==1?_[tn.scale]:_[tn.facets[1].scale],le,0);if(dt&&fn!=null){let Ni=I.ori==1?Qt:rn,Xi=Dn(qe.dist(n,je,$t,ei,Ni));if(Xi<Ts){let ls=qe.bias;if(ls!=0){let bi=as(Ni,tn.scale),Fi=fn>=0?1:-1,qi=bi>=0?1:-1;qi==Fi&&(qi==1?ls==1?fn>=bi:fn<=bi:ls==1?fn<=bi:fn>=bi)&&(Ts=Xi,Qs=je)}else Ts=Xi,Qs=je}}if(ge||Ne){let Ni,Xi;I.ori==0?(Ni=_i,Xi=ei):(Ni=ei,Xi=_i);let ls,bi,Fi,qi,cs,ti,Mi=!0,Er=de.bbox;if(Er!=null){Mi=!1;let ni=Er(n,je);Fi=ni.left,qi=ni.top,ls=ni.width,bi=ni.height}else Fi=Ni,qi=Xi,ls=bi=de.size(n,je);if(ti=de.fill(n,je),cs=de.stroke(n,je),Ne)je==Qs&&Ts<=qe.prox&&(ze=Fi,We=qi,xt=ls,Ut=bi,Nt=Mi,Rt=ti,ct=cs);else{let ni=_t[je];ni!=null&&(jt[je]=Fi,jn[je]=qi,Ox(ni,ls,bi,Mi),Fx(ni,ti,cs),bs(ni,Gi(Fi),Gi(qi),O,Me))}}}}if(Ne){let je=qe.prox,tn=Mr==null?Ts<=je:Ts>je||Qs!=Mr;if(ge||tn){let dn=_t[0];dn!=null&&(jt[0]=ze,jn[0]=We,Ox(dn,xt,Ut,Nt),Fx(dn,Rt,ct),bs(dn,Gi(ze),Gi(We),O,Me))}}}if(en.show&&Ks)if(b!=null){let[me,Ae]=bn.scales,[He,ze]=bn.match,[We,xt]=b.cursor.sync.scales,Ut=b.cursor.drag;if(Nn=Ut._x,Fn=Ut._y,Nn||Fn){let{left:Nt,top:Rt,width:ct,height:je}=b.select,tn=b.scales[We].ori,dn=b.posToVal,On,$t,fn,_i,ei,Ni=me!=null&&He(me,We),Xi=Ae!=null&&ze(Ae,xt);Ni&&Nn?(tn==0?(On=Nt,$t=ct):(On=Rt,$t=je),fn=_[me],_i=V(dn(On,We),fn,K,0),ei=V(dn(On+$t,We),fn,K,0),la(ns(_i,ei),Dn(ei-_i))):la(0,K),Xi&&Fn?(tn==1?(On=Nt,$t=ct):(On=Rt,$t=je),fn=_[Ae],_i=F(dn(On,xt),fn,le,0),ei=F(dn(On+$t,xt),fn,le,0),ca(ns(_i,ei),Dn(ei-_i))):ca(0,le)}else Fd()}else{let me=Dn(Dm-Im),Ae=Dn(Nm-Lm);if(I.ori==1){let xt=me;me=Ae,Ae=xt}Nn=zn.x&&me>=zn.dist,Fn=zn.y&&Ae>=zn.dist;let He=zn.uni;He!=null?Nn&&Fn&&(Nn=me>=He,Fn=Ae>=He,!Nn&&!Fn&&(Ae>me?Fn=!0:Nn=!0)):zn.x&&zn.y&&(Nn||Fn)&&(Nn=Fn=!0);let ze,We;Nn&&(I.ori==0?(ze=eo,We=Qt):(ze=to,We=rn),la(ns(ze,We),Dn(We-ze)),Fn||ca(0,le)),Fn&&(I.ori==1?(ze=eo,We=Qt):(ze=to,We=rn),ca(ns(ze,We),Dn(We-ze)),Nn||la(0,K)),!Nn&&!Fn&&(la(0,0),ca(0,0))}if(zn._x=Nn,zn._y=Fn,b==null){if(D){if(Ym!=null){let[me,Ae]=bn.scales;bn.values[0]=me!=null?as(I.ori==0?Qt:rn,me):null,bn.values[1]=Ae!=null?as(I.ori==1?Qt:rn,Ae):null}ua(Kp,n,Qt,rn,O,Me,U)}if(dt){let me=D&&bn.setSeries,Ae=qe.prox;Mr==null?Ts<=Ae&&os(Qs,io,!0,me):Ts>Ae?os(null,io,!0,me):Qs!=Mr&&os(Qs,io,!0,me)}}ge&&(pe.idx=U,Ld()),A!==!1&&Un("setCursor")}let er=null;Object.defineProperty(n,"rect",{get(){return er==null&&ha(!1),er}});function ha(b=!1){b?er=null:(er=p.getBoundingClientRect(),Un("syncRect",er))}function Om(b,A,D,U,X,K,le){he._lock||Ks&&b!=null&&b.movementX==0&&b.movementY==0||(Dd(b,A,D,U,X,K,le,!1,b!=null),b!=null?Sr(null,!0,!0):Sr(A,!0,!1))}function Dd(b,A,D,U,X,K,le,me,Ae){if(er==null&&ha(!1),ut(b),b!=null)D=b.clientX-er.left,U=b.clientY-er.top;else{if(D<0||U<0){Qt=-10,rn=-10;return}let[He,ze]=bn.scales,We=A.cursor.sync,[xt,Ut]=We.values,[Nt,Rt]=We.scales,[ct,je]=bn.match,tn=A.axes[0].side%2==1,dn=I.ori==0?O:Me,On=I.ori==1?O:Me,$t=tn?K:X,fn=tn?X:K,_i=tn?U:D,ei=tn?D:U;if(Nt!=null?D=ct(He,Nt)?a(xt,_[He],dn,0):-10:D=dn*(_i/$t),Rt!=null?U=je(ze,Rt)?a(Ut,_[ze],On,0):-10:U=On*(ei/fn),I.ori==1){let Ni=D;D=U,U=Ni}}Ae&&(A==null||A.cursor.event.type==Kp)&&((D<=1||D>=O-1)&&(D=Vr(D,O)),(U<=1||U>=Me-1)&&(U=Vr(U,Me))),me?(Im=D,Lm=U,[eo,to]=he.move(n,D,U)):(Qt=D,rn=U)}let Nd={width:0,height:0,left:0,top:0};function Fd(){Zl(Nd,!1)}let Bm,km,Hm,zm;function Vm(b,A,D,U,X,K,le){Ks=!0,Nn=Fn=zn._x=zn._y=!1,Dd(b,A,D,U,X,K,le,!0,!1),b!=null&&(ke(jp,im,Gm,!1),ua(Rx,n,eo,to,O,Me,null));let{left:me,top:Ae,width:He,height:ze}=en;Bm=me,km=Ae,Hm=He,zm=ze}function Gm(b,A,D,U,X,K,le){Ks=zn._x=zn._y=!1,Dd(b,A,D,U,X,K,le,!1,!0);let{left:me,top:Ae,width:He,height:ze}=en,We=He>0||ze>0,xt=Bm!=me||km!=Ae||Hm!=He||zm!=ze;if(We&&xt&&Zl(en),zn.setScale&&We&&xt){let Ut=me,Nt=He,Rt=Ae,ct=ze;if(I.ori==1&&(Ut=Ae,Nt=ze,Rt=me,ct=He),Nn&&js(T,as(Ut,T),as(Ut+Nt,T)),Fn)for(let je in _){let tn=_[je];je!=T&&tn.from==null&&tn.min!=Zt&&js(je,as(Rt+ct,je),as(Rt,je))}Fd()}else he.lock&&(he._lock=!he._lock,Sr(A,!0,b!=null));b!=null&&(vt(jp,im),ua(jp,n,Qt,rn,O,Me,null))}function m_(b,A,D,U,X,K,le){if(he._lock)return;ut(b);let me=Ks;if(Ks){let Ae=!0,He=!0,ze=10,We,xt;I.ori==0?(We=Nn,xt=Fn):(We=Fn,xt=Nn),We&&xt&&(Ae=Qt<=ze||Qt>=O-ze,He=rn<=ze||rn>=Me-ze),We&&Ae&&(Qt=Qt<eo?0:O),xt&&He&&(rn=rn<to?0:Me),Sr(null,!0,!0),Ks=!1}Qt=-10,rn=-10,te.fill(null),Sr(null,!0,!0),me&&(Ks=me)}function Wm(b,A,D,U,X,K,le){he._lock||(ut(b),aa(),Fd(),b!=null&&ua(Ix,n,Qt,rn,O,Me,null))}function Xm(){M.forEach(RP),B(n.width,n.height,!0)}Xr(dd,Jo,Xm);let so={};so.mousedown=Vm,so.mousemove=Om,so.mouseup=Gm,so.dblclick=Wm,so.setSeries=(b,A,D,U)=>{let X=bn.match[2];D=X(n,A,D),D!=-1&&os(D,U,!0,!1)},ye&&(ke(Rx,p,Vm),ke(Kp,p,Om),ke(Cx,p,b=>{ut(b),ha(!1)}),ke(Px,p,m_),ke(Ix,p,Wm),um.add(n),n.syncRect=ha);let Jl=n.hooks=i.hooks||{};function Un(b,A,D){Qn?Yt.push([b,A,D]):b in Jl&&Jl[b].forEach(U=>{U.call(null,n,A,D)})}(i.plugins||[]).forEach(b=>{for(let A in b.hooks)Jl[A]=(Jl[A]||[]).concat(b.hooks[A])});let qm=(b,A,D)=>D,bn=Tn({key:null,setSeries:!1,filters:{pub:Vx,sub:Vx},scales:[T,x[1]?x[1].scale:null],match:[Gx,Gx,qm],values:[null,null]},he.sync);bn.match.length==2&&bn.match.push(qm),he.sync=bn;let Ym=bn.key,Ud=kv(Ym);function ua(b,A,D,U,X,K,le){bn.filters.pub(b,A,D,U,X,K,le)&&Ud.pub(b,A,D,U,X,K,le)}Ud.sub(n);function g_(b,A,D,U,X,K,le){bn.filters.sub(b,A,D,U,X,K,le)&&so[b](null,A,D,U,X,K,le)}n.pub=g_;function y_(){Ud.unsub(n),um.delete(n),st.clear(),om(dd,Jo,Xm),c.remove(),Le?.remove(),Un("destroy")}n.destroy=y_;function Od(){Un("init",i,e),oa(e||i.data,!1),z[T]?Cd(T,z[T]):aa(),se=en.show&&(en.width>0||en.height>0),ne=ge=!0,B(i.width,i.height)}return x.forEach($r),M.forEach(Ms),t?t instanceof HTMLElement?(t.appendChild(c),Od()):t(n,Od):Od(),n}Hn.assign=Tn;Hn.fmtNum=xm;Hn.rangeNum=fd;Hn.rangeLog=gd;Hn.rangeAsinh=gm;Hn.orient=Yr;Hn.pxRatio=Ht;Hn.join=vC;Hn.fmtDate=_m,Hn.tzDate=PC;Hn.sync=kv;{Hn.addGap=dP,Hn.clipGaps=vd;let i=Hn.paths={points:Xv};i.linear=Yv,i.stepped=mP,i.bars=gP,i.spline=xP}var Kv=132,CP=12,Sd=class{constructor(e,t,n,s,r){this.columns=e;this.times=t;this.seek=n;this.onChange=s;this.says=r;new ResizeObserver(()=>this.resize()).observe(this.element),matchMedia("(prefers-color-scheme: dark)").addEventListener("change",()=>{this.show(this.names)})}columns;times;seek;onChange;says;element=W("div",{class:"plots"});charts=[];time=0;wish=0;names=[];has(e){return this.names.includes(e)}toggle(e){this.show(this.has(e)?this.names.filter(t=>t!==e):[...this.names,e].slice(-CP))}async show(e){this.names=e;let t=++this.wish,n=[...new Set(e.map(r=>this.columns.unit(r)))],s=await Promise.all(n.map(r=>this.load(r,e.filter(o=>this.columns.unit(o)===r))));if(t===this.wish){for(let r of this.charts)r.plot?.destroy();this.charts=s,this.element.replaceChildren(...s.map(r=>this.frame(r)));for(let r of s)this.draw(r);this.moveTo(this.time),this.onChange()}}moveTo(e){this.time=e;for(let t of this.charts){if(!t.plot)continue;let n=t.plot.valToPos(e,"x"),s=t.holder.querySelector(".now"),r=t.series.map(o=>`${o.label} ${mn(jv(o.times,o.values,e)??NaN,o.scale)}`);t.plot.over.setAttribute("aria-valuenow",String(e)),t.plot.over.setAttribute("aria-valuetext",`${this.says(e)}: ${r.join(", ")}`),s&&(s.style.transform=`translateX(${n}px)`),t.readout.replaceChildren(...t.series.filter(o=>!o.label.startsWith("ghost ")).map(o=>{let a=W("i",{});a.style.background=o.colour;let l=jv(o.times,o.values,e);return W("li",{},a,W("span",{class:"name"},..._s(o.label)),W("b",{},l===null?"–":mn(l,o.scale)),En("close",`Remove ${o.label}`,()=>this.toggle(o.label)))}))}}async load(e,t){let n=getComputedStyle(document.documentElement),s={unit:e,names:t,plot:null,holder:W("div",{class:"canvas"}),readout:W("ul",{class:"readout"}),series:[]};for(let[r,o]of t.entries()){let a=n.getPropertyValue(`--tone-${(this.names.indexOf(o)+r*0)%8}`).trim();for(let[l,c]of[this.times.main,this.times.ghost].entries()){if(!c)continue;let h=await this.columns.get(l,o);if(typeof h=="string")continue;let u=Array.from(h,d=>Number.isFinite(d)?d:null);s.series.push({label:l?`ghost ${o}`:o,colour:a,values:u,times:c,scale:Hr(u,e)})}}return s}frame(e){let t=e.series.some(r=>r.label.startsWith("ghost "))?`, dashed: ${this.times.ghostTitle}`:"",n=e.unit&&e.unit!=="1"?`[${e.unit}]`:"[–]",s=this.times.isPath?" over the path of equilibria":"";return W("figure",{class:"chart","aria-label":`${e.names.join(", ")}${s||" over time"}`},W("figcaption",{},n+s+t),e.holder,e.readout)}draw(e){let t=getComputedStyle(document.documentElement),n=h=>t.getPropertyValue(`--${h}`).trim(),s={stroke:n("soft"),grid:{stroke:n("grid"),width:1},ticks:{show:!1},font:`11px ${getComputedStyle(document.body).fontFamily}`},{times:r,values:o}=PP(e);if(!r.length||!e.series.length){e.holder.replaceChildren(W("p",{class:"note"},"No numbers"));return}let a={width:Math.max(e.holder.clientWidth,120),height:Kv,legend:{show:!1},cursor:{y:!1,drag:{x:!1,y:!1,setScale:!1},points:{show:!1}},scales:{x:{time:!1},y:{range:(h,u,d)=>IP(u,d)}},axes:[{...s,size:22,gap:3},{...s,size:(h,u)=>14+6.4*Math.max(3,...(u??[]).map(d=>String(d).length)),gap:4,values:(h,u)=>u.map(d=>mn(d,Math.max(...u.map(Math.abs))))}],series:[{},...e.series.map(h=>({stroke:h.colour,width:h.label.startsWith("ghost ")?1:1.6,dash:h.label.startsWith("ghost ")?[5,4]:void 0,spanGaps:!1,pxAlign:0,points:{show:!1}}))],hooks:{ready:[h=>this.listen(h)]}};e.plot=new Hn(a,[r,...o],e.holder);let{over:l}=e.plot;l.append(W("div",{class:"now","aria-hidden":"true"}));let c={role:"slider",tabindex:"0","aria-label":`Moment in the plot of ${e.names.join(", ")}`,"aria-valuemin":String(r[0]),"aria-valuemax":String(r.at(-1))};for(let[h,u]of Object.entries(c))l.setAttribute(h,u)}listen(e){let t=n=>{let s=e.over.getBoundingClientRect();this.seek(e.posToVal(Math.min(Math.max(n.clientX-s.left,0),s.width),"x"))};e.over.addEventListener("pointerdown",n=>{e.over.setPointerCapture(n.pointerId),t(n)}),e.over.addEventListener("pointermove",n=>n.buttons&&t(n))}resize(){for(let e of this.charts){let t=e.holder.clientWidth;e.plot&&t>0&&Math.abs(t-e.plot.width)>1&&e.plot.setSize({width:t,height:Kv})}this.moveTo(this.time)}};function PP(i){let e=[...new Set(i.series.map(o=>o.times))];if(e.length<2)return{times:Array.from(e[0]??[]),values:i.series.map(o=>o.values)};let t=Hn.join(e.map(o=>[Array.from(o),...i.series.filter(a=>a.times===o).map(a=>a.values)])),[n,...s]=t,r=e.flatMap(o=>i.series.filter(a=>a.times===o));return{times:n,values:i.series.map(o=>s[r.indexOf(o)])}}function jv(i,e,t){let n=0,s=i.length-1;for(;n<s;){let r=n+s+1>>1;i[r]<=t?n=r:s=r-1}return e[n]??null}function IP(i,e){if(i===null||e===null)return[-1,1];let t=e-i,n=Math.max(Math.abs(i),Math.abs(e),1e-300),s=t>1e-9*n?.08*t:.5*n||1;return[i-s,e+s]}var LP=3,Ed=class{constructor(e,t){this.player=e;let{motion:n}=e,s=n.end-n.start,r=Math.ceil(-Math.log10((s||1)/Math.max(n.count-1,1))+.001);this.digits=Math.min(Math.max(r,n.load?LP:1),6),this.play=En("play","Play",()=>e.toggle(),"space"),this.play.classList.add("main-button"),this.slider=W("input",{type:"range",class:"scrub",min:0,max:1,step:"any",value:0,"aria-label":n.load?"Path of equilibria":"Time"}),this.slider.addEventListener("input",()=>{let l=Number(this.slider.value);e.toggle(!1),e.seek(n.start+l*s)}),this.now=W("output",{class:"time","aria-live":"off"}),this.speed=W("select",{"aria-label":"Speed",title:"Speed (+ and −)"},...fa.map(l=>W("option",{value:l},`${l}×`))),this.speed.addEventListener("change",()=>{e.speed=Number(this.speed.value),e.onChange()}),this.loop=En("loop","Repeat",()=>{e.loop=!e.loop,e.onChange()},"L");let o=n.load?`${n.count} states`:n.says(n.end,l=>this.inWords(l)),a=W("div",{class:"track"},this.slider,W("div",{class:"ticks","aria-hidden":"true"},...DP(t,n)));this.element=W("footer",{class:"timeline",role:"group","aria-label":"Playback"},W("div",{class:"transport"},En("back","One frame back",()=>e.step(-1),"←"),this.play,En("forward","One frame on",()=>e.step(1),"→")),W("div",{class:"clock"},this.now,W("span",{class:"of"},` / ${o}`)),a,W("div",{class:"pace"},this.speed,this.loop)),this.refresh(),this.tick()}player;element;play;slider;now;speed;loop;digits;inWords(e){let t=e.toFixed(this.digits);return Number(t)===0?t.replace("-",""):t.replace("-","−")}refresh(){let{player:e}=this;Zu(this.play,e.playing?"pause":"play",e.playing?"Pause":"Play","space"),this.speed.value=String(e.speed),this.loop.setAttribute("aria-pressed",String(e.loop)),this.play.disabled=e.motion.count<2}tick(){let{start:e,end:t}=this.player.motion,n=t>e?(this.player.time-e)/(t-e):0;this.slider.value=String(n),this.slider.style.setProperty("--share",`${100*n}%`);let s=this.player.motion.says(this.player.time,r=>this.inWords(r));this.now.textContent=s,this.slider.setAttribute("aria-valuetext",s)}};function DP(i,e){let{start:t}=e,n=e.end-t;return i.filter(s=>n>0&&s.time>=t&&s.time<=t+n).map(s=>{let r=W("i",{title:`${s.name}, ${e.says(s.time,o=>o.toPrecision(5))}`});return r.style.left=`${100*(s.time-t)/n}%`,r})}var NP=14,wd=class{element;buttons=new Map;constructor(e,t){let n=[["Bodies","body",e.bodies.map(a=>({name:a.name,note:"",colour:a.colour}))],["Joints","joint",e.joints.map(a=>({name:a.name,note:a.kind}))],["Forces","force",e.forces.map(a=>({name:a.name,note:a.kind}))],["Drivers","driver",e.drivers.map(a=>({name:a.name,note:""}))],["Couplings","coupling",e.couplings.map(a=>({name:a.name,note:a.kind}))]],s=W("input",{type:"search",class:"search",placeholder:"Find a part","aria-label":"Find a part"});s.addEventListener("input",()=>this.filter(s.value));let r=n.reduce((a,[,,l])=>a+l.length,0),o=n.filter(([,,a])=>a.length).map(([a,l,c])=>W("section",{class:"branch"},W("h3",{},`${a} `,W("span",{class:"count"},String(c.length))),W("ul",{},...this.rows(l==="body"?FP(e):new Map,c,h=>this.button(l,h,t)))));this.element=W("div",{class:"tree"},r>NP&&s,...o)}select(e){for(let[t,n]of this.buttons){let s=!!e&&t===`${e.kind} ${e.name}`;if(n.setAttribute("aria-pressed",String(s)),!s)continue;let r=n.closest("details");r&&(r.open=!0),n.scrollIntoView({block:"nearest"})}}rows(e,t,n){let s=new Map;return t.flatMap((r,o)=>{let a=W("li",{},n(r)),l=e.get(o);if(l===void 0)return[a];let c=s.get(l);if(c)return c.list.append(a),c.count.textContent=String(c.list.childElementCount),[];let h={list:W("ul",{},a),count:W("span",{class:"count"},"1")};return s.set(l,h),[W("li",{},W("details",{},W("summary",{},..._s(l)," ",h.count),h.list))]})}button(e,t,n){let s=W("i",{class:`dot ${e}`});t.colour&&(s.style.background=t.colour);let r=()=>n(a.getAttribute("aria-pressed")==="true"?null:{kind:e,name:t.name}),o=t.note?`${t.name}, ${t.note}`:t.name,a=W("button",{type:"button","aria-label":o,"aria-pressed":"false",onclick:r},s,W("span",{class:"name"},..._s(t.name)),W("small",{},t.note));return this.buttons.set(`${e} ${t.name}`,a),a}filter(e){let t=e.trim().toLowerCase();for(let n of this.buttons.values())n.parentElement.hidden=!n.textContent.toLowerCase().includes(t);for(let n of this.element.querySelectorAll("details")){let s=[...n.querySelectorAll("li")].some(r=>!r.hidden);n.parentElement.hidden=!s,n.open=s&&t!==""}}};function FP(i){return new Map(i.sweeps.flatMap(e=>e.bodies.map(t=>[t,e.name])))}var UP=4e3,OP=400,BP=8,kP=14,ql=class{constructor(e,t,n=!1){this.connection=t;let{content:s,arrays:r}=e,[o,...a]=s.stages;if(!o)throw new Error("there is no machine to show");this.stage=o;let l=W("main",{class:"view"}),c=W("div",{class:"labels","aria-hidden":"true"});document.body.replaceChildren(l),document.title=`${o.name} – nivel`,this.motion=o.motion?new da(o,r):null,this.world=new $u(l,o),this.actor=new Nl(o,r,this.world.look,this.motion,!1);for(let y of a){let g=new da(y,r),m=new Nl(y,r,this.world.look,g,!0);m.root.position.set(...y.origin).sub({x:o.origin[0],y:o.origin[1],z:o.origin[2]}),this.ghosts.push({actor:m,motion:g}),this.world.scene.add(m.root)}if(this.motion){let y=this.ghosts.flatMap(({actor:g,motion:m})=>Op(g,m).map(x=>x.add(g.root.position)));this.world.see([...Op(this.actor,this.motion),...y])}this.colours=new Cu(this.actor),this.arrows=new Ru(this.actor,this.world.look),this.traces=new zu(this.actor,this.motion,this.world.look),this.violations=new Wu(this.actor,this.world.look),this.labels=new Uu(this.actor,c),this.labels.shown.body=o.bodies.length<=kP&&s.mode!=="live",this.follower=new Ou(this.world,this.actor),this.handled=new ku(this.world,this.actor,y=>this.follower.toggle(y)),o.surroundings.length&&this.world.scene.add(nx(o,r)),this.terrains=o.terrains.map(y=>new Vu(y,r,this.actor));for(let{mesh:y,heaps:g}of this.terrains)this.world.scene.add(y,...g);this.world.scene.add(this.actor.root,this.arrows.root,this.traces.root,this.violations.root),this.compass=new Du(this.world),l.append(c,this.compass.element,this.legend.element);let h=new Kl(e,t),u=this.ghosts[0]?.motion.time??null,d={main:this.motion?.time??new Float64Array,ghost:u,ghostTitle:a[0]?.title??"",isPath:!!this.motion?.load};if(this.plots=new Sd(h,d,y=>this.goTo(y),()=>this.inspector?.refresh(),y=>this.motion?.says(y,mn)??mn(y)),this.circuit=o.circuit?new ju(o.circuit,h,this.plots):null,this.inspector=new Qu(o,h,this.plots,this.traces,{follow:()=>this.followOrFit(),isFollowed:y=>this.follower.name===y.name,change:()=>this.refreshFrame(),canPlay:s.mode==="playback"}),this.tree=new wd(o,y=>this.choose(y)),this.motion&&s.mode==="playback"&&(this.player=new jl(this.motion),this.timeline=new Ed(this.player,o.moments),this.player.onChange=()=>this.timeline?.refresh(),this.player.onTime=()=>this.showTime()),s.mode==="machine"&&t&&(this.coordinates=new Ju(o.coordinates,(y,g)=>{this.handled.move(y),t?.send({type:"move",coordinate:y,value:g})},()=>this.reset())),s.mode==="live"&&t){this.trails=new Gu(this.actor,s.traced,s.gauges.length),this.world.scene.add(this.trails.root),this.actor.show("signs",!1);let y=new rd(s.controls,s.gauges,m=>t.send(m),n,s.parameters),g=new Bu(this.world,this.actor,m=>{m.on&&!y.operator.driving&&y.take(!0),t.send(m)});y.onHand=m=>g.isOut=m,this.actor.root.add(g.object),this.live=y,this.hand=g}this.circuit&&this.inspector.put(this.circuit.element),this.dialog=gx(this.live?.keys??null);let f=W("div",{},this.live?.panel??null,this.coordinates?.element??null,this.inspector.element),p=new Ku(this).element;this.panels=new ad(o,a,this.world,{structure:this.tree.element,data:f,display:p},this.timeline?.element??this.live?.bar??null,this.status,()=>this.dialog.showModal()),document.body.append(...this.panels.elements,this.dialog),this.panels.settle(!!this.coordinates||!!this.live,!this.live),this.live&&this.panels.rename("data","Controls and data"),this.world.onBeforeRender=y=>this.beforeRender(y),this.world.onEdges=y=>this.actor.show("edges",y),this.world.onRecolour=()=>this.recolour(),tx(this.world,this.actor,this.arrows.root,y=>this.choose(y)),yx(this),this.player?this.showTime():this.motion&&this.motion.sample(this.motion.start,this.actor.frame),this.refreshFrame(),this.live&&this.handled.watchAll(),this.world.now=()=>Bp(this.actor),(s.mode==="machine"||this.live)&&(this.world.around=()=>Bp(this.actor)),this.player&&this.plotFirst(h)}connection;stage;world;actor;ghosts=[];motion;terrains;player=null;arrows;colours;traces;violations;labels;compass;plots;follower;handled;legend=new ed;timeline=null;tree;inspector;circuit;coordinates=null;live=null;trails=null;hand=null;panels;dialog;status=W("p",{class:"status",role:"status"});picked=null;latest=null;noted=0;came=0;async plotFirst(e){let t=e.list().filter(r=>/\.(angle|displacement)$/.test(r.name)).slice(0,BP),n=await Promise.all(t.map(async r=>HP(await e.get(0,r.name)))),s=t[n.findIndex(r=>r>1e-6*Math.max(...n))]??t[0];s&&this.plots.show([s.name])}goTo(e){this.player?.toggle(!1),this.player?.seek(e)}showTime(){let{player:e,motion:t}=this;if(!(!e||!t)){t.sample(e.time,this.actor.frame),this.actor.time=e.time;for(let n of this.terrains)n.goTo(e.time);for(let n of this.ghosts)n.motion.sample(e.time,n.actor.frame),n.actor.time=e.time,n.actor.apply();this.world.running=e.playing,this.refreshFrame(),this.timeline?.tick(),this.plots.moveTo(e.time),this.inspector.moveTo(e.frame),this.circuit?.moveTo(e.frame)}}take(e){this.latest=e,this.came=performance.now(),this.world.running=!0,this.world.invalidate()}sample(e){this.live?.sample(e),this.trails?.add(e)}deform(e){this.terrains[e.terrain]?.take(e),this.world.invalidate()}message(e){e.type==="note"&&this.note(e.text),e.type==="status"&&this.live?.update(e),e.type==="moved"&&this.coordinates?.update(e.values,this.stage.coordinates,e.problem)}saveTable(e){let t=W("a",{href:URL.createObjectURL(new Blob([e],{type:"text/csv"})),download:`${this.stage.name}.csv`});t.click(),URL.revokeObjectURL(t.href)}say(e){clearTimeout(this.noted),this.status.textContent=e}note(e){this.say(e),this.noted=window.setTimeout(()=>this.say(""),UP)}beforeRender(e){this.player?.advance(e),this.came&&e-this.came>OP&&(this.world.running=!1),this.latest&&(this.actor.frame.set(this.latest.values.subarray(0,this.actor.frame.length)),this.live?.show(this.latest.time,this.latest.values.subarray(this.actor.frame.length)),this.connection?.send({type:"shown",frame:this.latest.number}),this.latest=null,this.refreshFrame(),this.live&&this.colours.spread(),this.hand?.update(),this.handled.keepInSight());let{clientWidth:t,clientHeight:n}=this.world.holder;for(let s of[this.actor,...this.ghosts.map(r=>r.actor)])s.look(this.world.camera,n);this.labels.update(this.world.camera,t,n,!this.world.running),this.compass.update()}refreshFrame(){this.actor.apply();for(let e of this.terrains)e.update();this.legend.show(this.colours.scales()),this.follower.update(),this.arrows.update(),this.violations.update(),this.traces.update(this.player?.frame??0),this.world.invalidate()}choose(e){this.picked=e,this.actor.mark(e,this.world.look),this.tree.select(e),this.inspector.select(e),e&&this.panels.offer("data"),this.refreshFrame()}followOrFit(){this.picked?.kind==="body"?this.follower.toggle(this.picked.name):(this.follower.stop(),this.world.fitNow()),this.inspector.refresh()}look(e){this.follower.stop(),this.world.view(e),this.inspector.refresh()}change(e){e(),this.refreshFrame()}show(e,t){this.change(()=>this.actor.show(e,t))}name(e,t){this.change(()=>this.labels.shown[e]=t)}colour(e){let{ofBeams:t,ofBodies:n,all:s}=this.colours;return t.includes(e)&&this.change(()=>this.colours.beams(e)),n.includes(e)&&this.change(()=>this.colours.bodies(e)),s.includes(e)}bare(e,t){t&&this.world.drawFinely(),document.body.classList.add("bare"),this.panels.close(),this.world.keepFree({left:0,top:0,right:0,bottom:0}),this.world.view(e,!1)}toggleNames(){this.name("body",!this.labels.shown.body)}showGhosts(e){this.change(()=>this.ghosts.forEach(t=>t.actor.root.visible=e))}togglePanel(e){this.panels.toggle(e)}help(){this.dialog.showModal()}escape(){this.dialog.open?this.dialog.close():this.picked?this.choose(null):this.panels.closeTop()}reset(){if(this.live){this.live.say("reset");return}this.connection?.send({type:"reset"})}recolour(){let{look:e}=this.world;this.actor.recolour(e);for(let t of this.ghosts)t.actor.recolour(e);this.arrows.recolour(e),this.traces.recolour(e),this.violations.recolour(e),this.actor.mark(this.picked,e)}};function HP(i){if(typeof i=="string")return 0;let e=1/0,t=-1/0;for(let n of i)n<e&&(e=n),n>t&&(t=n);return Math.max(t-e,0)}var Qv=[500,1e3,2e3,4e3],Td=class{constructor(e,t){this.connect=e;this.listener=t;this.open()}connect;listener;socket=null;requests=new Map;lastRequest=0;failures=0;known=null;send(e){this.socket?.readyState===WebSocket.OPEN&&this.socket.send(JSON.stringify(e))}column(e,t){let n=++this.lastRequest;return new Promise(s=>{if(this.socket?.readyState!==WebSocket.OPEN){s("not connected");return}this.requests.set(n,s),this.send({type:"want",request:n,stage:e,name:t})})}open(){let e=this.connect();e.onopen=()=>{this.failures=0,this.listener.onState(!0,0)},e.onmessage=t=>this.receive(t.data),e.onclose=()=>{for(let n of this.requests.values())n("the connection was lost");this.requests.clear();let t=Qv[Math.min(this.failures++,Qv.length-1)];this.listener.onState(!1,this.failures),this.failures<40&&setTimeout(()=>this.open(),t)},this.socket=e}receive(e){if(typeof e=="string"){let s=JSON.parse(e);s.type==="refused"?this.answer(s.request,s.problem):this.listener.onMessage(s);return}let t=new DataView(e),n=t.getUint32(0,!0);if(n===1)this.receivePackage(new Uint8Array(e,4));else if(n===2){let s=new Float32Array(e,16);this.listener.onFrame({number:t.getUint32(4,!0),time:t.getFloat64(8,!0),values:s})}else n===4?this.listener.onSamples({width:t.getUint32(4,!0),values:new Float64Array(e,8)}):n===6?this.listener.onMoves(YP(e,t)):n===5?this.listener.onTable(new Uint8Array(e,4)):n===3&&this.answer(t.getUint32(4,!0),new Float32Array(e,12))}receivePackage(e){let{known:t}=this;t?(t.length!==e.length||t.some((n,s)=>n!==e[s]))&&this.listener.onOther():(this.known=e.slice(),this.listener.onPackage(e))}answer(e,t){this.requests.get(e)?.(t),this.requests.delete(e)}};function YP(i,e){let[t,n,s]=[4,8,12].map(l=>e.getUint32(l,!0)),r=16+4*n,[o,a]=[new Uint32Array(i,r,s),new Int16Array(i,r+4*s,s)];return{terrain:t,carried:new Float32Array(i,16,n),nodes:o,moves:a}}var e_={f4:Float32Array,f8:Float64Array,u4:Uint32Array,u2:Uint16Array},Am=class{constructor(e){this.block=e}block;floats(e){return this.read(e,"f4")}times(e){return this.read(e,"f8")}indices(e){return this.read(e,"u4")}signed(e){return new Int16Array(this.read(e,"u2").buffer)}rounded({numbers:e,low:t,step:n}){let s=this.read(e,"u2"),r=s.length/t.length,o=new Float32Array(s.length);for(let a=0;a<s.length;a++){let l=Math.floor(a/r);o[a]=t[l]+n[l]*s[a]}return o}read(e,t){if(e.kind!==t)throw new Error(`an array of ${t} was expected, got ${e.kind}`);let n=e.shape.reduce((a,l)=>a*l,1),s=e_[t].BYTES_PER_ELEMENT,r=this.block.subarray(e.start,e.start+n*s);if(r.length!==n*s)throw new Error("the data are cut short");let o=new Uint8Array(n*s);for(let a=0;a<s;a++){let l=r.subarray(a*n,(a+1)*n);for(let c=0;c<n;c++)o[c*s+a]=l[c]}return new e_[t](o.buffer)}};function Rm(i){let e=new DataView(i.buffer,i.byteOffset,i.byteLength);if(new TextDecoder().decode(i.subarray(0,4))!=="NVL1")throw new Error("these are no data of a machine");let n=e.getUint32(4,!0),s=JSON.parse(new TextDecoder().decode(i.subarray(8,8+n)));if(s.protocol!==1)throw new Error("page and data are of different versions of nivel");return{content:s,arrays:new Am(i.subarray(8+n))}}async function Ad(i){let e=Uint8Array.from(atob(i.trim()),n=>n.charCodeAt(0)),t=new Blob([e]).stream().pipeThrough(new DecompressionStream("deflate"));return new Uint8Array(await new Response(t).arrayBuffer())}var ZP=["program","machine","memory","kernels","package"];function t_(){return!!document.getElementById("machine")}async function n_(i){let e=ZP.map(h=>document.getElementById(h)),[t,n,s,r,o]=await Promise.all(e.map(h=>Ad(h.textContent)));for(let h of e)h.remove();let a=new Worker(URL.createObjectURL(new Blob([t],{type:"text/javascript"}))),l=JSON.parse(new TextDecoder().decode(n)),c={readyState:WebSocket.OPEN,onopen:null,onmessage:null,onclose:null,send:h=>a.postMessage(h)};return a.onerror=h=>i(`The machine cannot run here: ${h.message}.`),a.onmessage=h=>{let u=h.data.problem;u?i(`The machine cannot run here: ${u}.`):c.onmessage?.(h)},setTimeout(()=>{c.onopen?.(),a.postMessage({machine:l,memory:s,kernels:r,package:o})}),c}var JP=3;function Cm(i){let e=document.createElement("p");e.className="complaint",e.setAttribute("role","alert"),e.textContent=i,document.body.replaceChildren(e)}function s_(i){let e=i instanceof Error?i.message:String(i);return/WebGL/i.test(e)?"This browser shows no three-dimensional pictures (WebGL is missing or switched off).":`The machine cannot be shown: ${e}.`}function r_(i){window.nivel={app:i,bare:(e,t)=>i.bare(e,t),span:()=>[i.motion?.start??0,i.motion?.end??0],pose:e=>(i.goTo(e),new Promise(t=>requestAnimationFrame(()=>requestAnimationFrame(()=>t())))),frames:()=>i.world.frameCount}}function KP(){let i=new URLSearchParams(location.search).get("token"),e=`${location.protocol==="https:"?"wss":"ws"}://${location.host}/stream${i?`?token=${encodeURIComponent(i)}`:""}`,t=new WebSocket(e);return t.binaryType="arraybuffer",t}function i_(i,e){let t=null,n=new Td(i,{onPackage(s){try{t=new ql(Rm(s),n,e),r_(t)}catch(r){throw Cm(s_(r)),r}},onFrame:s=>t?.take(s),onSamples:s=>t?.sample(s),onMoves:s=>t?.deform(s),onMessage:s=>t?.message(s),onTable:s=>t?.saveTable(s),onOther:()=>location.reload(),onState:(s,r)=>{s||t?.live?.lose(),t?.say(s?"":r<JP?"The connection was lost; it is tried again.":"The program that shows this page has ended; what is here stays.")}})}async function jP(){if(t_()){let e=await n_(Cm);i_(()=>e,!0);return}let i=document.getElementById("package");if(!i?.textContent?.trim()){i_(KP,!1);return}try{let e=new ql(Rm(await Ad(i.textContent)),null);i.remove(),r_(e),(location.hash==="#play"||window.name==="play")&&e.player?.toggle(!0)}catch(e){throw Cm(s_(e)),e}}jP();})();
